"""Measuring what minds do: many runs of a task, and how many attempts of a lesson have succeeded."""

from dataclasses import dataclass
from functools import cache
from math import sqrt
from pathlib import Path

import numpy as np
from mindrun.sim.rollout import Rollout, cores
from mindrun.weights import Weights
from protocol import Case

from mindlang.compile import Compiled, load
from mindlang.lock.ready import make_ready
from mindlang.run.casting import CastingError, cast
from mindlang.run.stage import NOBODY, layouts


@dataclass(frozen=True, slots=True)
class Measured:
    """Objects in a run with the standard error of their mean, and the share of its time that a run lasted."""

    objects: float
    error: float
    runtime: float
    runs: int

    def text(self, interrupt: bool) -> str:
        """As in a table; without interruption every run lasts its time."""
        return f"{self.objects:.2f} ± {self.error:.2f}" + (f" ({self.runtime:.1%})" if interrupt else "")


def measure(folder: Path, case: Case, runs: int, seed: int) -> Measured | None:
    """A case on so many layouts, with the weights that lie in a folder; None where some are missing."""
    try:
        found = cast(str(folder / case.file), compiled(folder / case.file), case.task, case.master)
    except CastingError:
        return None
    rollout = found.rollout(case.interrupt, cores())
    scores = rollout.score(NOBODY, layouts(seed, runs))
    counts = scores.counts[0]
    error = float(counts.std(ddof=1)) / sqrt(runs) if runs > 1 else 0.0
    return Measured(float(counts.mean()), error, float(scores.ticks[0].mean()) / rollout.task.ticks, runs)


def champions_do(folder: Path, file: str, lesson: str, champions: Weights, runs: int, seed: int) -> list[float]:
    """What each champion [attempts, weights] of a lesson counts in a run, on the mean over so many layouts."""
    graph = compiled(folder / file).graph
    assert graph is not None
    task = next(written.task for written in graph.lessons if written.skill == lesson)
    ready = make_ready(graph, compiled(folder / file).sources, lesson)
    rollout = Rollout(ready.graph, ready.weights, task, lesson, [lesson], procedures=folder, workers=cores())
    return [float(mean) for mean in rollout.score(champions, layouts(seed, runs)).counts.mean(axis=1)]


@cache
def compiled(path: Path) -> Compiled:
    """A file, compiled once."""
    found = load(path)
    assert found.graph is not None, [diagnostic.message for diagnostic in found.diagnostics]
    return found


def read_champions(path: Path) -> Weights:
    """The champions [attempts, weights] of a log."""
    champions: Weights = np.load(path, allow_pickle=False)
    return champions
