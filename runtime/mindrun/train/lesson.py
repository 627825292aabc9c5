"""One lesson: attempt after attempt, and the weights kept are those that do best on layouts never seen."""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from mindrun.graph.graph import Lesson
from mindrun.train import attempt
from mindrun.train.attempt import Verdict, ends_by_itself, judge
from mindrun.train.lesson_state import AttemptState, Course, LessonState, Record, begin_attempt, is_over
from mindrun.train.rungs import is_behind, rung_at
from mindrun.train.scoring import Scorer

Clock = Callable[[], float]


def teach(course: Course, scorer: Scorer, state: LessonState, clock: Clock) -> Iterator[tuple[LessonState, Record]]:
    """The state and the record after each generation that is left; who iterates may stop after any of them."""
    while not is_over(course.lesson, state):
        began = clock()
        state, record = generation(course, scorer, state)
        seconds = clock() - began
        state = replace(state, seconds=state.seconds + seconds)
        yield state, replace(record, seconds=seconds)


def generation(course: Course, scorer: Scorer, state: LessonState) -> tuple[LessonState, Record]:
    """One generation of the attempt at work, and its end where it comes to it."""
    now, record = attempt.generation(course, scorer, state.attempt, state.now)
    if not has_ended(course.lesson, replace(state, now=now)):
        return gone_on(state, now, record), record
    verdict = judge(course, scorer, now)
    record = judged(record, verdict)
    return ended(course, gone_on(state, now, record), verdict), record


def has_ended(lesson: Lesson, state: LessonState) -> bool:
    """Whether the attempt at work ends by itself, or falls behind others at a rung."""
    rung = rung_at(lesson, state.now.population.generation)
    if ends_by_itself(lesson, state.now):
        return True
    return rung is not None and is_behind(np.append(state.rungs[:, rung], state.now.climbed[rung]))


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
