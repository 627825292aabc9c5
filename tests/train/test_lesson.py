"""One lesson, on a sphere."""

from dataclasses import replace

import numpy as np
import pytest
from mindrun.train.lesson import Course, Record, State, begin, is_better, teach

from tests.train.climbing import LENGTH, Faulty, Flat, Sphere, lesson

UNKNOWN = np.empty((0, LENGTH), np.float32)


def taught(course: Course, scorer: Sphere) -> tuple[State, list[Record]]:
    ticking = iter(range(10**6))
    passed = list(teach(course, scorer, begin(course), lambda: float(next(ticking))))
    return passed[-1][0], [record for _, record in passed]


def test_a_lesson_teaches() -> None:
    state, records = taught(Course(lesson(100), 1, UNKNOWN), Sphere())
    assert [record.generation for record in records] == list(range(1, 101))
    assert state.reevaluated > -2.0
    assert records[0].best < records[-1].best


def test_the_same_seed_gives_the_same_bits_and_another_seed_others() -> None:
    first, again, other = (taught(Course(lesson(), seed, UNKNOWN), Sphere())[0] for seed in (1, 1, 2))
    assert first.kept.tobytes() == again.kept.tobytes()
    assert first.kept.tobytes() != other.kept.tobytes()


def test_the_reevaluated_score_is_not_the_biased_maximum() -> None:
    state, _ = taught(Course(lesson(60), 1, UNKNOWN), Sphere(noise=5.0))
    honest = Sphere(noise=5.0).score(state.kept, np.arange(10_000)).total.mean()
    assert abs(state.reevaluated - honest) < 2.0
    assert state.best > state.reevaluated


def test_several_attempts_keep_the_best_of_them() -> None:
    course = Course(lesson(5, attempts=4), 1, UNKNOWN)
    state, records = taught(course, Sphere())
    assert [record.attempt for record in records] == [attempt for attempt in range(1, 5) for _ in range(5)]
    alone = taught(replace(course, lesson=lesson(5)), Sphere())[0]
    assert state.verdicts[:, 0].max() >= alone.verdicts[0, 0]


def test_it_starts_from_what_the_skill_knows_and_never_ends_worse() -> None:
    known = np.ones((1, LENGTH), np.float32)
    state, records = taught(Course(lesson(5), 1, known), Sphere(noise=0.0))
    assert state.kept.tobytes() == known.tobytes()
    assert records[0].best == 0.0


def test_scores_that_are_not_numbers_come_last_and_are_counted() -> None:
    state, records = taught(Course(lesson(60), 1, UNKNOWN), Faulty())
    assert state.kept[0, 0] <= 0.0
    assert state.faults == sum(record.faults for record in records) > 0


def test_a_lesson_in_which_everything_fails_says_so_by_its_score() -> None:
    state, records = taught(Course(lesson(3), 1, UNKNOWN), Faulty(above=-1e9))
    assert state.reevaluated == -np.inf
    assert all(record.best == -np.inf for record in records)


def test_ticks_and_seconds_add_up() -> None:
    state, records = taught(Course(lesson(30), 1, UNKNOWN), Sphere())
    assert state.seconds == sum(record.seconds for record in records) == 30.0
    assert state.ticks == sum(record.ticks for record in records)


def test_an_attempt_without_patience_left_makes_room_for_the_next() -> None:
    """On a flat world nothing becomes better than the first: its generation and twenty more."""
    state, records = taught(Course(lesson(100, attempts=3, patience=20), 1, UNKNOWN), Flat())
    assert [record.attempt for record in records] == [1] * 21 + [2] * 21 + [3] * 21
    assert [record.generation for record in records if record.verdict is not None] == [21] * 3
    assert len(state.champions) == len(state.verdicts) == 3
    assert state.lengths.tolist() == [21] * 3
    assert state.kept_after == 21
    assert state.generations == 63


def test_patience_outlasts_a_climb() -> None:
    state, records = taught(Course(lesson(60, patience=20), 1, UNKNOWN), Sphere(noise=0.1))
    climbed = taught(Course(lesson(60), 1, UNKNOWN), Sphere(noise=0.1))[0]
    assert len(records) > 40
    assert state.reevaluated > climbed.reevaluated - 1.0


@pytest.mark.parametrize(
    ("scores", "than", "better"),
    [
        ([2.0, 3.1, 4.0, 5.0], [1.0, 2.0, 3.0, 4.0], True),
        ([9.0, 0.0, 9.0, 0.0], [1.0, 2.0, 3.0, 4.0], False),
        ([1.0, 2.0, 3.0, 4.0], [1.0, 2.0, 3.0, 4.0], False),
        ([1.0, 2.0, 3.0, 4.0], [-np.inf, 2.0, 3.0, 4.0], True),
        ([-np.inf, 2.0, 3.0, 4.0], [-np.inf, 2.0, 3.0, 4.0], False),
        ([-np.inf, 9.0, 9.0, 9.0], [1.0, 2.0, 3.0, 4.0], False),
    ],
)
def test_better_means_beyond_doubt(scores: list[float], than: list[float], better: bool) -> None:
    assert is_better(np.array(scores), np.array(than)) is better


def test_every_attempt_leaves_its_champion_and_its_verdict() -> None:
    course = Course(lesson(5, attempts=3), 1, UNKNOWN)
    state, records = taught(course, Sphere())
    assert [record.verdict for record in records if record.verdict is not None] == state.verdicts[:, 1].tolist()
    best = int(state.verdicts[:, 0].argmax())
    assert state.kept.tobytes() == state.champions[best].tobytes()
    assert state.reevaluated == state.verdicts[best, 1]
