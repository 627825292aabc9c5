"""Jobs: pure functions of what they say and of their assignment, done by any worker, in any order, any number of times.

A job is a stretch of an attempt, or genomes to be scored on seeds. What came of it is an answer; why it was not done is
one, too, in plain words.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from mindrun.errors import MindError
from mindrun.graph.run_scores import Scores
from mindrun.train.attempt import Clock, Segment, Stretch, advance
from mindrun.train.lesson_state import Course
from numpy.typing import NDArray

TAKE_SECONDS = 0.2  # to wait for an answer before who asks may look at something else
MAX_LOSSES = 5  # times that a job may be lost with its worker
FATAL = "the same job ends whoever does it: memory may run out there, or a procedure or an environment end the process"

Tally = NDArray[np.int64]


class WorkError(MindError):
    """Work that no worker can do."""


@dataclass(frozen=True, slots=True)
class Assignment:
    """What all jobs of a training or a bench share: a task under a master, and the packed bundle that has both.

    A genome has the weights of the `learners`, one after the other. In `folder`, which no other machine is told, a
    module may stand that registers an environment.
    """

    bundle: bytes
    task: str
    master: str
    learners: tuple[str, ...] = ()
    interrupt: bool = True
    folder: Path | None = None


class Work(Protocol):
    """What a job is about; it is pickled."""

    def by(self, scorer: Any, clock: Clock) -> Any:
        """What comes of it, by what scores the job's assignment."""


@dataclass(frozen=True, slots=True)
class Advance:
    """A stretch of an attempt, of which a segment comes."""

    course: Course
    stretch: Stretch

    def by(self, scorer: Any, clock: Clock) -> Segment:
        """The segment."""
        return advance(self.course, scorer, self.stretch, clock)


@dataclass(frozen=True, slots=True)
class Score:
    """Genomes [genomes, weights] to be scored on seeds [seeds]."""

    genomes: NDArray[np.float32]
    seeds: NDArray[np.uint64]

    def by(self, scorer: Any, clock: Clock) -> Scores:
        """Every genome on every seed."""
        scores: Scores = scorer.score(self.genomes, self.seeds)
        return scores


@dataclass(frozen=True, slots=True)
class Done:
    """What came of a job, the seconds that it took, and what its scorer counted meanwhile beside the results."""

    result: Any
    seconds: float
    tally: Tally

    def count_in(self, scorer: Any) -> None:
        """Add what was counted elsewhere to what a scorer has counted."""
        if len(self.tally):
            scorer.add(self.tally)


@dataclass(frozen=True, slots=True)
class Failed:
    """Why a job was not done: the same would be so anywhere, so that it is not tried again."""

    message: str
    hint: str = ""


def tally_of(scorer: Any) -> Tally:
    """What a scorer has counted beside its results, as `mindrun.sim.outside.rollout` does; others count nothing."""
    return scorer.tally() if hasattr(scorer, "tally") else np.zeros(0, np.int64)


class JobExecutor(Protocol):
    """Does the jobs of one assignment; one whose worker is lost is done again."""

    @property
    def assignment(self) -> Assignment:
        """What all of its jobs share."""

    @property
    def workers(self) -> int:
        """How many jobs can be at work at once, as far as is known; it may change."""

    @property
    def has_begun(self) -> bool:
        """Whether a worker has been there by now: before, nobody has done anything."""

    def has_room(self) -> bool:
        """Whether a worker would wait without another job."""

    def submit(self, number: int, work: Work) -> None:
        """Ask for a job."""

    def take(self) -> tuple[int, Done] | None:
        """The number of a job that has been done, and its answer; None after TAKE_SECONDS without one.

        WorkError where none can come any more.
        """

    def close(self) -> None:
        """End all workers, whatever they do."""


@dataclass(frozen=True, slots=True)
class StretchExecutor:
    """Does the stretches of a course; what its workers count beside their results is counted in `scorer`."""

    course: Course
    jobs: JobExecutor
    scorer: Any = None

    def has_room(self) -> bool:
        """Whether a worker would wait without another stretch."""
        return self.jobs.has_room()

    def submit(self, job: int, stretch: Stretch) -> None:
        """Ask for a stretch."""
        self.jobs.submit(job, Advance(self.course, stretch))

    def take(self) -> tuple[int, Segment] | None:
        """The number of a job and its segment; None after TAKE_SECONDS without one."""
        if (taken := self.jobs.take()) is None:
            return None
        job, done = taken
        done.count_in(self.scorer)
        return job, done.result
