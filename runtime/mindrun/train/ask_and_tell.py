"""Ask and tell of every kind of learner: which genomes to score next, and what is learnt from their scores."""

import numpy as np

from mindrun.kinds.learners import EvolutionStrategy, Genetic, Learner
from mindrun.train import evolution_strategy, genetic
from mindrun.train.population import Draw, Genomes, Population, Scores, bounded, founder_count, worst_if_nan


def ask(population: Population, learner: Learner, start: Genomes, draw: Draw, rng: np.random.Generator) -> Genomes:
    """The genomes [individuals, weights] to score next: the founders, then generations of `learner.population`.

    `start` [0 or 1, weights] is what the skill knows; where it knows nothing, `draw` has random genomes.
    """
    if population.generation == 0 and not len(start):
        return bounded(draw(founder_count(learner), rng))
    match learner:
        case Genetic():
            return genetic.ask(population, learner, start, rng)
        case EvolutionStrategy():
            return evolution_strategy.ask(population, learner, start, rng)


def tell(population: Population, learner: Learner, start: Genomes, genomes: Genomes, scores: Scores) -> Population:
    """The next population, by what these genomes scored; what is not a number counts as -inf."""
    scores = worst_if_nan(scores)
    match learner:
        case Genetic():
            return genetic.tell(population, learner, genomes, scores)
        case EvolutionStrategy():
            return evolution_strategy.tell(population, genomes, scores, start)


def kept_count(learner: Learner) -> int:
    """How many genomes a population has between two generations."""
    return learner.population if isinstance(learner, Genetic) else 1
