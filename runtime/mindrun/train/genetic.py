"""A genetic algorithm with ask and tell: plain arrays, the rng passed in, the state apart from the parameters."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mindrun.learners import Genetic

Genomes = NDArray[np.float32]
Scores = NDArray[np.float64]
Draw = Callable[[int, np.random.Generator], Genomes]  # so many random genomes

LIMIT = 100.0  # no weight grows beyond it, so a genome is finite always
TOURNAMENT = 4


@dataclass(frozen=True, slots=True)
class Population:
    """What has been learnt so far: the last `genomes` [individuals, weights], their `scores` [individuals], its number.

    Generation 0 has no genomes yet.
    """

    genomes: Genomes
    scores: Scores
    generation: int


def nobody(weights: int) -> Population:
    """The population before the first generation, for genomes of so many weights."""
    return Population(np.empty((0, weights), np.float32), np.empty(0), 0)


def ask(population: Population, learner: Genetic, start: Genomes, draw: Draw, rng: np.random.Generator) -> Genomes:
    """The genomes [individuals, weights] to score next: the founders, then generations of `learner.population`.

    `start` [0 or 1, weights] is what the skill knows; where it knows nothing, `draw` has random genomes.
    """
    if population.generation > 0:
        return breed(population, learner, rng)
    return bounded(variants(start, learner, rng) if len(start) else draw(founder_count(learner), rng))


def tell(population: Population, learner: Genetic, genomes: Genomes, scores: Scores) -> Population:
    """The next population: the best of these genomes, by what they scored; what is not a number counts as -inf."""
    scores, most = worst_if_nan(scores), learner.population
    if len(genomes) > most:  # founders
        best = order(scores)[:most]
        genomes, scores = genomes[best], scores[best]
    return Population(genomes, scores, population.generation + 1)


def founder_count(learner: Genetic) -> int:
    """How many random genomes the first population is chosen from."""
    return max(learner.founders, learner.population)


def variants(start: Genomes, learner: Genetic, rng: np.random.Generator) -> Genomes:
    """What the skill knows, `start`, and mutated copies of it."""
    copies = np.repeat(start, learner.population - 1, axis=0)
    return np.concatenate([start, mutate(copies, learner, rng)])


def breed(population: Population, learner: Genetic, rng: np.random.Generator) -> Genomes:
    """The elite unchanged, then children of two chosen parents each, mutated."""
    ranked = population.genomes[order(population.scores)]
    elite = min(max(1, round(learner.elite * len(ranked))), len(ranked) - 1)
    children = learner.population - elite
    mothers, fathers = choose(len(ranked), children, rng), choose(len(ranked), children, rng)
    mixed = cross(ranked[mothers], ranked[fathers], rng)
    return bounded(np.concatenate([ranked[:elite], mutate(mixed, learner, rng)]))


def order(scores: Scores) -> NDArray[np.intp]:
    """The indices of the individuals, best first; equal scores keep their order, NaN comes last."""
    return np.argsort(-worst_if_nan(scores), kind="stable")


def choose(individuals: int, count: int, rng: np.random.Generator) -> NDArray[np.intp]:
    """The ranks [count] of the winners of `count` tournaments (rank 0 is the best individual)."""
    winners: NDArray[np.intp] = rng.integers(individuals, size=(count, TOURNAMENT), dtype=np.intp).min(axis=1)
    return winners


def cross(mothers: Genomes, fathers: Genomes, rng: np.random.Generator) -> Genomes:
    """Children [individuals, weights] that take each weight from either parent."""
    return np.where(rng.random(mothers.shape, np.float32) < 0.5, mothers, fathers)


def mutate(genomes: Genomes, learner: Genetic, rng: np.random.Generator) -> Genomes:
    """The genomes with a share `mutated` of their weights moved by a normal step of spread `mutation`.

    With `octaves` each genome has a share and a spread of its own: these times a power of two.
    """
    share, spread = np.full((2, len(genomes), 1), [[[learner.mutated]], [[learner.mutation]]], np.float32)
    if learner.octaves:
        powers = rng.integers(-learner.octaves, learner.octaves, size=(2, len(genomes), 1), endpoint=True)
        share, spread = np.ldexp((share, spread), powers)
    hit = rng.random(genomes.shape, np.float32) < share
    step = spread * rng.standard_normal(genomes.shape, np.float32)
    return genomes + np.where(hit, step, np.float32(0))


def bounded(genomes: Genomes) -> Genomes:
    """The genomes with every weight finite and within ±LIMIT."""
    return np.clip(np.nan_to_num(genomes, nan=0.0), -LIMIT, LIMIT).astype(np.float32, copy=False)


def worst_if_nan(scores: Scores) -> Scores:
    """The scores with -inf for NaN and for +inf, which no honest reward adds up to."""
    return np.where(np.isfinite(scores), scores, -np.inf)
