"""How many processors this process may use: those that it may run on, and what a container allows of their time."""

import os
from collections.abc import Iterator
from contextlib import suppress
from math import ceil
from pathlib import Path

ROOT = Path("/")
CPU = "cpu"  # what cgroup v1 calls the controller of processor time, and the folder of its groups


def cores(root: Path | None = None) -> int:
    """How many threads of this process can compute at once; `root` is where proc and sys are (default: /)."""
    allowed = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return max(1, min([allowed, *map(ceil, _quotas(root or ROOT))]))


def _quotas(root: Path) -> Iterator[float]:
    """How many processors' time the groups of this process may take: cgroup v2 has one tree, v1 one for processors."""
    for line in _text(root / "proc/self/cgroup").splitlines():
        _, controllers, path = line.split(":", 2)
        if controllers and CPU not in controllers.split(","):
            continue
        inside = Path(path.lstrip("/"))
        for tree in {controllers, controllers and CPU}:
            for group in (inside, *inside.parents):  # each has a limit, and a container may see its own as the root
                yield from _quota(root / "sys/fs/cgroup" / tree / group)


def _quota(group: Path) -> Iterator[float]:
    """Of the time that a group may take in each period; "max", and −1 in version 1, are no limit."""
    said = _text(group / "cpu.max") or f"{_text(group / 'cpu.cfs_quota_us')} {_text(group / 'cpu.cfs_period_us')}"
    with suppress(ValueError, ZeroDivisionError):
        taken, period = map(int, said.split())
        if taken > 0:
            yield taken / period


def _text(path: Path) -> str:
    with suppress(OSError):
        return path.read_text(encoding="utf-8", errors="replace")
    return ""
