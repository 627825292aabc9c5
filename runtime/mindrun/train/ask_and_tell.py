"""Ask and tell of every kind of learner: which genomes to score next, and what is learnt from their scores.

Plain arrays, the generator passed in, the state apart from the parameters. The genetic algorithm breeds the next
population. The evolution strategy is (μ/μ, λ) with steps of one size (Beyer and Schwefel, 2002): its population is one
genome, the centre, and those that were drawn around it are forgotten once it has moved.
"""

import numpy as np
from numpy.typing import NDArray

from mindrun.kinds.learners import Genetic, Learner
from mindrun.train.heredity import Heredity
from mindrun.train.population import Draw, Genomes, Population, Scores, bounded, founder_count, order, worst_if_nan
from mindrun.train.species import choose_parents, species_of

PLAIN = Heredity()
TOURNAMENT_SIZE = 4
GENOMES_PER_PARENT = 4  # of an evolution strategy: one genome in so many has a say in where the centre goes


def ask(
    population: Population,
    learner: Learner,
    start: Genomes,
    draw: Draw,
    rng: np.random.Generator,
    of: Heredity = PLAIN,
) -> Genomes:
    """The genomes [individuals, weights] to score next: the founders, then generations of `learner.population`.

    `start` [0 or 1, weights] is what the skill knows, and the first to be bred are that and mutated copies of it; where
    it knows nothing, `draw` has random genomes.
    """
    if population.generation == 0 and not len(start):
        return bounded(draw(founder_count(learner), rng))
    if isinstance(learner, Genetic):
        return breed(population, learner, rng, of) if population.generation else variants(start, learner, rng, of)
    centre = _centre(population, start)
    steps = rng.standard_normal((learner.population, centre.shape[1]), np.float32)
    return bounded(of.moved(centre, np.float32(learner.mutation) * steps))


def tell(population: Population, learner: Learner, start: Genomes, genomes: Genomes, scores: Scores) -> Population:
    """The next population, by what these genomes scored; what is not a number counts as -inf."""
    scores = worst_if_nan(scores)
    if not isinstance(learner, Genetic):
        return _tell_strategy(population, genomes, scores, start)
    if len(genomes) > learner.population:  # as of founders
        best = order(scores)[: learner.population]
        genomes, scores = genomes[best], scores[best]
    return Population(genomes, scores, population.generation + 1)


def kept_count(learner: Learner) -> int:
    """How many genomes a population has between two generations."""
    return learner.population if isinstance(learner, Genetic) else 1


def variants(start: Genomes, learner: Genetic, rng: np.random.Generator, of: Heredity = PLAIN) -> Genomes:
    """The first genomes [individuals, weights]: what the skill knows, `start` [1, weights], and mutated copies."""
    copies = np.repeat(start, learner.population - 1, axis=0)
    return bounded(np.concatenate([start, mutate(copies, learner, rng, of)]))


def breed(population: Population, learner: Genetic, rng: np.random.Generator, of: Heredity = PLAIN) -> Genomes:
    """The elite unchanged, of species their leaders, then children of two chosen parents each, mutated."""
    ranked = population.genomes[order(population.scores)]
    elite = min(max(1, round(learner.elite * len(ranked))), len(ranked) - 1)
    children = learner.population - elite
    kept = np.arange(elite)
    if learner.species:
        leaders, species = species_of(ranked, learner.species, of.distance)
        kept = np.concatenate([leaders, np.setdiff1d(kept, leaders)])[:elite]
        mothers, fathers = choose_parents(species, TOURNAMENT_SIZE, children, rng)
    else:
        mothers, fathers = choose(len(ranked), children, rng), choose(len(ranked), children, rng)
    first = rng.random((children, ranked.shape[1]), np.float32) < 0.5
    mixed = of.crossed(ranked[mothers], ranked[fathers], first, (mothers <= fathers)[:, None])
    return bounded(np.concatenate([ranked[kept], mutate(mixed, learner, rng, of)]))


def choose(individuals: int, count: int, rng: np.random.Generator) -> NDArray[np.intp]:
    """The ranks [count] of the winners of `count` tournaments (rank 0 is the best individual)."""
    winners: NDArray[np.intp] = rng.integers(individuals, size=(count, TOURNAMENT_SIZE), dtype=np.intp).min(axis=1)
    return winners


def mutate(genomes: Genomes, learner: Genetic, rng: np.random.Generator, of: Heredity = PLAIN) -> Genomes:
    """The genomes with a share `mutated` of their weights moved by a normal step of spread `mutation`, some grown.

    With `octaves` each genome has a share and a spread of its own: these times a power of two.
    """
    share, spread = np.full((2, len(genomes), 1), [[[learner.mutated]], [[learner.mutation]]], np.float32)
    if learner.octaves:
        powers = rng.integers(-learner.octaves, learner.octaves, size=(2, len(genomes), 1), endpoint=True)
        share, spread = np.ldexp((share, spread), powers)
    hit = rng.random(genomes.shape, np.float32) < share
    step = spread * rng.standard_normal(genomes.shape, np.float32)
    return of.grown(of.moved(genomes, np.where(hit, step, np.float32(0))), learner, rng)


def _tell_strategy(population: Population, genomes: Genomes, scores: Scores, start: Genomes) -> Population:
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
    """The genome [0 or 1, weights] that others are drawn around; before the first generation `start`."""
    return population.genomes if population.generation else start
