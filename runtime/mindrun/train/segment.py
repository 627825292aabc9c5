"""The unit of work of attempts side by side: a stretch of one attempt is asked for, and a segment comes of it."""

from dataclasses import dataclass, replace

import numpy as np

from mindrun.graph.graph import Lesson
from mindrun.train import attempt
from mindrun.train.attempt import Verdict, ends_by_itself, judge
from mindrun.train.lesson import Clock
from mindrun.train.lesson_state import AttemptState, Course, Record
from mindrun.train.population import Genomes
from mindrun.train.rungs import rung_at
from mindrun.train.scoring import Scorer

SEGMENT_SECONDS = 2.0  # after which a segment ends with the generation at work
SEGMENT_GENERATIONS = 100  # at most in a segment


@dataclass(frozen=True, slots=True)
class Stretch:
    """A job: attempt `number`, which counts from 0, from a state on; with `cut` it ends there, and is judged."""

    number: int
    state: AttemptState
    cut: bool = False


@dataclass(frozen=True, slots=True)
class Segment:
    """What came of a stretch: `records` and `champions` [records, weights] of its generations, and where it stands now.

    `verdict` is there where the attempt has ended.
    """

    state: AttemptState
    records: tuple[Record, ...]
    champions: Genomes
    verdict: Verdict | None


class Joined:
    """Segments of an attempt, each from where that before ends, as one; what they have is copied when it is read."""

    def __init__(self, first: Segment) -> None:
        self.state, self.verdict = first.state, first.verdict
        self._records, self._champions = [*first.records], [first.champions]

    def add(self, segment: Segment) -> None:
        """Join one that goes on from here."""
        self.state, self.verdict = segment.state, segment.verdict
        self._records.extend(segment.records)
        self._champions.append(segment.champions)

    def whole(self) -> Segment:
        """All as one segment."""
        self._champions = [np.concatenate(self._champions)]
        return Segment(self.state, tuple(self._records), self._champions[0], self.verdict)


def advance(course: Course, scorer: Scorer, stretch: Stretch, clock: Clock, most: int = SEGMENT_GENERATIONS) -> Segment:
    """An attempt goes on until it ends by itself, comes to a rung, or has been at it for long enough.

    That is some seconds, or `most` generations.
    """
    state, records, champions = stretch.state, list[Record](), [stretch.state.champion[:0]]
    began = clock()
    while not (stretch.cut or is_over(course.lesson, state, len(records), clock() - began, most)):
        start = clock()
        state, record = attempt.generation(course, scorer, stretch.number, state)
        records.append(replace(record, seconds=clock() - start))
        champions.append(state.champion)
    ends = stretch.cut or ends_by_itself(course.lesson, state)
    verdict = judge(course, scorer, state) if ends else None
    return Segment(state, tuple(records), np.concatenate(champions), verdict)


def is_over(lesson: Lesson, state: AttemptState, generations: int, seconds: float, most: int) -> bool:
    """Whether a segment ends here, after so many generations and seconds."""
    return generations > 0 and (
        ends_by_itself(lesson, state)
        or rung_at(lesson, state.population.generation) is not None
        or seconds >= SEGMENT_SECONDS
        or generations >= most
    )
