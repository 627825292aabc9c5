"""The genetic algorithm by itself."""

import numpy as np
import pytest
from mindrun.kinds.learners import Genetic
from mindrun.train import ask_and_tell as genetic
from mindrun.train.ask_and_tell import ask, tell
from mindrun.train.population import Genomes, Population, bounded, empty_population, order

LEARNER = Genetic(population=100)
UNKNOWN = np.empty((0, 10), np.float32)


def draw(count: int, rng: np.random.Generator) -> Genomes:
    return 4 * rng.standard_normal((count, 10), np.float32)


def evolve(generations: int, start: np.ndarray = UNKNOWN, learner: Genetic = LEARNER) -> Population:
    population = empty_population(start.shape[1])
    for generation in range(generations):
        genomes = ask(population, learner, start, draw, np.random.default_rng(generation))
        population = tell(population, learner, start, genomes, -((genomes.astype(float) - 1) ** 2).sum(axis=1))
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
    assert first.shape == (Genetic().population, 10)
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
    population = tell(empty_population(4), LEARNER, UNKNOWN, np.ones((10, 4), np.float32), np.full(10, np.nan))
    assert ask(population, Genetic(population=10), UNKNOWN, draw, np.random.default_rng(0)).shape == (10, 4)


@pytest.mark.parametrize("elite", [0.0, 0.5, 1.0])
def test_any_share_of_elite_leaves_room_for_one_survivor_and_one_child(elite: float) -> None:
    genomes = evolve(3, learner=Genetic(population=4, elite=elite)).genomes
    assert genomes.shape == (4, 10)


def test_with_octaves_each_child_has_steps_of_its_own_size() -> None:
    known = np.zeros((1, 400), np.float32)
    learner = Genetic(population=200, octaves=3)
    children = ask(empty_population(400), learner, known, draw, np.random.default_rng(1))[1:]
    shares = (children != 0).mean(axis=1)
    spreads = np.array([child[child != 0].std() for child in children])
    assert shares.min() < learner.mutated / 4
    assert shares.max() > learner.mutated * 6
    assert spreads.min() < learner.mutation / 6
    assert spreads.max() > learner.mutation * 6


# What chance does, on the whole


def rng() -> np.random.Generator:
    return np.random.default_rng(1)


def test_the_first_population_is_the_best_of_its_founders() -> None:
    learner = Genetic(population=10, founders=200)
    founders = ask(empty_population(10), learner, UNKNOWN, draw, rng())
    np.testing.assert_array_equal(founders, draw(200, rng()))
    scores = founders[:, 0].astype(float)
    scores[:3] = np.nan, np.inf, -np.inf
    first = tell(empty_population(10), learner, UNKNOWN, founders, scores)
    assert first.scores.tolist() == sorted(scores[3:], reverse=True)[:10]
    np.testing.assert_array_equal(first.genomes[:, 0], first.scores)
    assert ask(first, learner, UNKNOWN, draw, rng()).shape == (10, 10)


def test_founders_are_never_fewer_than_the_population_and_what_is_known_has_none() -> None:
    learner = Genetic(population=10, founders=3)
    assert ask(empty_population(10), learner, UNKNOWN, draw, rng()).shape == (10, 10)
    known = np.zeros((1, 10), np.float32)
    assert ask(empty_population(10), Genetic(population=10, founders=200), known, draw, rng()).shape == (10, 10)


def test_no_weight_grows_beyond_a_hundred_or_is_no_number() -> None:
    wild = np.array([[0.5, -0.5, 100.0, -100.0, 100.5, -1e30, np.inf, -np.inf, np.nan]], np.float32)
    assert bounded(wild).tolist() == [[0.5, -0.5, 100, -100, 100, -100, 100, -100, 0]]
    learner = Genetic(population=50, mutation=1000.0, mutated=1.0)
    first = ask(empty_population(9), learner, np.zeros((1, 9), np.float32), draw, rng())
    assert np.abs(first).max() == 100.0


