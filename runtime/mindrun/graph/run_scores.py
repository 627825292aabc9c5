"""The results of runs: an array for each figure, and what reward lines have paid, added up.

Reward lines are always added in the order of the source, so that all come to the same bits.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.graph.graph import Reward
from mindrun.numbers.arrays import Doubles
from mindrun.numbers.short_repr import ShortRepr


@dataclass(frozen=True, slots=True, repr=False)
class Scores(ShortRepr):
    """The results of every genome on every seed: arrays [genomes, seeds].

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


def score_of(paid: Doubles) -> Any:
    """The sums [...] of what all lines have paid [..., lines]."""
    found = np.zeros(paid.shape[:-1])
    for line in range(paid.shape[-1]):
        found = found + paid[..., line]
    return found


def paid_by_text(rewards: Sequence[Reward], paid: Doubles) -> dict[str, Any]:
    """The sums [...] of what reward lines of one text have paid, by text; `paid` [..., lines] is that of each line."""
    found: dict[str, Any] = {}
    for line, reward in enumerate(rewards):
        found[reward.text] = found.get(reward.text, 0.0) + paid[..., line]
    return found
