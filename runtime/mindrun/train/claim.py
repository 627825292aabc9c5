"""One process to a run folder: a lock that the system lets go of when its holder dies, however it dies."""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from mindrun.train.errors import RunError


@contextmanager
def claim(folder: Path) -> Iterator[None]:
    """Hold the run folder; RunError where another living process holds it. The file says who, for people."""
    path = folder / "lock"
    with path.open("a+", encoding="utf-8") as file:
        try:
            # A POSIX lock, not flock: worker processes that are forked while it is held do not share it.
            fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except (BlockingIOError, PermissionError):
            raise RunError(f"{folder} is in use by process {_holder(path)}", "wait for it, or stop it first") from None
        file.truncate(0)
        file.write(f"{os.getpid()}\n")
        file.flush()
        yield


def _holder(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace").strip() or "unknown"
