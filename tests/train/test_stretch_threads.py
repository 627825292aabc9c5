"""Attempts in threads of one process come to the bits of one after the other, and a training that ends leaves none."""

import threading
from dataclasses import replace
from itertools import count
from pathlib import Path
from threading import Thread
from time import perf_counter, sleep

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.train.attempt import Segment, Stretch
from mindrun.train.attempts import StretchThreads, side_by_side
from mindrun.train.lesson_state import Course, Record, begin
from mindrun.train.run_folder import create
from mindrun.train.training import Watch, train
from numpy.typing import NDArray

from tests.draws import cases
from tests.train.climbing import LENGTH, Results, Sphere, forget, lesson, manifest
from tests.train.test_attempts import COURSES, SCORERS, UNKNOWN, one_by_one, timeless

MAX_WAITS = 3000


class Told:
    """A scorer that is told how many cores it has, and asks after each genome whether to go on."""

    def __init__(self, scorer: Sphere) -> None:
        self.scorer, self.genome_length, self.task = scorer, scorer.genome_length, scorer.task
        self.cores: list[int] = []
        self.draw = scorer.draw

    def on(self, cores: int) -> "Told":
        self.cores.append(cores)
        return self

    def score(
        self, genomes: NDArray[np.float32], seeds: NDArray[np.uint64], ran: object, ticks: int | None = None
    ) -> Results:
        for _ in genomes:
            ran(len(seeds))  # type: ignore[operator]
        return self.scorer.score(genomes, seeds)


class Endless(Told):
    """Its runs have no end."""

    def score(
        self, genomes: NDArray[np.float32], seeds: NDArray[np.uint64], ran: object, ticks: int | None = None
    ) -> Results:
        while True:
            sleep(0.001)
            ran(0.0)  # type: ignore[operator]


def no_thread_is_left(before: set[Thread]) -> bool:
    """Whether all threads end that were begun since."""
    for _ in range(MAX_WAITS):
        if {*threading.enumerate()} <= before:
            return True
        sleep(0.01)
    return False


@given(COURSES, st.sampled_from(SCORERS), st.integers(2, 5))
@settings(max_examples=cases(40), deadline=None)
def test_in_threads_the_lesson_is_the_same(course: Course, scorer: Sphere, cores: int) -> None:
    threads = StretchThreads(course, cores, Told(scorer).on, perf_counter)
    steps = list(side_by_side(course, threads, begin(course), lambda: False))
    threads.close()
    expected, records = one_by_one(course, scorer)
    assert timeless(steps[-1].state) == timeless(expected)
    assert [replace(each, seconds=0.0) for step in steps for each in step.records] == records


def test_a_generation_is_a_stretch_and_attempts_fewer_than_cores_share_them() -> None:
    course, told = Course(lesson(3, attempts=3), 1, UNKNOWN), Told(Sphere())
    threads = StretchThreads(course, 4, told.on, perf_counter)
    for step in side_by_side(course, threads, begin(course), lambda: False):
        assert len({record.attempt for record in step.records}) == 1
    assert told.cores[:3] == [2, 2, 2]
    assert len(told.cores) == 9
    alone = Told(Sphere())
    course = replace(course, lesson=lesson(3, attempts=1))
    list(side_by_side(course, StretchThreads(course, 4, alone.on, perf_counter), begin(course), lambda: False))
    assert alone.cores == [4, 4, 4]


def test_the_time_of_a_lesson_is_that_of_the_clock_and_not_of_all_threads_together(tmp_path: Path) -> None:
    run = create(tmp_path, manifest(lesson(4, attempts=3)), {}, {})
    course, seconds = run.course(LENGTH), count(step=1000)
    threads = StretchThreads(course, 2, Told(Sphere()).on, lambda: next(seconds))
    records: list[Record] = []
    watch = Watch(lambda state, record: records.append(record), forget, lambda: False, lambda: 5.0)
    assert train(run, Sphere(), watch, threads).seconds == 0.0
    assert all(record.seconds >= 1000 for record in records)


def test_closed_all_end_in_the_middle_of_their_runs() -> None:
    before = {*threading.enumerate()}
    course, asked = Course(lesson(3, attempts=9), 1, UNKNOWN), iter([False, False, True])
    threads = StretchThreads(course, 4, Endless(Sphere()).on, perf_counter)
    assert list(side_by_side(course, threads, begin(course), lambda: next(asked))) == []
    assert len({*threading.enumerate()} - before) == 4
    threads.close()
    assert no_thread_is_left(before)


def test_what_fails_in_a_thread_fails_where_it_was_asked_for() -> None:
    class Failing(Told):
        def score(self, genomes: object, seeds: object, ran: object, ticks: object) -> Results:
            raise ValueError("no score")

    course = Course(lesson(3, attempts=2), 1, np.empty((0, LENGTH), np.float32))
    threads = StretchThreads(course, 2, Failing(Sphere()).on, perf_counter)
    with pytest.raises(ValueError, match="no score"):
        list(side_by_side(course, threads, begin(course), lambda: False))
    threads.close()


def test_nothing_is_begun_before_all_are_asked_for_and_nothing_comes_of_nothing() -> None:
    course, told = Course(lesson(3, attempts=2), 1, UNKNOWN), Told(Sphere())
    threads = StretchThreads(course, 2, told.on, perf_counter)
    assert threads.next_result() is None
    for number in range(2):
        assert threads.has_room()
        threads.submit(number, Stretch(number, begin(course).now))
    assert not threads.has_room()
    assert told.cores == []
    found = [done for _ in range(2) if (done := threads.next_result())]
    assert {job for job, _ in found} == {0, 1}
    assert all(isinstance(segment, Segment) and len(segment.records) == 1 for _, segment in found)
    assert told.cores == [1, 1]
