"""How a lesson was learnt on average: the mean of all attempts of its runs, with the standard error of that mean."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindlang.pictures.learning_log import Curve


@dataclass(frozen=True, slots=True)
class MeanPoint:
    """The mean of a score after a generation; its standard error, which one attempt alone does not have."""

    generation: int
    mean: float
    error: float | None


@dataclass(frozen=True, slots=True)
class MeanCurve:
    """The runs of one lesson, which differ in their seeds; `note` tells it from others of its name."""

    name: str
    note: str
    runs: Sequence[Curve]

    @property
    def attempts(self) -> int:
        """How many attempts all runs have begun."""
        return sum(len(run.attempts) for run in self.runs)

    @property
    def generations(self) -> int:
        """How far the mean goes: to the end of the longest attempt, or as far as all have come that still go on."""
        every = [(run, attempt) for run in self.runs for attempt in run.attempts]
        going_on = [run.last(attempt) for run, attempt in every if not run.has_ended(attempt)]
        return min(going_on, default=max(run.last(attempt) for run, attempt in every))

    def points(self, column: str) -> list[MeanPoint]:
        """The mean of a score at every generation that has one; none where an attempt never had a finite one.

        An attempt that has ended, or was given up, has come to what it had last: it keeps it, so that the mean does not
        rise because the bad ones are gone.
        """
        found = [run.points(attempt, column) for run in self.runs for attempt in run.attempts]
        if not all(found):
            return []
        tracks = [tuple(zip(*track, strict=True)) for track in found]  # generations, and their scores
        known = np.unique(np.concatenate([generations for generations, _ in tracks]))
        known = known[(known >= max(generations[0] for generations, _ in tracks)) & (known <= self.generations)]
        had_last = [np.array(scores)[np.searchsorted(made, known, side="right") - 1] for made, scores in tracks]
        return [_mean(*each) for each in zip(known.tolist(), np.stack(had_last, axis=1), strict=True)]

    def verdict(self) -> MeanPoint | None:
        """The mean of what the attempts came to, on layouts that chose nothing; None while one goes on."""
        verdicts = [run.points(attempt, "verdict") for run in self.runs for attempt in run.attempts]
        return _mean(self.generations, [track[-1][1] for track in verdicts]) if all(verdicts) else None

    def data(self) -> dict[str, Any]:
        """The figures of the mean curve by their names, as plain data."""
        verdict = self.verdict()
        return {
            "name": self.name,
            "runs": [str(run.path) for run in self.runs],
            "attempts": self.attempts,
            "generations": self.generations,
            "verdict_mean": verdict.mean if verdict else None,
            "verdict_standard_error": verdict.error if verdict else None,
        }


def by_lesson(curves: Iterable[Curve]) -> list[MeanCurve]:
    """The curves whose runs teach the same lesson of the same mind together; tables of logs by their name."""
    groups: dict[tuple[str, str], list[Curve]] = {}
    for curve in curves:
        groups.setdefault((curve.name, curve.lesson), []).append(curve)
    return [MeanCurve(name, _note(runs), runs) for (name, _), runs in groups.items()]


def _note(runs: Sequence[Curve]) -> str:
    attempts = sum(len(run.attempts) for run in runs)
    failed = sum(bool(run.failure) for run in runs)
    told = f"{attempts} attempt{'s' * (attempts > 1)} in {len(runs)} run{'s' * (len(runs) > 1)}"
    return f"{told}, {failed} of them failed" if failed else told


def _mean(generation: int, scores: Sequence[float] | NDArray[np.float64]) -> MeanPoint:
    error = float(np.std(scores, ddof=1)) / sqrt(len(scores)) if len(scores) > 1 else None
    return MeanPoint(generation, float(np.mean(scores)), error)
