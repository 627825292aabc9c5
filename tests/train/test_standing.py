"""Where a run stands: which states a lesson can come to, when an attempt has ended, and what is kept of it."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest
from mindrun.train.attempt import are_different, ends_by_itself
from mindrun.train.lesson_state import Course, LessonState, begin, is_reachable
from mindrun.train.population import Population

from tests.train.climbing import LENGTH, lesson

COURSE = Course(lesson(30, attempts=3, patience=8), 1, np.empty((0, LENGTH), np.float32))


def state(
    individuals: int = 20,
    generation: int = 5,
    weights: int = LENGTH,
    attempt: int = 1,
    since: int = 2,
    length: int = 30,
) -> LessonState:
    population = Population(np.ones((individuals, weights), np.float32), np.ones(individuals), generation)
    lengths = np.full(attempt, length)
    start = begin(COURSE)
    return replace(start, now=replace(start.now, population=population, since=since), attempt=attempt, lengths=lengths)


@pytest.mark.parametrize(
    ("changes", "could"),
    [
        ({}, True),
        ({"individuals": 0, "generation": 0, "since": 0}, True),
        ({"individuals": 19}, False),
        ({"individuals": 21}, False),
        ({"weights": LENGTH + 1}, False),
        ({"attempt": 3, "individuals": 0, "generation": 0, "since": 0}, True),
        ({"attempt": 4, "individuals": 0, "generation": 0, "since": 0}, False),
        ({"generation": 29}, True),
        ({"generation": 30}, False),
        ({"since": 5}, True),
        ({"since": 6}, False),
        ({"length": 31}, False),
        ({"length": 1}, True),
    ],
)
def test_a_state_to_which_a_run_can_have_come(changes: dict[str, int], could: bool) -> None:
    assert is_reachable(COURSE, state(**changes)) is could


def test_a_lesson_without_generations_has_a_state_at_its_beginning() -> None:
    course = replace(COURSE, lesson=replace(COURSE.lesson, generations=0))
    assert is_reachable(course, begin(course))


@pytest.mark.parametrize(
    ("generation", "since", "patience", "ended"),
    [(30, 30, 8, True), (29, 29, 8, False), (12, 4, 8, True), (11, 4, 8, False), (29, 0, 0, False), (30, 0, 0, True)],
)
def test_an_attempt_ends_after_its_generations_or_its_patience(
    generation: int, since: int, patience: int, ended: bool
) -> None:
    of = replace(COURSE.lesson, learner=replace(COURSE.lesson.learner, patience=patience))
    assert ends_by_itself(of, state(generation=generation, since=since).now) is ended


def test_nothing_is_kept_before_an_attempt_has_ended() -> None:
    start = begin(replace(COURSE, start=np.ones((1, LENGTH), np.float32)))
    assert (len(start.kept), start.kept_after, start.reevaluated, start.best) == (0, 0, -inf, -inf)
    assert start.now.champion.tolist() == [[1.0] * LENGTH]
    assert (start.attempt, start.now.since, start.generations, start.ticks, start.faults, start.seconds) == (0,) * 6
    assert (start.now.rival.shape, start.champions.shape) == ((0, LENGTH), (0, LENGTH))
    assert start.now.population.genomes.shape == (0, LENGTH)
    assert start.told_apart is False


def test_all_attempts_have_all_generations_together() -> None:
    assert COURSE.generations == 90


@pytest.mark.parametrize(
    ("scores", "different"),
    [
        ([], False),
        ([1.0], False),
        ([1.0, 1.0], False),
        ([1.0, 2.0], True),
        ([-inf, 1.0], False),
        ([-inf, 1.0, 2.0], True),
    ],
)
def test_what_tells_genomes_apart(scores: list[float], different: bool) -> None:
    assert are_different(np.array(scores)) is different
