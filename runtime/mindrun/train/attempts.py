"""The attempts of a lesson side by side: whatever order they end in, the lesson goes as if it were one by one.

An attempt asks no other but at a rung. There it is decided in the order of attempts: one ahead of its turn is cut in
retrospect, where it stood at the rung.
"""

from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field
from heapq import heappop, heappush
from queue import Empty, SimpleQueue
from threading import Event
from typing import Any, Protocol

import numpy as np

from mindrun.graph.run_scores import Scores as RunScores
from mindrun.graph.weights import Weights
from mindrun.train.attempt import Clock, Segment, Stretch, advance
from mindrun.train.lesson_state import (
    AttemptState,
    Course,
    LessonState,
    Record,
    Verdict,
    begin_attempt,
    ended,
    gone_on,
    heights,
    is_behind,
    is_over,
    judged,
    rung_at,
)
from mindrun.train.scoring import Scorer, WrappedScorer

POLL_SECONDS = 0.2  # to wait for a segment before who asks may look at something else


@dataclass(frozen=True, slots=True)
class Ahead:
    """Work done ahead of its turn, which a lesson has not come to: so many generations of so many attempts."""

    attempts: int = 0
    generations: int = 0


NOTHING_AHEAD = Ahead()


@dataclass(frozen=True, slots=True)
class Step:
    """A step of a lesson: its state after it, and the generations since the step before, with the champion of each."""

    state: LessonState
    records: tuple[Record, ...]
    champions: tuple[Weights, ...]
    ahead: Ahead


class AttemptExecutor(Protocol):
    """An executor of stretches: any number at once, in any order; one that was lost is done again."""

    def has_room(self) -> bool:
        """True if somebody would be idle without another job."""

    def submit(self, job: int, stretch: Stretch) -> None:
        """Ask for a stretch."""

    def next_result(self) -> tuple[int, Segment] | None:
        """A job that has ended, and its segment; None after a while without one."""


class InThisThread:
    """An executor that does one stretch after the other, a generation each, when its segment is asked for."""

    def __init__(self, course: Course, scorer: Scorer, clock: Clock) -> None:
        self._course, self._scorer, self._clock = course, scorer, clock
        self._asked: tuple[int, Stretch] | None = None

    def has_room(self) -> bool:
        return self._asked is None

    def submit(self, job: int, stretch: Stretch) -> None:
        self._asked = job, stretch

    def next_result(self) -> tuple[int, Segment] | None:
        if self._asked is None:
            return None
        (job, stretch), self._asked = self._asked, None
        return job, advance(self._course, self._scorer, stretch, self._clock, most=1)


