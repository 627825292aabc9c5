"""The evolution strategy by itself."""

from dataclasses import replace
from time import perf_counter

import numpy as np
import pytest
from mindrun.kinds.learners import EvolutionStrategy, Genetic
from mindrun.train.ask_and_tell import ask, kept_count, tell
from mindrun.train.attempt import REEVALUATION_LAYOUTS, fresh_count
from mindrun.train.lesson_state import Course, begin, is_reachable
from mindrun.train.population import Genomes, Population, empty_population

from tests.train.sequential import teach

from .climbing import LENGTH, Sphere, lesson

LEARNER = EvolutionStrategy(population=40, mutation=0.5)
KNOWN = np.arange(6, dtype=np.float32)[None]
UNKNOWN = KNOWN[:0]


def rng() -> np.random.Generator:
    return np.random.default_rng(1)


def draw(count: int, rng: np.random.Generator) -> Genomes:
    return 4 * rng.standard_normal((count, 6), np.float32)


def test_all_weights_of_all_genomes_lie_a_normal_step_around_what_is_known() -> None:
    steps = ask(empty_population(6), EvolutionStrategy(population=5000, mutation=0.3), KNOWN, draw, rng()) - KNOWN
    assert steps.dtype == np.float32
    assert steps.mean(axis=0) == pytest.approx(0, abs=0.02)
    assert steps.std(axis=0) == pytest.approx(0.3, rel=0.05)


def test_the_centre_moves_to_the_mean_of_the_best_quarter_weighted_by_rank() -> None:
    genomes = ask(empty_population(6), LEARNER, KNOWN, draw, rng())
    scores = genomes[:, 2].astype(float)
    told = tell(empty_population(6), LEARNER, KNOWN, genomes, scores)
    best = np.argsort(-scores)[:10]
    shares = np.arange(10, 0, -1) / 55
    np.testing.assert_allclose(told.genomes, (shares @ genomes[best])[None], rtol=1e-6)
    assert told.scores == pytest.approx([shares @ scores[best]])
    assert told.generation == 1
    around = ask(told, EvolutionStrategy(population=5000, mutation=0.3), KNOWN, draw, rng())
    np.testing.assert_allclose(around.mean(axis=0), told.genomes[0], atol=0.02)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_has_a_fault_is_no_parent_and_without_any_the_centre_stays(bad: float) -> None:
    genomes = ask(empty_population(6), LEARNER, KNOWN, draw, rng())
    scores = np.full(40, bad)
    assert tell(empty_population(6), LEARNER, KNOWN, genomes, scores).genomes.tolist() == KNOWN.tolist()
    later = Population(KNOWN + 1, np.zeros(1), 3)
    assert tell(later, LEARNER, KNOWN, genomes, scores).genomes.tolist() == (KNOWN + 1).tolist()
    scores[7] = -5.0
    told = tell(empty_population(6), LEARNER, KNOWN, genomes, scores)
    np.testing.assert_array_equal(told.genomes[0], genomes[7])
    assert told.scores.tolist() == [-5.0]


def test_from_scratch_it_begins_with_the_best_founder_alone() -> None:
    learner = EvolutionStrategy(population=10, founders=200)
    founders = ask(empty_population(6), learner, UNKNOWN, draw, rng())
    np.testing.assert_array_equal(founders, draw(200, rng()))
    told = tell(empty_population(6), learner, UNKNOWN, founders, founders[:, 0].astype(float))
    np.testing.assert_array_equal(told.genomes[0], founders[founders[:, 0].argmax()])
    assert ask(told, learner, UNKNOWN, draw, rng()).shape == (10, 6)


def test_founders_that_all_have_faults_leave_one_of_them() -> None:
    told = tell(empty_population(6), LEARNER, UNKNOWN, draw(40, rng()), np.full(40, np.nan))
    assert told.genomes.shape == (1, 6)
    assert ask(told, LEARNER, UNKNOWN, draw, rng()).shape == (40, 6)


def test_no_weight_grows_beyond_a_hundred() -> None:
    wild = EvolutionStrategy(population=50, mutation=1000.0)
    genomes = ask(empty_population(6), wild, KNOWN, draw, rng())
    assert np.abs(genomes).max() == 100.0
    assert np.abs(tell(empty_population(6), wild, KNOWN, genomes, genomes[:, 0].astype(float)).genomes).max() <= 100.0


def test_a_lesson_finishes_what_is_known_and_keeps_the_centre() -> None:
    learner = EvolutionStrategy(population=40, mutation=0.1)
    start = np.full((1, LENGTH), 2.0, np.float32)
    course = Course(replace(lesson(30), learner=learner), 1, start)
    states = [state for state, _ in teach(course, Sphere(), begin(course), perf_counter)]
    assert len(states[5].now.population.genomes) == kept_count(learner) == 1
    assert all(is_reachable(course, state) for state in states[:-1])
    assert states[-1].reevaluated > -1.5 > -12


def test_a_single_candidate_is_tried_on_twice_as_many_layouts_as_four() -> None:
    assert fresh_count(EvolutionStrategy()) == 2 * REEVALUATION_LAYOUTS == 2 * fresh_count(Genetic())
