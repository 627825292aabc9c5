"""Stretches done in threads of this process, generation by generation: each attempt has its part of the cores."""

from collections.abc import Callable
from queue import Empty, SimpleQueue
from threading import Event, Thread
from typing import Any

import numpy as np

from mindrun.graph.graph import Task
from mindrun.train.attempt import Clock, Segment, Stretch, advance
from mindrun.train.lesson_state import Course
from mindrun.train.population import Genomes
from mindrun.train.scoring import Results, is_one_world

TAKE_SECONDS = 0.2  # to wait for a segment before who asks may look at something else


class StretchThreads:
    """Does as many stretches at once as there are `cores`; `on` makes what scores on so many of them.

    Attempts fewer than cores share them. So many lanes as an attempt has in one thread cost less than in several.
    """

    def __init__(self, course: Course, cores: int, on: Callable[[int], Any], clock: Clock) -> None:
        self._course, self._cores, self._on, self._clock = course, cores, on, clock
        self._asked: list[tuple[int, Stretch]] = []
        self._done: SimpleQueue[tuple[int, Segment] | BaseException] = SimpleQueue()
        self._at_work, self._stop = 0, Event()

    def has_room(self) -> bool:
        """Whether a core would wait without another stretch."""
        return self._at_work + len(self._asked) < self._cores

    def submit(self, job: int, stretch: Stretch) -> None:
        """Ask for a stretch; it begins when all that there are have been asked for."""
        self._asked.append((job, stretch))

    def take(self) -> tuple[int, Segment] | None:
        """A job and its segment; None where for a while none came. Whatever a stretch raises is raised here."""
        self._begin()
        try:
            done = self._done.get(timeout=TAKE_SECONDS)
        except Empty:
            return None
        self._at_work -= 1
        if isinstance(done, BaseException):
            raise done
        return done

    def close(self) -> None:
        """Have all stretches end in the middle of what they do; nobody waits for that."""
        self._stop.set()

    def _begin(self) -> None:
        self._at_work += len(self._asked)
        for job, stretch in self._asked:
            scorer = Stoppable(self._on(-(-self._cores // self._at_work)), self._stop)
            Thread(target=self._do, args=(job, stretch, scorer), daemon=True).start()
        self._asked.clear()

    def _do(self, job: int, stretch: Stretch, scorer: "Stoppable") -> None:
        try:
            self._done.put((job, advance(self._course, scorer, stretch, self._clock, most=1)))
        except BaseException as error:
            self._done.put(error)


class StoppedError(Exception):
    """Nobody waits for these scores any more."""


class Stoppable:
    """Scores as another does, until `stop` is set: then it raises StoppedError, in the middle of its runs."""

    def __init__(self, scorer: Any, stop: Event) -> None:
        self._scorer, self._stop = scorer, stop
        self.genome_length: int = scorer.genome_length
        self.task: Task = scorer.task
        self.is_one_world = is_one_world(scorer)

    def draw(self, count: int, rng: np.random.Generator) -> Genomes:
        """Random genomes [count, genome_length] for learning to begin with."""
        genomes: Genomes = self._scorer.draw(count, rng)
        return genomes

    def score(self, genomes: Any, seeds: Any) -> Results:
        """Every genome on every seed."""
        results: Results = self._scorer.score(genomes, seeds, self._ran)
        return results

    def _ran(self, runs: float) -> None:
        if self._stop.is_set():
            raise StoppedError
