"""What attempts ahead have done is not done again, and changes no bit; a file that is damaged is as none."""

from dataclasses import replace
from itertools import count
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.train.attempts import side_by_side
from mindrun.train.kept_segments import NAME, KeptSegments, RememberingExecutor
from mindrun.train.lesson_state import Course, LessonState, begin

from tests.train.climbing import LENGTH, Sphere, lesson
from tests.train.test_attempts import COURSES, Shuffled, one_by_one, timeless

COURSE = Course(lesson(30, attempts=6, rungs=2), 1, np.empty((0, LENGTH), np.float32))

STEPS = 16  # of the lesson, until it is stopped


def remembering(others: Shuffled, kept: KeptSegments) -> RememberingExecutor:
    """Saves now and then: three seconds pass between two looks at the clock."""
    seconds = count(step=3)
    return RememberingExecutor(others, kept, lambda: float(next(seconds)))


def taught(course: Course, executor: RememberingExecutor, state: LessonState, most: int = 10**9) -> LessonState:
    """Where a lesson stands after so many steps at most."""
    left = iter(range(most))
    for step in side_by_side(course, executor, state, lambda: next(left, None) is None):
        state = step.state
    return state


@given(COURSES, st.integers(1, 6), st.lists(st.integers(0, 9), max_size=4), st.integers(0, 99))
@settings(deadline=None)
def test_stopped_wherever_it_goes_on_to_the_same_bits(
    tmp_path_factory: pytest.TempPathFactory, course: Course, room: int, stops: list[int], seed: int
) -> None:
    folder, scorer, rng = tmp_path_factory.mktemp("run"), Sphere(), np.random.default_rng(seed)
    state = begin(course)
    for most in (*stops, 10**9):
        kept = KeptSegments(folder, "a run", course)
        state = taught(course, remembering(Shuffled(course, scorer, room, rng), kept), state, most)
        kept.save()
    assert timeless(state) == timeless(one_by_one(course, scorer)[0])
    assert course.lesson.needs or not (folder / NAME).exists()


def stopped(folder: Path) -> tuple[Shuffled, LessonState]:
    """Who has done some of a lesson, and where that stood when it was stopped."""
    kept, others = KeptSegments(folder, "a run", COURSE), Shuffled(COURSE, Sphere(), 6, np.random.default_rng(2))
    state = taught(COURSE, remembering(others, kept), begin(COURSE), STEPS)
    kept.save()
    assert sum(map(len, kept.chains.values())) > 2
    return others, state


def jobs_to_the_end(folder: Path, state: LessonState, identity: str = "a run") -> int:
    """How many stretches are done by others from there to the end."""
    others = Shuffled(COURSE, Sphere(), 6, np.random.default_rng(3))
    last = taught(COURSE, remembering(others, KeptSegments(folder, identity, COURSE)), state)
    assert timeless(last) == timeless(one_by_one(COURSE, Sphere())[0])
    return len(others.done)


def test_what_is_there_is_not_done_again(tmp_path: Path) -> None:
    _, state = stopped(tmp_path)
    data = (tmp_path / NAME).read_bytes()
    spared = jobs_to_the_end(tmp_path, state)
    (tmp_path / NAME).unlink(missing_ok=True)
    whole = jobs_to_the_end(tmp_path, state)
    assert spared < whole
    for other in (b"", data[:-1], data[:1000], b"garbage", bytes([*data[:-60], data[-60] ^ 1, *data[-59:]])):
        (tmp_path / NAME).write_bytes(other)
        jobs_to_the_end(tmp_path, state)
    (tmp_path / NAME).write_bytes(data)
    assert jobs_to_the_end(tmp_path, state, "another run") == whole


def test_a_segment_is_the_answer_to_its_stretch_alone(tmp_path: Path) -> None:
    stopped(tmp_path)
    kept = KeptSegments(tmp_path, "a run", COURSE)
    others = Shuffled(COURSE, Sphere(), 6, np.random.default_rng(2))
    taught(COURSE, remembering(others, KeptSegments(tmp_path / "none", "a run", COURSE)), begin(COURSE), 1)
    stretch = next(stretch for _, stretch in others.waiting if stretch.number in kept.chains)
    assert kept.find(stretch) is not None
    champion = np.ones((1, LENGTH), np.float32)
    assert kept.find(replace(stretch, state=replace(stretch.state, champion=champion))) is None
    assert kept.find(replace(stretch, cut=True)) is None
