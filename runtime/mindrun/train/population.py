"""Genomes and what they scored: what all learners share."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mindrun.kinds.learners import Learner

Genomes = NDArray[np.float32]
Scores = NDArray[np.float64]
Draw = Callable[[int, np.random.Generator], Genomes]  # so many random genomes

MAX_WEIGHT = 100.0  # no weight grows beyond it, so a genome is finite always


@dataclass(frozen=True, slots=True)
class Population:
    """A generation, by its number: `genomes` [individuals, weights] to breed the next from, `scores` [individuals].

    Generation 0 has none yet.
    """

    genomes: Genomes
    scores: Scores
    generation: int


def empty_population(weights: int) -> Population:
    return Population(np.empty((0, weights), np.float32), np.empty(0), 0)


def founder_count(learner: Learner) -> int:
    """The number of random genomes that the first population is chosen from."""
    return max(learner.founders, learner.population)


def order(scores: Scores) -> NDArray[np.intp]:
    """The indices of the individuals, best first; equal scores keep their order, NaN comes last."""
    return np.argsort(-worst_if_nan(scores), kind="stable")


def bounded(genomes: Genomes) -> Genomes:
    """The genomes with every weight finite (0 for NaN) and within ±MAX_WEIGHT."""
    return np.clip(np.nan_to_num(genomes, nan=0.0), -MAX_WEIGHT, MAX_WEIGHT).astype(np.float32, copy=False)


def worst_if_nan(scores: Scores) -> Scores:
    """The scores with -inf for NaN and for +inf, which no honest reward adds up to."""
    return np.where(np.isfinite(scores), scores, -np.inf)
