"""Attempts side by side come to the same bits as one by one, whatever order their segments end in."""

from dataclasses import replace
from itertools import count

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.graph.graph import Need
from mindrun.kinds.events.event import Collision
from mindrun.train.attempt import Segment, Stretch, advance
from mindrun.train.attempts import Ahead, Attempts, Step, side_by_side
from mindrun.train.checkpoint import pack
from mindrun.train.lesson_state import Course, LessonState, Record, begin

from tests.draws import cases
from tests.train.climbing import LENGTH, Faulty, Flat, Sphere, lesson
from tests.train.sequential import teach

UNKNOWN = np.empty((0, LENGTH), np.float32)
SCORERS = (Sphere(), Sphere(noise=20.0), Faulty(), Flat())
COURSES = st.builds(
    lambda generations, seed, known, **said: Course(
        lesson(generations, **said), seed, np.ones((1, LENGTH), np.float32)[:known]
    ),
    st.integers(1, 17),
    st.integers(0, 99),
    st.integers(0, 1),
    attempts=st.integers(1, 7),
    rungs=st.integers(0, 4),
    patience=st.sampled_from((0, 0, 1, 3, 5)),
    population=st.just(5),
    needs=st.lists(
        st.builds(Need, st.just("score"), st.floats(-60.0, 0.0))
        | st.builds(Need, st.just("success"), st.floats(0, 1))
        | st.builds(Need, st.just("event"), st.floats(0, 2), st.just(Collision())),
        max_size=2,
    ).map(tuple),
)


class Shuffled:
    """Does stretches of some generations in the order of a generator, with room for so many; some are lost once."""

    def __init__(self, course: Course, scorer: Sphere, room: int, rng: np.random.Generator) -> None:
        self.course, self.scorer, self.room, self.rng = course, scorer, room, rng
        self.waiting: list[tuple[int, Stretch]] = []
        self.done: list[int] = []

    def has_room(self) -> bool:
        return len(self.waiting) < self.room

    def submit(self, job: int, stretch: Stretch) -> None:
        self.waiting.append((job, stretch))

    def next_result(self) -> tuple[int, Segment] | None:
        assert self.waiting, "an attempt is waited for that nobody does"
        if self.rng.random() < 0.2:
            return None
        job, stretch = self.waiting.pop(int(self.rng.integers(len(self.waiting))))
        self.done.append(stretch.number)
        ticks = count()
        seconds = float(self.rng.choice([0.01, 0.7, 2.0]))  # for half a generation, by a clock that goes so fast
        return job, advance(self.course, self.scorer, stretch, lambda: seconds * next(ticks))


def one_by_one(course: Course, scorer: Sphere, state: LessonState | None = None) -> tuple[LessonState, list[Record]]:
    passed = list(teach(course, scorer, state := state or begin(course), lambda: 0.0))
    return passed[-1][0] if passed else state, [record for _, record in passed]


def timeless(state: LessonState) -> bytes:
    return pack(replace(state, seconds=0.0), "")


@given(COURSES, st.sampled_from(SCORERS), st.integers(1, 9), st.integers(0, 2**32))
@settings(max_examples=cases(150), deadline=None)
def test_whatever_order_they_end_in_the_lesson_is_the_same(
    course: Course, scorer: Sphere, room: int, seed: int
) -> None:
    executor = Shuffled(course, scorer, room, np.random.default_rng(seed))
    steps = list(side_by_side(course, executor, begin(course), lambda: False))
    expected, records = one_by_one(course, scorer)
    assert timeless(steps[-1].state) == timeless(expected)
    assert [replace(each, seconds=0.0) for step in steps for each in step.records] == records
    assert all(len(step.records) == len(step.champions) > 0 for step in steps)


@given(COURSES, st.sampled_from(SCORERS), st.integers(1, 9), st.integers(0, 2**32), st.data())
@settings(max_examples=cases(60), deadline=None)
def test_stopped_after_any_step_it_goes_on_to_the_same_bits(
    course: Course, scorer: Sphere, room: int, seed: int, data: st.DataObject
) -> None:
    rng = np.random.default_rng(seed)
    steps = list(side_by_side(course, Shuffled(course, scorer, room, rng), begin(course), lambda: False))
    step = data.draw(st.sampled_from(steps))
    expected, records = one_by_one(course, scorer)
    assert timeless(one_by_one(course, scorer, step.state)[0]) == timeless(expected)
    rest = list(side_by_side(course, Shuffled(course, scorer, room, rng), step.state, lambda: False))
    if rest:
        assert timeless(rest[-1].state) == timeless(expected)
    behind = step.state.generations
    assert [replace(each, seconds=0.0) for after in rest for each in after.records] == records[behind:]


def test_who_waits_at_a_rung_goes_on_meanwhile_and_is_cut_in_retrospect() -> None:
    """The last attempts run to their end before the first has begun: what they did behind a rung has not happened."""
    course = Course(lesson(16, attempts=6, rungs=2, population=5), 3, UNKNOWN)
    scorer, attempts = Sphere(noise=20.0), Attempts(course, begin(course))
    waiting = [job for _ in range(6) if (job := attempts.next_stretch())]
    assert [stretch.number for _, stretch in waiting] == list(range(6))
    passed: list[Step] = []
    ahead = 0
    while waiting:
        job, stretch = waiting.pop()
        attempts.put(job, advance(course, scorer, stretch, lambda: 0.0))
        passed += attempts.steps()
        ahead += stretch.number > attempts.lesson.attempt
        waiting += [job for _ in range(6) if (job := attempts.next_stretch())]
    expected, _ = one_by_one(course, scorer)
    assert ahead > 6
    assert set(expected.lengths.tolist()) > {16}, "somebody was cut"
    assert timeless(passed[-1].state) == timeless(expected)


def test_a_stop_is_noticed_while_nothing_comes() -> None:
    class Silent(Shuffled):
        def next_result(self) -> None:
            return None

    course, asked = Course(lesson(5), 1, UNKNOWN), iter([False, False, True])
    silent = Silent(course, Sphere(), 2, np.random.default_rng(0))
    assert list(side_by_side(course, silent, begin(course), lambda: next(asked))) == []


@pytest.mark.parametrize("job", [-1, 0, 99])
def test_what_nobody_asked_for_is_left_out(job: int) -> None:
    course = Course(lesson(5, attempts=2), 1, UNKNOWN)
    attempts = Attempts(course, begin(course))
    _, stretch = attempts.next_stretch() or (0, None)
    assert stretch is not None
    attempts.put(job, advance(course, Sphere(), stretch, lambda: 0.0))
    assert list(attempts.steps()) == []


def test_what_is_ahead_is_what_will_be_reported_without_a_job() -> None:
    course = Course(lesson(6, attempts=4), 1, UNKNOWN)
    rng = np.random.default_rng(3)
    steps = list(side_by_side(course, Shuffled(course, Sphere(), 4, rng), begin(course), lambda: False))
    assert steps[-1].ahead == Ahead()
    assert any(step.ahead.attempts > 1 for step in steps)
    for step in steps:
        assert 0 <= step.ahead.attempts <= max(0, 3 - step.state.attempt)
        assert step.ahead.attempts <= step.ahead.generations <= 6 * step.ahead.attempts
