"""A training in a notebook: cancelled, interrupted, gone on with to the same bits, and no thread left behind."""

import os
import signal
import threading
from pathlib import Path
from time import sleep

import pytest
from mindrun.train.run_folder import WEIGHTS

import mindlang
from mindlang import Record, TrainOptions

MAX_WAITS = 6000
OPTIONS = TrainOptions(generations=4, population=10, attempts=1)


class Taught:
    """A call of `train`, which says what it saw; `stop_after` so many generations it is cancelled."""

    def __init__(self, folder: Path) -> None:
        self.mind, self.runs = mindlang.load(folder / "collect.mind"), folder / "runs"
        self.on = "threads"
        self.seen: list[int] = []

    def __call__(self, stop_after: int = 10**9, options: TrainOptions = OPTIONS) -> int:
        """How many lessons have ended."""
        self.seen = []

        def told(record: Record) -> None:
            self.seen.append(record.generation)

        done = self.mind.train(
            "GoToObject",
            options=options,
            seed=3,
            runs=self.runs,
            workers=2,
            on=self.on,
            on_generation=told,
            cancelled=lambda: len(self.seen) >= stop_after,
        )
        return len(done)

    def weights(self) -> bytes:
        """The genome of the one run that there is."""
        [run] = list(self.runs.rglob(WEIGHTS))
        return run.read_bytes()


@pytest.fixture
def taught(collect: Path) -> Taught:
    return Taught(collect)


def no_thread_is_left(before: set[threading.Thread]) -> bool:
    """Whether all threads end that were begun since."""
    for _ in range(MAX_WAITS):
        if {*threading.enumerate()} <= before:
            return True
        sleep(0.01)
    return False


def test_a_cancelled_training_goes_on_to_the_same_bits(taught: Taught, tmp_path: Path, collect: Path) -> None:
    before = {*threading.enumerate()}
    whole = Taught(collect)
    whole.runs = tmp_path / "whole"
    lock = (collect / "collect.lock").read_bytes()
    assert whole() == 1
    assert whole.seen == [1, 2, 3, 4]
    learnt = (collect / "collect.lock").read_bytes()
    (collect / "collect.lock").write_bytes(lock)
    assert taught(stop_after=1) == 0
    assert taught(stop_after=2) == 0
    assert taught.seen == [2, 3]
    assert taught() == 1
    assert taught.seen == [4]
    assert taught.weights() == whole.weights()
    assert (collect / "collect.lock").read_bytes() == learnt
    assert no_thread_is_left(before)


def test_on_processes_it_is_the_same_bits(taught: Taught, collect: Path) -> None:
    two = TrainOptions(generations=2, population=10, attempts=2)
    lock = (collect / "collect.lock").read_bytes()
    assert taught(options=two) == 1
    here, seen, learnt = taught.weights(), taught.seen, (collect / "collect.lock").read_bytes()
    (collect / "collect.lock").write_bytes(lock)
    taught.runs, taught.on = collect / "elsewhere", "processes:2"
    assert taught(options=two) == 1
    assert (taught.weights(), taught.seen) == (here, seen)
    assert (collect / "collect.lock").read_bytes() == learnt


def test_on_nowhere_nothing_is_begun(taught: Taught) -> None:
    taught.on = "moon"
    with pytest.raises(mindlang.MindError, match="nobody knows where 'moon' is"):
        taught()
    assert not taught.runs.exists()


def test_without_a_name_what_is_due_is_taught(collect: Path) -> None:
    mind = mindlang.load(collect / "collect.mind")
    assert mind.train(runs=collect / "runs") == []
    lock = collect / "collect.lock"
    lock.write_text("".join(line for line in lock.read_text().splitlines(True) if not line.startswith("GoToDropZone ")))
    seen: list[Record] = []
    is_first_over = lambda: len(seen) == OPTIONS.generations  # noqa: E731
    results = mind.train(options=OPTIONS, runs=collect / "runs", on_generation=seen.append, cancelled=is_first_over)
    assert [result["skill"] for result in results] == ["GoToDropZone"]


@pytest.mark.parametrize("attempts", [1, 3])
def test_ctrl_c_leaves_a_run_that_goes_on(taught: Taught, attempts: int) -> None:
    before = {*threading.enumerate()}
    endless = TrainOptions(generations=10**6, population=200, attempts=attempts)
    assert taught(stop_after=2, options=endless) == 0  # compiled, and saved
    timer = threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        taught(options=endless)
    assert no_thread_is_left(before)
    assert taught(stop_after=1, options=endless) == 0
    assert taught.seen[0] > 2
    assert len([*taught.runs.rglob("manifest.json")]) == 1
