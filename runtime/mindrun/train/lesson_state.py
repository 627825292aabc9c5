"""The state of a lesson: all that it needs to go on, what is written down of each generation, and how it goes on.

Attempts are compared early, at rungs, so that the worse half of them ends there: successive halving, one by one.
"""

from dataclasses import dataclass, replace
from math import inf

import numpy as np
from numpy.typing import NDArray

from mindrun.graph.graph import Lesson
from mindrun.train.ask_and_tell import kept_count
from mindrun.train.population import Genomes, Population, Scores, empty_population, order


@dataclass(frozen=True, slots=True)
class Course:
    """The constants of a run; `start` [0 or 1, weights] is what the skill knows before the lesson."""

    lesson: Lesson
    seed: int
    start: Genomes

    @property
    def generations(self) -> int:
        return self.lesson.generations * self.lesson.learner.attempts


@dataclass(frozen=True, slots=True)
class AttemptState:
    """The state of an attempt, whatever becomes of others.

    `champion` [0 or 1, weights] is its best; `rival` [0 or 1, weights] the last one that was better beyond doubt than
    the one before it, found in generation `since`. `climbed` [rungs] has the score of its champion at each rung, the
    lowest first, on layouts that all attempts have there; -inf where it has not come so far.

    `told_apart` says whether the task has ever given two genomes of a generation different scores.
    """

    population: Population
    champion: Genomes
    rival: Genomes
    since: int
    climbed: Scores
    told_apart: bool


@dataclass(frozen=True, slots=True)
class LessonState:
    """The state of a lesson, all that is needed to go on: what has ended, and the attempt at work, `now`.

    Of the attempts that have ended, `champions` [ended, weights] are the best, `lengths` [ended] their generations,
    `rungs` [ended, rungs] how they had climbed, and `verdicts` [ended, 2] their scores on layouts that chose nothing
    before: the first decides between the attempts, the second, on yet others, is what is reported. `passed` [ended]
    says of each whether it meets what the lesson needs.

    The other numbers are of all attempts together. Where `told_apart` is False, there was nothing to learn from.
    """

    attempt: int
    now: AttemptState
    rungs: Scores
    champions: Genomes
    lengths: NDArray[np.int64]
    verdicts: Scores
    passed: NDArray[np.bool_]
    best: float
    generations: int
    ticks: int
    seconds: float
    faults: int
    told_apart: bool

    @property
    def _best(self) -> NDArray[np.intp]:
        """The attempt that is kept [0 or 1]: of those that passed, else of all, the first that did best."""
        eligible = np.flatnonzero(self.passed) if self.passed.any() else np.arange(len(self.passed))
        return eligible[order(self.verdicts[eligible, 0])[:1]]

    @property
    def kept(self) -> Genomes:
        return self.champions[self._best]

    @property
    def kept_after(self) -> int:
        """The generations of the attempt whose champion is kept; 0 before one has ended."""
        return int(self.lengths[self._best[0]]) if len(self.lengths) else 0

    @property
    def verdict(self) -> tuple[float, float]:
        """Both scores of the kept one on layouts that its generations never saw; -inf before an attempt has ended."""
        first, second = self.verdicts[self._best[0]].tolist() if len(self.verdicts) else (-inf, -inf)
        return first, second

    @property
    def reevaluated(self) -> float:
        return self.verdict[1]


@dataclass(frozen=True, slots=True)
class Record:
    """One generation in the log; attempts and generations count from 1.

    `reevaluated` is the champion's score where it was tried on fresh layouts, `verdict` its score at the attempt's end.

    >>> seen = []
    >>> options = mindlang.TrainOptions(generations=2, attempts=1)
    >>> [result] = mind.train("GoToObject", options=options, on_generation=seen.append)
    >>> [record.generation for record in seen]
    [1, 2]
    """

    attempt: int
    generation: int
    best: float
    mean: float
    reevaluated: float | None
    verdict: float | None
    ticks: int
    seconds: float
    faults: int