def test_who_wins_a_tournament_of_four() -> None:
    ranks = genetic.choose(100, 20_000, rng())
    assert (ranks.min(), ranks.max() < 100) == (0, True)
    assert (ranks == 0).mean() == pytest.approx(1 - 0.99**4, rel=0.15)
    assert ranks.mean() == pytest.approx(sum((1 - k / 100) ** 4 for k in range(1, 100)), rel=0.03)


def test_a_child_has_each_weight_of_either_parent() -> None:
    first = rng().random((100, 300)) < 0.5
    parents = np.zeros((100, 300), np.float32), np.ones((100, 300), np.float32)
    children = genetic.PLAIN.crossed(*parents, first, first[:, :1])
    assert set(np.unique(children)) == {0.0, 1.0}
    assert children.mean() == pytest.approx(0.5, abs=0.01)
    assert children.mean(axis=1).std() < 0.05


@pytest.mark.parametrize(("mutated", "mutation"), [(0.1, 0.5), (0.3, 2.0), (0.0, 1.0), (1.0, 0.25)])
def test_a_share_of_the_weights_makes_a_normal_step(mutated: float, mutation: float) -> None:
    steps = genetic.mutate(np.full((100, 500), 7.0, np.float32), Genetic(mutated=mutated, mutation=mutation), rng()) - 7
    assert (steps != 0).mean() == pytest.approx(mutated, abs=0.01)
    if mutated:
        made = steps[steps != 0]
        assert (made.mean(), made.std()) == (pytest.approx(0, abs=0.05 * mutation), pytest.approx(mutation, rel=0.03))


def test_octaves_double_and_halve_so_many_times() -> None:
    learner = Genetic(mutated=0.2, mutation=0.5, octaves=2)
    steps = genetic.mutate(np.zeros((400, 4000), np.float32), learner, rng())
    shares = np.log2((steps != 0).mean(axis=1) / 0.2).round().astype(int)
    spreads = np.log2([made[made != 0].std() / 0.5 for made in steps]).round().astype(int)
    for powers in (shares, spreads):
        assert set(powers) == {-2, -1, 0, 1, 2}
    assert abs(np.corrcoef(shares, spreads)[0, 1]) < 0.2


@pytest.mark.parametrize(("share", "size", "kept"), [(0.1, 100, 10), (0.0, 100, 1), (0.25, 10, 2), (1.0, 10, 9)])
def test_the_elite_are_the_best_unchanged_and_all_others_are_children(share: float, size: int, kept: int) -> None:
    genomes = np.arange(size * 50, dtype=np.float32).reshape(size, 50) / 100
    scores = np.random.default_rng(2).permutation(size).astype(float)
    learner = Genetic(population=size, elite=share, mutated=1.0)
    bred = genetic.breed(tell(empty_population(50), learner, UNKNOWN, genomes, scores), learner, rng())
    assert bred.shape == genomes.shape
    best = genomes[np.argsort(-scores)]
    assert (bred[:kept] == best[:kept]).all()
    assert (bred[kept:, None] != best[None]).any(axis=2).all()


def test_children_are_of_parents_that_did_well() -> None:
    genomes = np.repeat(np.arange(100, dtype=np.float32)[:, None], 40, axis=1)
    learner = Genetic(population=2000, elite=0.0, mutated=0.0)
    bred = genetic.breed(
        tell(empty_population(40), learner, UNKNOWN, genomes, -genomes[:, 0].astype(float)), learner, rng()
    )
    assert set(np.unique(bred)) <= set(range(100))
    assert bred[1:].mean() == pytest.approx(sum((1 - k / 100) ** 4 for k in range(1, 100)), rel=0.05)
    assert max(len(np.unique(child)) for child in bred) == 2


def test_equal_scores_keep_their_order() -> None:
    assert order(np.array([1.0, 3.0, 1.0, np.nan, 3.0, np.inf])).tolist() == [1, 4, 0, 2, 3, 5]
    told = tell(
        empty_population(1), LEARNER, UNKNOWN, np.zeros((4, 1), np.float32), np.array([np.nan, np.inf, -np.inf, 2.0])
    )
    assert told.scores.tolist() == [-np.inf, -np.inf, -np.inf, 2.0]
    assert told.generation == 1
