"""The layouts of many runs, and the genome of a run in which nobody learns."""

import numpy as np

from mindlang.limits import as_runs, as_seed

NO_GENOME = np.zeros((1, 0), np.float32)  # the genome where nobody learns


def layouts(seed: int, runs: int) -> list[int]:
    """The seeds of so many runs; MindError where these are none."""
    seed, runs = as_seed(seed), as_runs(runs)
    return [int(word) for word in np.random.SeedSequence(seed).generate_state(runs, np.uint64)]
