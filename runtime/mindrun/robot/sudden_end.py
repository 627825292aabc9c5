"""A driver or a procedure that ends the whole process must not make it look as if the robot had done what it should."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import NoReturn

FAILURE_EXIT_CODE = 1
MESSAGE = "mindrun: a driver or a procedure has ended this process"


@contextmanager
def refuse_success(then: str = "") -> Iterator[None]:
    """Meanwhile `os._exit(0)` of this process, in whatever thread, is a failure; what C code ends is not seen.

    `then` says what comes of it.
    """
    leave, process = os._exit, os.getpid()

    def _exit(status: int) -> NoReturn:
        if os.getpid() == process:
            os.write(2, f"{MESSAGE}{then}\n".encode())
            status = status or FAILURE_EXIT_CODE
        leave(status)

    os._exit = _exit
    try:
        yield
    finally:
        os._exit = leave
