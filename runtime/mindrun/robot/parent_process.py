"""A process that ends with the one that began it, whatever ends that."""

import ctypes
import os
import signal
from contextlib import suppress

PARENT_DIED = 1  # PR_SET_PDEATHSIG


def end_with_parent(parent: int, by: signal.Signals) -> None:
    """As far as the system can: get this signal when process `parent`, or the thread that began this one, has ended."""
    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).prctl(PARENT_DIED, by)
    if os.getppid() != parent:
        os.kill(os.getpid(), by)
