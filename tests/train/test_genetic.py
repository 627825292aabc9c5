"""The genetic algorithm by itself."""

import numpy as np
import pytest
from mindrun.learners import Genetic
from mindrun.train import genetic
from mindrun.train.genetic import ask, nobody, order, tell

LEARNER = Genetic(population=100)
UNKNOWN = np.empty((0, 10), np.float32)


def evolve(generations: int, start: np.ndarray = UNKNOWN, learner: Genetic = LEARNER) -> genetic.Population:
    population = nobody(start.shape[1])
    for generation in range(generations):
        genomes = ask(population, learner, start, np.random.default_rng(generation))
        population = tell(population, genomes, -((genomes.astype(float) - 1) ** 2).sum(axis=1))
    return population


def test_it_climbs_down_a_sphere() -> None:
    assert evolve(100).scores.max() > -0.05


def test_the_elite_is_never_lost() -> None:
    best = [evolve(generations).scores.max() for generations in (1, 5, 10, 20)]
    assert best == sorted(best)


def test_the_same_rng_gives_the_same_genomes() -> None:
    np.testing.assert_array_equal(evolve(5).genomes, evolve(5).genomes)


def test_what_is_known_stands_in_the_first_population_with_mutated_copies() -> None:
    known = np.full((1, 10), 3.0, np.float32)
    first = evolve(1, known).genomes
    np.testing.assert_array_equal(first[0], known[0])
    assert 0 < (first[1:] != 3.0).mean() < 0.3


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_a_score_that_is_not_finite_ranks_last(bad: float) -> None:
    assert order(np.array([1.0, bad, 3.0, -1e300]))[-1] == 1


def test_genomes_stay_finite_float32_under_absurd_mutation() -> None:
    wild = Genetic(population=10, mutation=1e38, mutated=1.0)
    genomes = evolve(20, learner=wild).genomes
    assert genomes.dtype == np.float32
    assert np.isfinite(genomes).all()


def test_a_population_of_only_bad_scores_breeds_on() -> None:
    population = tell(nobody(4), np.ones((10, 4), np.float32), np.full(10, np.nan))
    assert ask(population, Genetic(population=10), UNKNOWN, np.random.default_rng(0)).shape == (10, 4)


@pytest.mark.parametrize("elite", [0.0, 0.5, 1.0])
def test_any_share_of_elite_leaves_room_for_one_survivor_and_one_child(elite: float) -> None:
    genomes = evolve(3, learner=Genetic(population=4, elite=elite)).genomes
    assert genomes.shape == (4, 10)


def test_with_octaves_each_child_has_steps_of_its_own_size() -> None:
    known = np.zeros((1, 400), np.float32)
    learner = Genetic(population=200, octaves=3)
    children = ask(nobody(400), learner, known, np.random.default_rng(1))[1:]
    shares = (children != 0).mean(axis=1)
    spreads = np.array([child[child != 0].std() for child in children])
    assert shares.min() < learner.mutated / 4
    assert shares.max() > learner.mutated * 6
    assert spreads.min() < learner.mutation / 6
    assert spreads.max() > learner.mutation * 6
