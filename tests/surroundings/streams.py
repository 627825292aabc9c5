"""A command in a process of its own whose standard streams are closed, full, broken, or of another encoding."""

import os
import sys
import tempfile
import warnings
from collections.abc import Callable, Sequence
from io import TextIOWrapper
from pathlib import Path
from typing import NamedTuple

from mindlang.cli import _terminal as terminal

CLOSED, FULL, GONE = "closed", "full", "gone"


class Ended(NamedTuple):
    """How a command ended, and what it could print; 120 is what Python itself ends with where it cannot."""

    code: int
    out: bytes
    err: bytes


def ended(
    main: Callable[[], None],
    words: Sequence[object],
    stdin: str = os.devnull,
    stdout: str = "",
    stderr: str = "",
    encoding: str = "utf-8",
    first: Callable[[], object] = lambda: None,
) -> Ended:
    """Call a program; where a stream is neither closed nor full nor gone it is caught. `first` is done before it."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # Python 3.12 thinks that a thread might hold a lock
            child = os.fork()
        if child == 0:
            try:
                for number, kind, caught in ((0, stdin, err), (1, stdout, out), (2, stderr, err)):
                    _set(number, kind, caught.fileno())
                _python_opens(encoding)
                first()
                _main(main, [*map(str, words)])
            finally:
                os._exit(99)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        return Ended(code, _all(out.fileno()), _all(err.fileno()))


def _set(number: int, kind: str, caught: int) -> None:
    match kind:
        case "closed":
            os.close(number)
        case "full":
            os.dup2(os.open("/dev/full", os.O_RDWR), number)
        case "gone":
            reading, writing = os.pipe()
            os.close(reading)
            os.dup2(writing, number)
        case "":
            os.dup2(caught, number)
        case path:
            os.dup2(os.open(path, os.O_RDONLY), number)


def _python_opens(encoding: str) -> None:
    """What Python makes of the descriptors when it starts."""
    for number, name, mode, errors in (
        (0, "stdin", "rb", "strict"),
        (1, "stdout", "wb", "strict"),
        (2, "stderr", "wb", "backslashreplace"),
    ):
        try:
            os.fstat(number)
            raw = open(number, mode, closefd=False)  # noqa: SIM115
            stream = TextIOWrapper(raw, encoding, errors, line_buffering=number == 2)
        except OSError:
            stream = None
        setattr(sys, name, stream)
        setattr(sys, f"__{name}__", stream)


def _main(main: Callable[[], None], words: list[str]) -> None:
    terminal.console.cache_clear()
    sys.argv = ["program", *words]
    code: object = 99
    try:
        main()
    except SystemExit as stop:
        code = stop.code
    except BaseException:
        sys.excepthook(*sys.exc_info())
    for stream in (sys.stdout, sys.stderr):  # as Python does it at its end
        try:
            if stream is not None:
                stream.flush()
        except OSError:
            code = 120
    os._exit(code if isinstance(code, int) else 0)


def _all(descriptor: int) -> bytes:
    os.lseek(descriptor, 0, os.SEEK_SET)
    return Path(f"/proc/self/fd/{descriptor}").read_bytes()
