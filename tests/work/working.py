"""A worker of the sphere that costs next to nothing: `working.py [FAULT]`, which it has now and then."""

import os
import sys
from collections.abc import Callable
from time import perf_counter, sleep

from mindrun.work.assignment import Assignment
from mindrun.work.frame import Frame, pack, read, unpack
from mindrun.work.worker import Worker

from tests.train.climbing import Sphere

ASSIGNMENT = Assignment(b"no bundle", "Climb", "Climb")


def with_nan(answer: bytes) -> bytes:
    frame = unpack(answer)
    for array in frame.arrays.values():
        if array.dtype.kind == "f":
            array[...] = float("nan")
    return pack(frame)


def dies(answer: bytes) -> bytes:
    os.kill(os.getpid(), 9)
    return answer


FAULTS: dict[str, Callable[[bytes], bytes]] = {
    "dies": dies,
    "prints": lambda answer: b"Welcome to Ubuntu 24.04\n" + answer,
    "truncates": lambda answer: answer[:-40],
    "flips": lambda answer: answer[:50] + bytes([answer[50] ^ 1]) + answer[51:],
    "nan": with_nan,
    "others": lambda answer: pack(Frame("segment", unpack(answer).about, {})),
    "too_much": lambda answer: answer[:8] + (2**32 - 1).to_bytes(4, "little") + (2**62).to_bytes(8, "little"),
}


def main(fault: str = "", every: str = "3") -> None:
    worker = Worker(lambda assignment: Sphere(), perf_counter)
    jobs = 0
    while (data := read(sys.stdin.buffer)) is not None:
        answer = worker.answer(data)
        whole = len(answer) if fault == "truncates" else 0
        if unpack(answer).kind == "segment":
            jobs += 1
            if fault == "slow":
                sleep(0.02)
            elif fault and jobs % int(every) == 0:
                answer = FAULTS[fault](answer)
        sys.stdout.buffer.write(answer)
        sys.stdout.buffer.flush()
        if len(answer) < whole:
            return


if __name__ == "__main__":
    main(*sys.argv[1:])
