"""`python -m mindrun.sim.outside SOCKET FILE`: a process that steps environments, and may end by them.

A question is the name of an environment, the folder of its module, the method of its stepper, the numbers of the runs
that it is asked about, and other arguments.
"""

import fcntl
import os
import sys
from contextlib import suppress
from ctypes import CDLL
from functools import cache, partial
from mmap import mmap
from multiprocessing.connection import Connection
from signal import SIGKILL
from typing import Any

import numpy as np

from mindrun.errors import MindError
from mindrun.sim.outside import making
from mindrun.sim.outside.stepper import EnvironmentRun, LocalStepper
from mindrun.sim.outside.subprocess_stepper import REACHED


class StepperServer:
    """Answers questions to environments; `reached` is the memory for the number of the one that is asked now."""

    def __init__(self, reached: mmap) -> None:
        reach = partial(REACHED.pack_into, reached, 0)
        self._stepper = cache(lambda name, folder: LocalStepper(name, folder, reach))
        self._runs: dict[int, EnvironmentRun] = {}

    def answer(self, question: tuple[Any, ...]) -> tuple[bool, Any]:
        """The answer to a question, or False and the error that it is."""
        try:
            return True, self._answer(question)
        except MindError as error:
            return False, error
        except Exception as error:
            return False, MindError(f"a question to an environment failed: {type(error).__name__}: {error}")

    def _answer(self, question: tuple[Any, ...]) -> Any:
        if question == ("registered",):
            return making.registered()
        name, folder, method, numbers, *arguments = question
        stepper = self._stepper(name, folder)
        if method == "spaces":
            return stepper.spaces
        if method == "begin":
            self._runs.update(zip(numbers, stepper.begin(*arguments), strict=True))
        runs = [self._runs[number] for number in numbers]
        if method == "image":
            image = stepper.image(*runs)
            return image if image.dtype == np.uint8 else np.zeros(0, np.uint8)
        if method == "close":
            return stepper.close([self._runs.pop(number) for number in numbers])
        if method != "begin":
            getattr(stepper, method)(runs, *arguments)
        return np.stack([run.row for run in runs])


def main() -> None:
    """Answer questions until no more come."""
    end_with_standard_input()
    connection = Connection(int(sys.argv[1]))
    server = StepperServer(mmap(int(sys.argv[2]), REACHED.size))
    libc = CDLL(None)
    with suppress(EOFError, OSError):
        if making.is_there():
            making.library()  # its time to be imported is not that of an environment
        connection.send("ready")
        while True:
            answer = server.answer(connection.recv())
            libc.fflush(None)  # C keeps back what does not go to a terminal
            connection.send(answer)
    os._exit(0)  # whatever threads an environment has left


def end_with_standard_input() -> None:
    """Have the system kill this process when standard input ends, whatever it does then: sleep, hold the interpreter.

    What reads from there finds nothing.
    """
    kept = os.dup(0)
    fcntl.fcntl(kept, fcntl.F_SETOWN, os.getpid())
    fcntl.fcntl(kept, fcntl.F_SETSIG, SIGKILL)
    fcntl.fcntl(kept, fcntl.F_SETFL, fcntl.fcntl(kept, fcntl.F_GETFL) | os.O_ASYNC)
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)


if __name__ == "__main__":
    main()
