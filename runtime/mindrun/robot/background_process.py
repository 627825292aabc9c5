"""A process beside the robot: it gives way to all others, and ends with the one that began it."""

import ctypes
import os
import signal
from contextlib import suppress
from pathlib import Path

PARENT_DIED = 1  # PR_SET_PDEATHSIG
BACKGROUND_NICENESS = 10  # a tenth of the processor where others want all of it


def end_with_parent(parent: int, by: signal.Signals) -> None:
    """As far as the system can: get this signal when process `parent`, or the thread that began this one, has ended."""
    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).prctl(PARENT_DIED, by)
    if os.getppid() != parent:
        os.kill(os.getpid(), by)


def give_way() -> None:
    """Let others go first. Linux may give each session an equal share: whoever calls this has begun one."""
    os.nice(BACKGROUND_NICENESS)
    with suppress(OSError):
        Path("/proc/self/autogroup").write_text(f"{BACKGROUND_NICENESS}", encoding="ascii")
