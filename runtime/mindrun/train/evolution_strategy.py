"""An evolution strategy with ask and tell: (μ/μ, λ) with steps of one size (Beyer and Schwefel, 2002).

A population is one genome, the centre: those that were drawn around it are forgotten once it has moved.
"""

import numpy as np

from mindrun.kinds.learners import EvolutionStrategy
from mindrun.train.population import Genomes, Population, Scores, bounded, order

GENOMES_PER_PARENT = 4  # one genome in so many has a say in where the centre goes


def ask(population: Population, learner: EvolutionStrategy, start: Genomes, rng: np.random.Generator) -> Genomes:
    """The genomes [individuals, weights] to score next, around the centre: at first `start` [1, weights]."""
    centre = _centre(population, start)
    steps = rng.standard_normal((learner.population, centre.shape[1]), np.float32)
    return bounded(centre + np.float32(learner.mutation) * steps)


def tell(population: Population, genomes: Genomes, scores: Scores, start: Genomes) -> Population:
    """The next centre: the mean of the best quarter, weighted by rank; the best alone of founders, which lie apart.

    Where no genome was without a fault the centre stays. Its score is the weighted mean of theirs.
    """
    before, ranked, generation = _centre(population, start), order(scores), population.generation + 1
    if not len(before):
        return Population(genomes[ranked[:1]], scores[ranked[:1]], generation)
    parents = ranked[: len(genomes) // GENOMES_PER_PARENT]
    parents = parents[np.isfinite(scores[parents])]
    if not len(parents):
        return Population(before, np.full(1, -np.inf), generation)
    shares = np.arange(len(parents), 0, -1) / (len(parents) * (len(parents) + 1) / 2)
    centre, score = np.zeros(genomes.shape[1]), 0.0
    for share, parent in zip(shares, parents, strict=True):  # in this order: the same bits on every processor
        centre += share * genomes[parent]
        score += float(share * scores[parent])
    return Population(bounded(centre[None].astype(np.float32)), np.full(1, score), generation)


def _centre(population: Population, start: Genomes) -> Genomes:
    """What genomes are drawn around [0 or 1, weights]; before the first generation what the skill knows, `start`."""
    return population.genomes if population.generation else start
