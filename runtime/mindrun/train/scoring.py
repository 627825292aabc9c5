"""Genomes scored on layouts, by whatever simulates them."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

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


class Scorer(Protocol):
    """What scores genomes: `mindrun.sim.rollout.Rollout`, or anything of its shape."""

    @property
    def genome_length(self) -> int:
        """How many weights the learner has."""

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


def mark(scorer: Scorer, genomes: Genomes, seeds: Seeds | Sequence[int]) -> Marks:
    """Score every genome on every seed; a genome with a fault anywhere has -inf."""
    results = scorer.score(genomes, seeds)
    faulty = (results.faults > 0) | ~np.isfinite(results.total)
    each = np.where(faulty, -inf, results.total)
    return Marks(each, each.mean(axis=1), int(results.ticks.sum()), int(faulty.sum()))
