"""What a lesson comes to while it is taught, step by step."""

from dataclasses import dataclass

from mindrun.train.lesson_state import LessonState, Record
from mindrun.train.population import Genomes


@dataclass(frozen=True, slots=True)
class Ahead:
    """What has been done ahead of its turn, which a lesson has not come to: so many generations of so many attempts."""

    attempts: int = 0
    generations: int = 0


NOTHING_AHEAD = Ahead()


@dataclass(frozen=True, slots=True)
class Step:
    """What a lesson has come to: its state, and the generations since the step before, with the champion of each."""

    state: LessonState
    records: tuple[Record, ...]
    champions: Genomes
    ahead: Ahead = NOTHING_AHEAD
