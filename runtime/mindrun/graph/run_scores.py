"""What comes of runs: an array for each figure."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mindrun.numbers.short_repr import ShortRepr


@dataclass(frozen=True, slots=True, repr=False)
class Scores(ShortRepr):
    """What came of every genome on every seed: arrays [genomes, seeds].

    `total` is −∞ where a reward was not a number; `by_line` [genomes, seeds, lines] sums each reward line; `counts` are
    all events that the task counts together, `by_event` [genomes, seeds, events] each event of the task; `ended_by` is
    an index into the task's ends, −1 where the run lasted its time, −2 where the robot was beyond all places (FAR), −4
    where its environment broke it off;
    `met` is the end that came first, −1 where none did, also where a run goes on behind it; `faults` counts values that
    were not sent, and such a flight.
    """

    total: NDArray[np.float64]
    by_line: NDArray[np.float64]
    counts: NDArray[np.int64]
    by_event: NDArray[np.int64]
    ticks: NDArray[np.int64]
    ended_by: NDArray[np.int64]
    met: NDArray[np.int64]
    faults: NDArray[np.int64]
