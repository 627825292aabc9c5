"""Where all random numbers come from: (run seed, attempt, generation, purpose), so that no rng state is ever saved."""

from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

Seeds = NDArray[np.uint64]


class Purpose(IntEnum):
    """What the numbers are drawn for; each purpose has its own stream."""

    BREEDING = 0
    LAYOUTS = 1
    REEVALUATION = 2
    VERDICT = 3
    COMPARISON = 4
    RUNG = 5


def breeding_generator(seed: int, attempt: int, generation: int) -> np.random.Generator:
    """The rng that breeds one generation."""
    return np.random.default_rng(_sequence(seed, attempt, generation, Purpose.BREEDING))


def layouts(seed: int, attempt: int, generation: int, count: int, purpose: Purpose = Purpose.LAYOUTS) -> Seeds:
    """The seeds [count] of the worlds on which one generation is scored, the same for every genome."""
    return _sequence(seed, attempt, generation, purpose).generate_state(count, np.uint64).astype(np.uint64)


def _sequence(seed: int, attempt: int, generation: int, purpose: Purpose) -> np.random.SeedSequence:
    return np.random.SeedSequence(seed, spawn_key=(attempt, generation, int(purpose)))
