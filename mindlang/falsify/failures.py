"""Failures of runs: which runs have failed, how bad each run is, and the share of failures with its interval."""

from collections import Counter
from dataclasses import dataclass
from math import sqrt
from typing import NamedTuple, Self

import numpy as np
from mindrun.graph.graph import Task
from mindrun.graph.run_scores import Scores
from mindrun.sim.codes import LOST
from mindrun.train.scoring import succeeded
from numpy.typing import NDArray

from mindlang.number_format import score
from mindlang.run.outcome import TIME, ended_by

NORMAL_TWO_SIDED = 1.959963984540054  # standard errors about a mean that hold 95 % of a normal distribution
DEFAULT_SHARE = 0.5  # of the median of all runs, below which a run fails where nothing else says what a failure is

Mask = NDArray[np.bool_]


class Rate(NamedTuple):
    """A share of runs, and the 95 % interval of Wilson (1927) for it, which is sound near 0 and 1, too."""

    failures: int
    runs: int
    low: float
    high: float

    @property
    def share(self) -> float:
        return self.failures / self.runs if self.runs else 0.0

    @classmethod
    def of(cls, failures: int, runs: int) -> Self:
        """The rate of so many failures in so many runs; of no run it is from 0 to 1."""
        if not runs:
            return cls(0, 0, 0.0, 1.0)
        share, z = failures / runs, NORMAL_TWO_SIDED
        middle, half = share + z**2 / (2 * runs), z * sqrt(share * (1 - share) / runs + z**2 / (4 * runs**2))
        low, high = ((middle + side * half) / (1 + z**2 / runs) for side in (-1, 1))
        return cls(failures, runs, low if failures else 0.0, high if failures < runs else 1.0)


@dataclass(frozen=True, slots=True)
class Criterion:
    """A criterion of failure in a task: a run fails that ends on what is no success, or does not succeed where it can.

    Also one with a score below `below`, one with fewer counted events than `fewer`, and one with a fault.
    """

    task: Task
    below: float | None = None
    fewer: float | None = None

    def failed(self, scores: Scores) -> Mask:
        """A mask [runs] of the runs of one genome that have failed."""
        success = succeeded(self.task, scores)[0]
        bad = (scores.faults[0] > 0) | (scores.ended_by[0] == LOST)
        bad |= ~success if self.task.can_succeed else scores.met[0] >= 0
        if self.below is not None:
            bad |= scores.total[0] < self.below
        if self.fewer is not None:
            bad |= scores.counts[0] < self.fewer
        return np.asarray(bad)

    def worst_first(self, scores: Scores) -> NDArray[np.intp]:
        """The runs [runs] of one genome, failures first, of these the fewest counts and the lowest score first."""
        counts = scores.counts[0] if self.fewer is not None else np.zeros(len(scores.total[0]))
        return np.lexsort((scores.total[0], counts, ~self.failed(scores)))

    def with_default(self, scores: Scores) -> Self:
        """The criterion itself; where it says nothing, with half of the median of these runs as the least."""
        if self.below is not None or self.fewer is not None or self.task.ends:
            return self
        if self.task.counts:
            return type(self)(self.task, None, DEFAULT_SHARE * float(np.median(scores.counts[0])))
        middle = float(np.median(scores.total[0]))
        return type(self)(self.task, middle - (1 - DEFAULT_SHARE) * abs(middle), None)

    @property
    def words(self) -> str:
        """The criterion, behind `fails: a run that`."""
        said = ["does not succeed"] if self.task.can_succeed else ["ends before its time"] if self.task.ends else []
        said += [f"scores below {score(self.below)}"] if self.below is not None else []
        said += [f"counts fewer than {self.fewer:g}"] if self.fewer is not None else []
        return " or ".join([*said, "has a fault"])

    def causes(self, scores: Scores) -> dict[str, int]:
        """The failures by what ended them, the most frequent first."""
        ended = Counter(scores.ended_by[0][self.failed(scores)].tolist())
        return {ended_by(self.task, number) or TIME: times for number, times in ended.most_common()}
