"""From where to where whole numbers go that a user gives, on the command line or from a program."""

from operator import index
from typing import Any

from mindrun.errors import MindError

Bounds = tuple[int, int]  # both may be given

SEEDS: Bounds = (0, 2**63 - 1)  # of a training, or of many runs
LAYOUTS: Bounds = (0, 2**64 - 1)  # seed of one run
RUNS: Bounds = (1, 10_000_000)
WORKERS: Bounds = (1, 1024)
GENERATIONS: Bounds = (1, 10_000_000)
POPULATION: Bounds = (4, 1_000_000)  # genomes
ATTEMPTS: Bounds = (1, 10_000)
RUNGS: Bounds = (0, 1000)


def whole(what: str, value: Any, bounds: Bounds) -> int:
    """The value as an int, those of numpy too; MindError where it is no whole number within its bounds."""
    low, high = bounds
    try:
        number = index(value)
    except TypeError:
        number = low - 1
    if isinstance(value, bool) or not low <= number <= high:
        raise MindError(f"{what} cannot be {value!r:.40}", f"{what} is a whole number from {low} to {high}")
    return number
