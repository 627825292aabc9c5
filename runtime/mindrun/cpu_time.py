"""How much time of processors this process and those that it began have taken."""

import os
from contextlib import suppress
from pathlib import Path

PROC = Path("/proc")
USER_COLUMN, SYSTEM_COLUMN = 11, 12  # columns of /proc/PID/stat behind the name, which may have blanks


def cpu_seconds() -> float:
    """Of all threads, of processes that have ended, and, where /proc says it, of those that have not."""
    return sum(os.times()[:4]) + sum(map(_seconds, _children(os.getpid())))


def _children(process: int) -> list[int]:
    """The processes below one that are there."""
    found: list[int] = []
    for task in (PROC / f"{process}" / "task").glob("*/children"):
        with suppress(OSError):  # it has just ended
            found += map(int, task.read_text(encoding="ascii").split())
    return [*found, *(each for child in found for each in _children(child))]


def _seconds(process: int) -> float:
    with suppress(OSError, IndexError, ValueError):
        columns = (
            (PROC / f"{process}" / "stat").read_text(encoding="utf-8", errors="replace").rpartition(")")[2].split()
        )
        return (int(columns[USER_COLUMN]) + int(columns[SYSTEM_COLUMN])) / os.sysconf("SC_CLK_TCK")
    return 0.0
