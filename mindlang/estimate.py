"""How much memory something will take, held against what there is before it begins."""

import resource
from contextlib import suppress
from pathlib import Path

from mindrun.errors import MindError
from mindrun.graph import Task

RUN, ENTRY = 512, 64  # bytes that a run takes, and each of its rewards and events
LIMITS = "/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"  # of a container


def refuse_too_many(task: Task, runs: int) -> None:
    """MindError where the results of so many runs of a task cannot be kept."""
    needed, there = runs * bytes_for(task), available()
    if there is not None and needed > there:
        message = f"{runs:,} runs take about {_said(needed)} of memory, and there are {_said(there)}"
        raise MindError(message, f"--runs {there // (2 * bytes_for(task))} would do")


def bytes_for(task: Task) -> int:
    """What the results of one run take while many are gathered."""
    return RUN + ENTRY * (len(task.rewards) + len(task.events))


def available() -> int | None:
    """The bytes of memory that this process may still take; None where nobody knows."""
    found = [_free(), *map(_number_in, LIMITS)]
    limit = resource.getrlimit(resource.RLIMIT_AS)[0]
    known = [number for number in (*found, limit) if number is not None and number >= 0]
    return min(known, default=None)


def _free() -> int | None:
    with suppress(OSError, ValueError, IndexError):
        lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
        return next((int(line.split()[1]) << 10 for line in lines if line.startswith("MemAvailable:")), None)
    return None


def _number_in(path: str) -> int | None:
    with suppress(OSError, ValueError):  # "max" is no limit
        return int(Path(path).read_text(encoding="ascii"))
    return None


def _said(number: int) -> str:
    return f"{number / 2**30:.1f} GiB" if number >= 2**30 else f"{number / 2**20:.0f} MiB"
