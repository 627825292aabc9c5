"""Genomes scored on layouts, by whatever simulates them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mindrun.graph.graph import Task
from mindrun.train.population import Genomes, Scores
from mindrun.train.seeds import Seeds


class Results(Protocol):
    """What a scorer measured: arrays [genomes, seeds]."""

    @property
    def total(self) -> NDArray[np.float64]:
        """The sum of the rewards; -inf where something was not finite."""

    @property
    def ticks(self) -> NDArray[np.int64]:
        """How long each evaluation lasted."""

    @property
    def faults(self) -> NDArray[np.int64]:
        """How many numbers were not finite."""

    @property
    def met(self) -> NDArray[np.int64]:
        """The end of the task that came first; -1 where none did."""


class Scorer(Protocol):
    """What scores genomes: `mindrun.sim.rollout.Rollout`, or anything of its shape."""

    @property
    def genome_length(self) -> int:
        """How many weights the learner has."""

    @property
    def task(self) -> Task:
        """What the genomes are scored in."""

    def draw(self, count: int, rng: np.random.Generator) -> Genomes:
        """Random genomes [count, genome_length] for learning to begin with."""

    def score(self, genomes: Any, seeds: Any) -> Results:
        """Every genome on every seed; a result depends on its genome and its seed alone."""


@dataclass(frozen=True, slots=True)
class Marks:
    """Scores of genomes: `each` [genomes, layouts], their means `scores` [genomes]; ticks and faults in all."""

    each: Scores
    scores: Scores
    ticks: int
    faults: int


def is_one_world(scorer: Scorer) -> bool:
    """Whether a scorer says that every seed is the same world to it; most have never heard of that."""
    return bool(getattr(scorer, "is_one_world", False))


def mark(scorer: Scorer, genomes: Genomes, seeds: Seeds | Sequence[int]) -> Marks:
    """Score every genome on every seed; a genome with a fault anywhere has -inf.

    Where all worlds are one a genome has one run, whose score stands for all of its seeds.
    """
    if not is_one_world(scorer):
        return marks_of(scorer.score(genomes, seeds))
    marks = marks_of(scorer.score(genomes, seeds[:1]))
    return replace(marks, each=np.repeat(marks.each, len(seeds), axis=1))


def marks_of(results: Results) -> Marks:
    """The scores in what was measured; a genome with a fault anywhere has -inf."""
    faulty = (results.faults > 0) | ~np.isfinite(results.total)
    each = np.where(faulty, -inf, results.total)
    return Marks(each, each.mean(axis=1), int(results.ticks.sum()), int(faulty.sum()))


def succeeded(task: Task, results: Results) -> NDArray[np.bool_]:
    """Which runs [genomes, seeds] are a success: one came before any other end, whether or not it ended them."""
    successes = [number for number, end in enumerate(task.ends) if end.succeeds]
    return np.isin(results.met, successes)
