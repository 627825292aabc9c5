"""A worker that counts, and does something wrong now and then: `wrong.py FAULT EVERY`."""

import sys
from collections.abc import Callable
from dataclasses import replace
from time import perf_counter, sleep
from typing import Any

from mindrun.work.frame import Frame, pack, read, unpack
from mindrun.work.worker import ALIVE, READY, Worker

from tests.work.counting import Counting


def with_arrays(answer: bytes, change: Callable[[str, Any], Any]) -> bytes:
    frame = unpack(answer)
    return pack(replace(frame, arrays={name: change(name, array) for name, array in frame.arrays.items()}))


def with_about(answer: bytes, **about: Any) -> bytes:
    frame = unpack(answer)
    return pack(replace(frame, about={**frame.about, **about}))


def never(answer: bytes) -> bytes:
    sleep(1000)
    return answer


def only_alive(answer: bytes) -> bytes:
    sys.stdout.buffer.write(pack(Frame(ALIVE, {"at": "in step 7 of the run of seed 3"})))
    sys.stdout.buffer.flush()
    return never(answer)


FAULTS: dict[str, Callable[[bytes], bytes]] = {
    "twice": lambda answer: answer * 2,
    "of another job": lambda answer: with_about(answer, of="0" * 64),
    "of no job": lambda answer: with_about(answer, of=None),
    "fewer": lambda answer: with_arrays(answer, lambda name, array: array[:, 1:]),
    "more": lambda answer: with_arrays(answer, lambda name, array: array.repeat(2, axis=0)),
    "nan": lambda answer: with_arrays(answer, lambda name, array: array * float("nan") if name == "total" else array),
    "negative": lambda answer: with_arrays(answer, lambda name, array: -1 - array if name == "ticks" else array),
    "too long": lambda answer: with_arrays(answer, lambda name, array: array + 9999 if name == "ticks" else array),
    "no such end": lambda answer: with_arrays(answer, lambda name, array: array + 99 if name == "ended_by" else array),
    "without seconds": lambda answer: with_about(answer, seconds=None),
    "counts less": lambda answer: with_about(answer, tally=[1]),
    "never": never,
    "only alive": only_alive,
}


def main(fault: str, every: str) -> None:
    if fault == "mute":
        sleep(1000)
    if fault == "dead":
        sys.exit("there is no licence here")
    if fault == "loud":
        sys.stderr.write("a line that nobody wants\n" * 100_000)
    worker, jobs = Worker(lambda assignment: Counting(), perf_counter), 0
    out = sys.stdout.buffer
    out.write(pack(Frame(READY, {"silent_seconds": 1})))
    out.flush()
    while (data := read(sys.stdin.buffer)) is not None:
        answer = worker.answer(data)
        if unpack(answer).kind == "scores":
            jobs += 1
            if fault in FAULTS and jobs % int(every) == 0:
                answer = FAULTS[fault](answer)
        out.write(answer)
        out.flush()


if __name__ == "__main__":
    main(*sys.argv[1:])
