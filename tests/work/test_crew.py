"""Workers that are processes: what they do is the same bits whoever dies or talks nonsense, or it is one sentence."""

import os
import random
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mindrun.train.attempts import side_by_side
from mindrun.train.checkpoint import pack as state_bytes
from mindrun.train.lesson import teach
from mindrun.train.lesson_state import Course, LessonState, begin
from mindrun.train.run_folder import create
from mindrun.train.segment import Segment
from mindrun.train.training import train
from mindrun.work import WorkError
from mindrun.work.child import Child
from mindrun.work.crew import MAX_LOSSES, Crew, Place
from mindrun.work.executor import StretchExecutor
from mindrun.work.frame import Frame, pack
from mindrun.work.pipes import LostError

from tests.train.climbing import LENGTH, Sphere, lesson, manifest, unwatched
from tests.work.working import ASSIGNMENT, FAULTS

COURSE = Course(lesson(250, attempts=5, rungs=2), 1, np.empty((0, LENGTH), np.float32))
ROOT = Path(__file__).parents[2]
KILLS = 6


def place(*words: str) -> Place:
    return Place("a place", (sys.executable, "-m", "tests.work.working", *words))


@contextmanager
def crew(*places: Place) -> Iterator[Crew]:
    found = Crew(places, ASSIGNMENT)
    try:
        yield found
    finally:
        found.close()


def taught(workers: Crew) -> bytes:
    last = begin(COURSE)
    for step in side_by_side(COURSE, StretchExecutor(COURSE, workers), last, lambda: False):
        last = step.state
    return timeless(last)


def timeless(state: LessonState) -> bytes:
    return state_bytes(replace(state, seconds=0.0), "")


@pytest.fixture(scope="module")
def expected() -> bytes:
    *_, (state, _) = teach(COURSE, Sphere(), begin(COURSE), lambda: 0.0)
    return timeless(state)


@pytest.fixture(autouse=True)
def sources(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(ROOT), str(ROOT / "runtime")]))


@pytest.mark.parametrize("count", [1, 2, 4])
def test_any_number_of_workers_come_to_the_same_bits(expected: bytes, count: int) -> None:
    with crew(*[place()] * count) as workers:
        assert taught(workers) == expected


@pytest.mark.parametrize("fault", FAULTS)
def test_a_worker_with_a_fault_now_and_then_changes_no_bit(expected: bytes, fault: str) -> None:
    with crew(place(fault), place()) as workers:
        assert taught(workers) == expected


class Killing(StretchExecutor):
    """Kills a random worker after each of the first answers."""

    killed = 0
    rng = random.Random(1)

    def take(self) -> tuple[int, Segment] | None:
        done, workers = StretchExecutor.take(self), self.jobs
        assert isinstance(workers, Crew)
        process = self.rng.choice(workers.children).process
        if done and Killing.killed < KILLS and process is not None:
            process.kill()
            Killing.killed += 1
        return done


def test_killed_again_and_again_nothing_is_lost(expected: bytes) -> None:
    last = begin(COURSE)
    with crew(place("slow"), place("slow")) as workers:
        for step in side_by_side(COURSE, Killing(COURSE, workers), last, lambda: False):
            last = step.state
    assert Killing.killed == KILLS
    assert timeless(last) == expected


@pytest.mark.parametrize("fault", ["dies", "nan", "prints"])
def test_a_job_that_costs_every_worker_is_at_fault_itself(fault: str) -> None:
    with crew(place(fault, "1")) as workers, pytest.raises(WorkError, match=f"has ended {MAX_LOSSES} workers") as error:
        taught(workers)
    assert "the same job" in error.value.hint


@pytest.mark.parametrize(
    ("command", "words"),
    [
        (("/nowhere/mindrun", "work"), "No such file"),
        (
            (sys.executable, "-c", "import sys; sys.exit('Host key verification failed.')"),
            "Host key verification failed",
        ),
        ((sys.executable, "-c", "print('Last login: today', flush=True); input()"), "it begins with b'Last log'"),
    ],
)
def test_a_command_that_is_no_worker_is_one_sentence(command: tuple[str, ...], words: str) -> None:
    with crew(Place("there", command)) as workers, pytest.raises(WorkError, match="no worker is left") as error:
        taught(workers)
    assert words in str(error.value)
    assert "there" in str(error.value)


def test_a_place_without_workers_leaves_the_work_to_others(expected: bytes) -> None:
    with crew(Place("nowhere", ("/nowhere/mindrun",)), place()) as workers:
        assert taught(workers) == expected


def test_a_worker_of_another_build_refuses_in_words() -> None:
    with crew(place()) as workers:
        about = {"build": {"numpy": "1.0"}, "assignment": ASSIGNMENT.name}
        workers.submit(1, pack(Frame("advance", about)), lambda answer: answer)
        with pytest.raises(WorkError, match="the worker at a place is of another build: mindrun is") as error:
            next(filter(None, iter(workers.take, 0)))
    assert "install the same" in error.value.hint


def test_a_run_whose_workers_are_gone_goes_on_with_others(tmp_path: Path, expected: bytes) -> None:
    run = create(tmp_path, manifest(COURSE.lesson), {}, {})
    with crew(place()) as workers:
        train(run, Sphere(), unwatched(stop_after=2), StretchExecutor(COURSE, workers))
    with crew(place("dies", "1")) as workers, pytest.raises(WorkError):
        train(run, Sphere(), unwatched(), StretchExecutor(COURSE, workers))
    with crew(place(), place()) as workers:
        state = train(run, Sphere(), unwatched(), StretchExecutor(COURSE, workers))
    assert timeless(state) == expected


def test_no_worker_is_left_behind() -> None:
    with crew(place("slow"), place("slow")) as workers:
        taught(workers)
        processes = [child.process for child in workers.children]
    assert [process.poll() for process in processes if process] == [-signal.SIGKILL] * 2


def test_workers_that_are_long_in_coming_are_said_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mindrun.work.crew.PATIENCE_TAKES", 2)
    monkeypatch.setattr("mindrun.work.crew.TAKE_SECONDS", 0.0)
    said: list[str] = []
    silent = Place("head", (sys.executable, "-c", "input()"))
    late = Crew([silent, replace(silent, name="other")], ASSIGNMENT, say=said.append)
    try:
        assert [late.take() for _ in range(5)] == [None] * 5
    finally:
        late.close()
    assert said == [
        "no worker has begun yet (head and 1 more): waiting until mindrun work is ready there (Ctrl-C stops)"
    ]


def test_nothing_is_said_of_workers_that_are_there(monkeypatch: pytest.MonkeyPatch) -> None:
    said: list[str] = []
    there = Crew([place()], ASSIGNMENT, say=said.append)
    try:
        assert taught(there)
        monkeypatch.setattr("mindrun.work.crew.PATIENCE_TAKES", there._takes + 1)
        assert there.take() is None
    finally:
        there.close()
    assert said == []


def test_a_worker_that_is_killed_before_it_begins_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    """A crew may end at once, while its threads begin their workers."""
    monkeypatch.setattr("mindrun.work.child.START_SECONDS", 5.0)
    child = Child(Place("a place", (sys.executable, "-c", "input()")))
    child.kill()
    with pytest.raises(LostError, match="it ended"):
        child.begin()
    child.end()
