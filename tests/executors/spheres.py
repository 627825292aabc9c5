"""Workers of the sphere that cost next to nothing, with a fault now and then; by what their processes call."""

import os
import pickle
from itertools import count
from time import sleep
from typing import Any

from mindlang.executors import cluster_jobs
from mindlang.executors.jobs import Assignment, Done, answer
from tests.train.climbing import Results, Sphere

ASSIGNMENT = Assignment(b"no bundle", "Climb", "Climb")
SLOW_SECONDS = 0.005
_calls = count(1)


def made(kind: type[Sphere], assignment: Assignment, threads: int) -> Sphere:
    """What scores an assignment, whatever that is."""
    return kind()


class Slow(Sphere):
    def score(self, genomes: Any, seeds: Any, ticks: int | None = None) -> Results:
        sleep(SLOW_SECONDS)
        return Sphere.score(self, genomes, seeds)


class Dying(Sphere):
    """Its process ends with each call of a number that no job reaches alone."""

    every = 200

    def score(self, genomes: Any, seeds: Any, ticks: int | None = None) -> Results:
        if next(_calls) % self.every == 0:
            os.kill(os.getpid(), 9)
        return Sphere.score(self, genomes, seeds)


class Deadly(Dying):
    every = 1


class Exiting(Sphere):
    def score(self, genomes: Any, seeds: Any, ticks: int | None = None) -> Results:
        raise SystemExit("out of " + "luck " * 1000)


# What a worker of Dask calls


def right(build: Any, assignment: bytes, work: bytes) -> object:
    found = answer(Sphere, pickle.loads(work))
    assert isinstance(found, Done), found
    return "done", pickle.dumps(found)


def delayed(build: Any, assignment: bytes, work: bytes) -> object:
    sleep(0.05)
    return right(build, assignment, work)


def no_answer(build: Any, assignment: bytes, work: bytes) -> object:
    return {"an": "object"}


def killing(build: Any, assignment: bytes, work: bytes) -> object:
    os.kill(os.getpid(), 9)
    return ()


def raising(build: Any, assignment: bytes, work: bytes) -> object:
    raise RuntimeError("out of " + "luck " * 1000)


def of_another_build(build: Any, assignment: bytes, work: bytes) -> object:
    return cluster_jobs.answer_here({**build, "numpy": "1.0"}, assignment, b"that nobody unpickles")