@dataclass(frozen=True, slots=True)
class Verdict:
    """The verdict on an attempt's champion: of `scores` [2] the first decides between attempts, the second is reported.

    `passed` says whether it meets all that the lesson needs, on the layouts of the one score and on those of the other.
    """

    scores: Scores
    passed: bool
    ticks: int
    faults: int


def begin_attempt(course: Course) -> AttemptState:
    nothing = course.start[:0]
    return AttemptState(
        empty_population(nothing.shape[1]), course.start, nothing, 0, np.full(course.lesson.learner.rungs, -inf), False
    )


def begin(course: Course) -> LessonState:
    rungs = np.empty((0, course.lesson.learner.rungs))
    ended = rungs, course.start[:0], np.empty(0, np.int64), np.empty((0, 2)), np.empty(0, np.bool_)
    return LessonState(0, begin_attempt(course), *ended, -inf, 0, 0, 0.0, 0, False)


def is_over(lesson: Lesson, state: LessonState) -> bool:
    """True if a lesson has come to its end: after all its attempts, or the first that meets what it needs."""
    return state.attempt >= lesson.learner.attempts or bool(lesson.needs and state.passed.any())


def is_reachable(course: Course, state: LessonState) -> bool:
    """True if a state that was read is one to which a run of this course could have come."""
    individuals, weights = state.now.population.genomes.shape
    generation = state.now.population.generation
    return (
        weights == course.start.shape[1]
        and individuals in (0, kept_count(course.lesson.learner))
        and state.attempt <= course.lesson.learner.attempts
        and state.rungs.shape[1] == len(state.now.climbed) == course.lesson.learner.rungs
        and state.now.since <= generation < max(1, course.lesson.generations)
        and not (state.lengths > course.lesson.generations).any()
    )


def gone_on(state: LessonState, now: AttemptState, record: Record) -> LessonState:
    """The state after a generation of the attempt at work, which stands at `now`."""
    return replace(
        state,
        now=now,
        best=max(state.best, record.best),
        generations=state.generations + 1,
        ticks=state.ticks + record.ticks,
        seconds=state.seconds + record.seconds,
        faults=state.faults + record.faults,
        told_apart=state.told_apart or now.told_apart,
    )


def judged(record: Record, verdict: Verdict) -> Record:
    """The record of the generation with which an attempt ends."""
    ticks, faults = record.ticks + verdict.ticks, record.faults + verdict.faults
    return replace(record, verdict=float(verdict.scores[1]), ticks=ticks, faults=faults)


def ended(course: Course, state: LessonState, verdict: Verdict) -> LessonState:
    """The state where the attempt at work has ended, and the next one begins."""
    return replace(
        state,
        attempt=state.attempt + 1,
        now=begin_attempt(course),
        rungs=np.concatenate([state.rungs, state.now.climbed[None]]),
        champions=np.concatenate([state.champions, state.now.champion]),
        lengths=np.append(state.lengths, state.now.population.generation),
        verdicts=np.concatenate([state.verdicts, verdict.scores[None]]),
        passed=np.append(state.passed, verdict.passed),
    )


def heights(rungs: int) -> list[float]:
    """The shares of its generations after which an attempt comes to its rungs, the lowest first."""
    return [0.5**rung for rung in range(rungs, 0, -1)]


def rung_at(lesson: Lesson, generation: int) -> int | None:
    """The rung after so many generations, at least one; None where none is."""
    at = (int(height * lesson.generations) for height in heights(lesson.learner.rungs))
    return next((rung for rung, place in enumerate(at) if place == generation), None)


def is_behind(scores: Scores) -> bool:
    """True if the last of the attempts that came to a rung, with these scores [attempts], is in their worse half."""
    others, own = scores[:-1], scores[-1]
    came, better = int(np.isfinite(others).sum()), int((others > own).sum())
    return better >= max(1, (came + 1) // 2)
