"""Limits of what a user may ask for: whole numbers within their bounds, and memory and time that are there."""

import resource
from contextlib import suppress
from operator import index
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mindrun.errors import MindError

if TYPE_CHECKING:
    from mindrun.graph.graph import Task
    from mindrun.sim.build import Sizes
    from mindrun.sim.rollout import Rollout

Bounds = tuple[int, int]  # both may be given

SEED_BOUNDS: Bounds = (0, 2**63 - 1)  # of a training, or of many runs
LAYOUT_BOUNDS: Bounds = (0, 2**64 - 1)  # seed of one run
RUN_BOUNDS: Bounds = (1, 10_000_000)
WORKER_BOUNDS: Bounds = (1, 1024)
ROBOT_BOUNDS: Bounds = (0, 63)  # number of one, of which a world has at most 64
GENERATION_BOUNDS: Bounds = (1, 10_000_000)
POPULATION_BOUNDS: Bounds = (4, 1_000_000)  # genomes
ATTEMPT_BOUNDS: Bounds = (1, 10_000)
RUNG_BOUNDS: Bounds = (0, 1000)

RUN_BYTES, ENTRY_BYTES = 160, 12  # bytes that a run takes, and each of its rewards and events
LANE_BYTES, LOOSE_BYTES, GENOME_COPIES = 20_000, 5200, 6
WAITING_BYTES = {"delays": 4, "changes": 16, "depth": 8, "skills": 12}
MAX_TICKS_PER_SECOND = 20_000_000  # agent-ticks in a second and worker, which no lesson reaches
YEAR_SECONDS = 366 * 24 * 3600  # nobody waits for longer
CGROUP_LIMIT_FILES = "/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"  # of a container


def bounded_int(what: str, bounds: Bounds, value: Any) -> int:
    """The value as an int, those of numpy too; MindError where it is no whole number within its bounds."""
    low, high = bounds
    try:
        number = index(value)
    except TypeError:
        number = low - 1
    if isinstance(value, bool) or not low <= number <= high:
        raise MindError(f"{what} cannot be {value!r:.40}", f"{what} is a whole number from {low} to {high}")
    return number


def refuse_too_many(task: "Task", runs: int) -> None:
    """Raise MindError where the results of so many runs of a task cannot be kept."""
    needed, there = runs * bytes_for(task), available()
    if there is not None and needed > there:
        message = f"{runs:,} runs take about {_in_bytes(needed)} of memory, and there are {_in_bytes(there)}"
        raise MindError(message, f"--runs {there // (2 * bytes_for(task))} would do")


def bytes_for(task: "Task") -> int:
    """The bytes of one run's results while many are gathered."""
    return RUN_BYTES + ENTRY_BYTES * (len(task.rewards) + len(task.events))


def refuse_too_large(rollout: "Rollout", genomes: int, layouts: int, attempts: int = 1) -> None:
    """Raise MindError where so many genomes on so many layouts do not fit into memory, in each of so many attempts."""
    needed, there = attempts * bytes_of(rollout, genomes, layouts), available()
    if there is not None and needed > there:
        message = f"{rollout.task.name} takes about {_in_bytes(needed)} of memory, and there are {_in_bytes(there)}"
        parts = _parts(rollout.sizes)
        raise MindError(message, f"Most of it is for {max(parts, key=parts.__getitem__)}.")


def refuse_too_long(rollout: "Rollout", runs: int) -> None:
    """Raise MindError where so many runs of a task could take over a year, however fast the machine is."""
    years = runs * rollout.task.ticks // (MAX_TICKS_PER_SECOND * rollout.workers) // YEAR_SECONDS
    if years:
        message = f"{runs:,} runs of {rollout.task.name} take up to {years:,} year{'s' * (years > 1)} and more"
        raise MindError(message, f"A run lasts up to {rollout.task.ticks:,} ticks.")


def bytes_of(rollout: "Rollout", genomes: int, layouts: int) -> int:
    """The bytes of a rollout: its lanes, and the genomes with their parents and copies of both."""
    robots = len(rollout.tables.robots)
    lanes = min(genomes * layouts, rollout.workers * max(1, rollout.lanes // robots)) * robots
    rays, things, loose = len(rollout.tables.ray_row), len(rollout.tables.things), len(rollout.tables.loose)
    each = LANE_BYTES + 4 * rays + 48 * things + LOOSE_BYTES * loose + sum(_parts(rollout.sizes).values())
    return lanes * each + GENOME_COPIES * genomes * 4 * rollout.genome_length


def _parts(sizes: "Sizes") -> dict[str, int]:
    """The bytes of a lane by what they are for."""
    return {
        "the weights": 4 * sizes["genome"],
        "the neurons of its widest layer": 4 * sizes["scratch"],
        "the readings": 4 * sum(sizes[name] for name in ("readings", "inputs", "before", "rough", "rings")),
        "the patches to visit": sizes["patches"],
        "the obstacles": (24 + 24 + 16 + 8) * sizes["boxes"],
        "what waits and changes": sum(count * sizes[name] for name, count in WAITING_BYTES.items()),
    }


def available() -> int | None:
    """The bytes of memory that this process may still take; None where nobody knows."""
    known = [resource.getrlimit(resource.RLIMIT_AS)[0]]
    with suppress(OSError, ValueError, IndexError):
        lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
        known += [int(line.split()[1]) << 10 for line in lines if line.startswith("MemAvailable:")]
    for path in CGROUP_LIMIT_FILES:
        with suppress(OSError, ValueError):  # "max" is no limit
            known.append(int(Path(path).read_text(encoding="ascii")))
    return min((number for number in known if number >= 0), default=None)


def _in_bytes(number: int) -> str:
    return f"{number / 2**30:.1f} GiB" if number >= 2**30 else f"{number / 2**20:.0f} MiB"
