"""Processors: how many this process may use, how much of their time it has taken, and how it gives way to others."""

import os
from collections.abc import Iterator
from contextlib import suppress
from math import ceil
from pathlib import Path

ROOT, PROC = Path("/"), Path("/proc")
CPU = "cpu"  # what cgroup v1 calls the controller of processor time, and the folder of its groups
USER_COLUMN, SYSTEM_COLUMN = 11, 12  # columns of /proc/PID/stat behind the name, which may have blanks
FIRST_TO_BE_KILLED = "1000"  # oom_score_adj: the most there is


def cores(root: Path | None = None) -> int:
    """How many threads can compute at once: processors that this process may run on, and its share in a container.

    `root` is where proc and sys are (default: /).
    """
    allowed = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return max(1, min([allowed, *map(ceil, _quotas(root or ROOT))]))


def _quotas(root: Path) -> Iterator[float]:
    """The processors whose time each group of this process may take: cgroup v2 has one tree, v1 one for processors."""
    for line in _text(root / "proc/self/cgroup").splitlines():
        _, controllers, path = line.split(":", 2)
        if controllers and CPU not in controllers.split(","):
            continue
        inside = Path(path.lstrip("/"))
        for tree in {controllers, controllers and CPU}:
            for group in (inside, *inside.parents):  # each has a limit, and a container may see its own as the root
                yield from _quota(root / "sys/fs/cgroup" / tree / group)


def _quota(group: Path) -> Iterator[float]:
    """The processors whose time a group may take; none where it has no limit: "max", and −1 in version 1."""
    said = _text(group / "cpu.max") or f"{_text(group / 'cpu.cfs_quota_us')} {_text(group / 'cpu.cfs_period_us')}"
    with suppress(ValueError, ZeroDivisionError):
        taken, period = map(int, said.split())
        if taken > 0:
            yield taken / period


def _text(path: Path) -> str:
    with suppress(OSError):
        return path.read_text(encoding="utf-8", errors="replace")
    return ""


def cpu_seconds() -> float:
    """Processor time of all threads, of children that have ended, and, where /proc says it, of those that run."""
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
        text = (PROC / f"{process}" / "stat").read_text(encoding="utf-8", errors="replace")
        columns = text.rpartition(")")[2].split()
        return (int(columns[USER_COLUMN]) + int(columns[SYSTEM_COLUMN])) / os.sysconf("SC_CLK_TCK")
    return 0.0


def give_way(niceness: int) -> None:
    """Give way to all other processes, with this much more niceness, and be the first to go where memory is short."""
    os.nice(niceness)
    with suppress(OSError):
        Path("/proc/self/oom_score_adj").write_text(FIRST_TO_BE_KILLED, encoding="ascii")
    # Linux shares the processor between sessions first: among the processes of its own alone, one gives way to nobody.
    if os.getsid(0) == os.getpid():
        with suppress(OSError):
            Path("/proc/self/autogroup").write_text(str(niceness), encoding="ascii")
