"""From where to where whole numbers go that a user gives, on the command line or from a program."""

from operator import index
from typing import Any

from mindrun.errors import MindError

Bounds = tuple[int, int]  # both may be given

SEED_BOUNDS: Bounds = (0, 2**63 - 1)  # of a training, or of many runs
LAYOUT_BOUNDS: Bounds = (0, 2**64 - 1)  # seed of one run
RUN_BOUNDS: Bounds = (1, 10_000_000)
WORKER_BOUNDS: Bounds = (1, 1024)
GENERATION_BOUNDS: Bounds = (1, 10_000_000)
POPULATION_BOUNDS: Bounds = (4, 1_000_000)  # genomes
ATTEMPT_BOUNDS: Bounds = (1, 10_000)
RUNG_BOUNDS: Bounds = (0, 1000)


def whole(what: str, bounds: Bounds, value: Any) -> int:
    """The value as an int, those of numpy too; MindError where it is no whole number within its bounds."""
    low, high = bounds
    try:
        number = index(value)
    except TypeError:
        number = low - 1
    if isinstance(value, bool) or not low <= number <= high:
        raise MindError(f"{what} cannot be {value!r:.40}", f"{what} is a whole number from {low} to {high}")
    return number


def as_seed(value: Any) -> int:
    """The seed of a training, or of many runs."""
    return whole("seed", SEED_BOUNDS, value)


def as_layout(value: Any) -> int:
    """The seed of one run."""
    return whole("seed", LAYOUT_BOUNDS, value)


def as_runs(value: Any) -> int:
    """How many runs."""
    return whole("runs", RUN_BOUNDS, value)


def as_workers(value: Any) -> int:
    """How many threads."""
    return whole("workers", WORKER_BOUNDS, value)