class StretchThreads:
    """An executor that does as many stretches at once as there are `cores`; `on` makes a scorer for so many of them.

    Attempts fewer than cores share them. So many lanes as an attempt has in one thread cost less than in several.
    """

    def __init__(self, course: Course, cores: int, on: Callable[[int], Any], clock: Clock) -> None:
        self._course, self._cores, self._on, self._clock = course, cores, on, clock
        self._asked: list[tuple[int, Stretch]] = []
        self._jobs: dict[Future[Segment], int] = {}
        self._ended: SimpleQueue[Future[Segment]] = SimpleQueue()
        self._pool, self._stop = ThreadPoolExecutor(cores), Event()

    def has_room(self) -> bool:
        return len(self._jobs) + len(self._asked) < self._cores

    def submit(self, job: int, stretch: Stretch) -> None:
        """Ask for a stretch; it begins when all that there are have been asked for."""
        self._asked.append((job, stretch))

    def next_result(self) -> tuple[int, Segment] | None:
        """None after POLL_SECONDS without a segment. Whatever a stretch raises is raised here."""
        at_work = len(self._jobs) + len(self._asked)
        for job, stretch in self._asked:
            scorer = Stoppable(self._on(-(-self._cores // at_work)), self._stop)
            future = self._pool.submit(advance, self._course, scorer, stretch, self._clock, most=1)
            self._jobs[future] = job
            future.add_done_callback(self._ended.put)
        self._asked.clear()
        try:
            ended = self._ended.get(timeout=POLL_SECONDS)
        except Empty:
            return None
        return self._jobs.pop(ended), ended.result()

    def close(self) -> None:
        """Have all stretches end in the middle of what they do; nobody waits for that."""
        self._stop.set()
        self._pool.shutdown(wait=False)


class ScoringStoppedError(Exception):
    """Scoring was stopped, since nobody waits for the scores any more."""


class Stoppable(WrappedScorer):
    """A scorer that asks another until `stop` is set: then it raises ScoringStoppedError, in the middle of its runs."""

    def __init__(self, scorer: Any, stop: Event) -> None:
        super().__init__(scorer)
        self._stop = stop

    def score(self, genomes: Any, seeds: Any, *, ticks: int | None = None) -> RunScores:
        results: RunScores = self.rollout.score(genomes, seeds, self._ran, ticks=ticks)
        return results

    def _ran(self, runs: float) -> None:
        if self._stop.is_set():
            raise ScoringStoppedError


@dataclass(slots=True)
class Track:
    """An attempt that has begun: where it stands, and its segments that the lesson has not come to yet."""

    number: int
    state: AttemptState
    job: int = -1  # that is at it; -1 for none
    segments: deque[Segment] = field(default_factory=deque)
    at_rung: dict[int, AttemptState] = field(default_factory=dict)  # where it stood there
    cut: AttemptState | None = None  # where it was found behind
    verdict: Verdict | None = None


@dataclass(slots=True)
class Attempts:
    """The attempts of a course from a state on; `decided` has for each rung how many have been decided there."""

    course: Course
    lesson: LessonState
    tracks: dict[int, Track] = field(default_factory=dict)
    decided: dict[int, int] = field(default_factory=dict)
    rows: np.ndarray[tuple[int, int], np.dtype[np.float64]] = field(init=False)
    ready: list[tuple[int, int]] = field(default_factory=list)  # attempts that a job could go on with, the first first
    jobs: dict[int, int] = field(default_factory=dict)  # the attempt of each
    begun: int = 0
    asked: int = 0

    def __post_init__(self) -> None:
        lesson, number = self.course.lesson, self.lesson.attempt
        count = lesson.learner.attempts
        self.rows = np.full((count, lesson.learner.rungs), -np.inf)
        self.rows[:number] = self.lesson.rungs
        reached = self.lesson.now.population.generation
        for height in heights(lesson.learner.rungs):
            if (rung := rung_at(lesson, place := int(height * lesson.generations))) is not None:
                self.decided[rung] = number + (number < count and place <= reached)
        self.begun = number
        if number < count:
            self.rows[number] = self.lesson.now.climbed
            self._begin(self.lesson.now)

    def next_stretch(self) -> tuple[int, Stretch] | None:
        """The job that is most wanted; None where there is none to do."""
        while self.ready or self.begun < self.course.lesson.learner.attempts:
            if not self.ready:
                self._begin(begin_attempt(self.course))
            _, number = heappop(self.ready)
            track = self.tracks.get(number)
            if track is None or track.job >= 0 or track.verdict is not None:
                continue
            self.asked += 1
            track.job = self.asked
            self.jobs[self.asked] = number
            return self.asked, Stretch(number, track.cut or track.state, track.cut is not None)
        return None

    def put(self, job: int, segment: Segment) -> None:
        """Take in the segment of a job; one of a job that has become needless is dropped."""
        track = self.tracks.get(self.jobs.pop(job, -1))
        if track is None or track.job != job:
            return
        track.job, track.verdict = -1, segment.verdict
        if track.cut is not None:
            track.segments[-1] = track.segments[-1].then(segment)
        else:
            track.state = segment.state
            self._append(track, segment)
        if segment.verdict is None:
            heappush(self.ready, (track.number, track.number))
        self._decide()

    def steps(self) -> Iterator[Step]:
        """The steps, in order, that the lesson can make with the segments that are here."""
        while (track := self.tracks.get(self.lesson.attempt)) and track.segments:
            if is_over(self.course.lesson, self.lesson) or self._is_open(track, track.segments[0]):
                return
            yield self._gone_on(track, track.segments.popleft())

    def ahead(self) -> Ahead:
        done = [t.state.population.generation for number, t in self.tracks.items() if number > self.lesson.attempt]
        return Ahead(sum(map(bool, done)), sum(done))

    def _begin(self, state: AttemptState) -> None:
        self.tracks[self.begun] = Track(self.begun, state)
        heappush(self.ready, (self.begun, self.begun))
        self.begun += 1

    def _append(self, track: Track, segment: Segment) -> None:
        """Keep a segment, joined to the one before unless a decision may come between them."""
        if track.segments and all(track.segments[-1].state is not at_rung for at_rung in track.at_rung.values()):
            segment = track.segments.pop().then(segment)
        track.segments.append(segment)
        rung = rung_at(self.course.lesson, segment.state.population.generation)
        if rung is not None:
            track.at_rung[rung] = segment.state
            self.rows[track.number, rung] = segment.state.climbed[rung]

    def _is_open(self, track: Track, segment: Segment) -> bool:
        """True if it is not known yet what becomes of an attempt behind a segment."""
        if segment.verdict is not None:
            return False
        rung = rung_at(self.course.lesson, segment.state.population.generation)
        return track.cut is segment.state or (rung is not None and self.decided[rung] <= track.number)

    def _decide(self) -> None:
        """Decide at each rung about every attempt of which all before have come there, or never will."""
        below = None
        for rung in self.decided:
            while (track := self.tracks.get(self.decided[rung])) and (
                below is None or track.number < self.decided[below]
            ):
                never = track.cut is not None or (track.verdict is not None and rung not in track.at_rung)
                if never:
                    self.rows[track.number, rung] = -np.inf
                elif rung not in track.at_rung:
                    break
                elif track.verdict is None or track.at_rung[rung] is not track.state:
                    self._compare(track, rung)
                self.decided[rung] += 1
            below = rung

    def _compare(self, track: Track, rung: int) -> None:
        """Cut an attempt that is behind at a rung: what it did since has not happened."""
        if not is_behind(self.rows[: track.number + 1, rung]):
            return
        track.cut, track.verdict, track.job = track.at_rung[rung], None, -1
        while track.segments and track.segments[-1].state is not track.cut:
            track.segments.pop()
        track.state = track.cut
        heappush(self.ready, (-1, track.number))  # it holds up all behind it
        self.rows[track.number, rung + 1 :] = -np.inf

    def _gone_on(self, track: Track, segment: Segment) -> Step:
        records = [*segment.records]
        if segment.verdict is not None:
            records[-1] = judged(records[-1], segment.verdict)
        for record in records:
            self.lesson = gone_on(self.lesson, segment.state, record)
        if segment.verdict is not None:
            self.lesson = ended(self.course, self.lesson, segment.verdict)
            del self.tracks[track.number]
        return Step(self.lesson, tuple(records), segment.champions, self.ahead())


def side_by_side(
    course: Course, executor: AttemptExecutor, state: LessonState, stop: Callable[[], bool]
) -> Iterator[Step]:
    """The steps of a lesson whose attempts an executor does; iteration may stop after any of them."""
    attempts = Attempts(course, state)
    while not is_over(course.lesson, attempts.lesson) and not stop():
        while executor.has_room() and (job := attempts.next_stretch()):
            executor.submit(*job)
        if (done := executor.next_result()) is not None:
            attempts.put(*done)
            yield from attempts.steps()
