"""Of several processes that lack the same machine code one compiles it; the others wait, and take what it kept."""

import fcntl
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import IO

# Then each compiles for itself: the other may be stopped, or its machine be gone while a shared disk keeps its lock.
WAIT_SECONDS = 600.0
ASK_AGAIN_SECONDS = 0.05


@contextmanager
def exclusive(path: Path) -> Iterator[None]:
    """One process at a time is in this block for a `path`; where it cannot be locked, or not for so long, any are.

    A POSIX lock: it ends with its process, and processes forked meanwhile do not have it. Of threads it knows nothing.
    """
    with ExitStack() as held:
        with suppress(OSError):
            _lock(held.enter_context(path.open("ab")))
        yield


def _lock(file: IO[bytes]) -> None:
    """Wait for it; TimeoutError after WAIT_SECONDS."""
    patience = time.monotonic() + WAIT_SECONDS
    while True:
        try:
            fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return
        except (BlockingIOError, PermissionError):  # both mean that another process has it
            if time.monotonic() > patience:
                raise
        time.sleep(ASK_AGAIN_SECONDS)
