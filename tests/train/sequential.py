"""A lesson the obvious way: one generation after the other, each attempt to its end, and nothing ahead of its turn."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from mindrun.graph.graph import Lesson
from mindrun.train import attempt
from mindrun.train.attempt import Clock, ends_by_itself, judge
from mindrun.train.lesson_state import (
    Course,
    LessonState,
    Record,
    ended,
    gone_on,
    is_behind,
    is_over,
    judged,
    rung_at,
)
from mindrun.train.scoring import Scorer


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
