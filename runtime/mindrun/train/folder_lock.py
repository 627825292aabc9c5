"""One process to a run folder: a lock that the system lets go of when its holder dies, however it dies."""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from stat import S_ISREG

from mindrun.files.regular_files import irregular, read_regular
from mindrun.train import RunError

MAX_PID_DIGITS = 20  # of the number of a process


@contextmanager
def claim(folder: Path) -> Iterator[None]:
    """Hold the run folder; RunError where another living process holds it. The file says who, for people."""
    path = folder / "lock"
    with open(_opened(path), "r+", encoding="utf-8") as file:
        try:
            # A POSIX lock, not flock: worker processes that are forked while it is held do not share it.
            fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except (BlockingIOError, PermissionError):
            raise RunError(f"{folder} is in use by process {_holder(path)}", "wait for it, or stop it first") from None
        file.truncate(0)
        file.write(f"{os.getpid()}\n")
        file.flush()
        yield


def _opened(path: Path) -> int:
    """A descriptor of the lock; OSError where a link or anything but a file stands there."""
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC, 0o666)
    mode = os.fstat(descriptor).st_mode
    if not S_ISREG(mode):
        os.close(descriptor)
        raise irregular(path, mode)
    return descriptor


def _holder(path: Path) -> str:
    number = read_regular(path, MAX_PID_DIGITS).strip()
    return number.decode() if number.isdigit() else "unknown"
