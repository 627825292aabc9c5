"""A genetic algorithm with ask and tell: plain arrays, the rng passed in, the state apart from the parameters."""

import numpy as np
from numpy.typing import NDArray

from mindrun.kinds.learners import Genetic
from mindrun.train.population import Genomes, Population, Scores, bounded, order

TOURNAMENT_SIZE = 4


def ask(population: Population, learner: Genetic, start: Genomes, rng: np.random.Generator) -> Genomes:
    """The genomes [individuals, weights] to score next: at first what the skill knows, `start` [1, weights], varied."""
    return breed(population, learner, rng) if population.generation else bounded(variants(start, learner, rng))


def tell(population: Population, learner: Genetic, genomes: Genomes, scores: Scores) -> Population:
    """The next population: these genomes, or the best of them where there are more, as of founders."""
    if len(genomes) > learner.population:
        best = order(scores)[: learner.population]
        genomes, scores = genomes[best], scores[best]
    return Population(genomes, scores, population.generation + 1)


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


def choose(individuals: int, count: int, rng: np.random.Generator) -> NDArray[np.intp]:
    """The ranks [count] of the winners of `count` tournaments (rank 0 is the best individual)."""
    winners: NDArray[np.intp] = rng.integers(individuals, size=(count, TOURNAMENT_SIZE), dtype=np.intp).min(axis=1)
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
