"""Where attempts are compared early, so that the worse half of them ends there: successive halving, one by one."""

from math import inf

import numpy as np

from mindrun.graph.graph import Lesson
from mindrun.train.population import Scores


def heights(rungs: int) -> list[float]:
    """After which shares of its generations an attempt comes to its rungs, the lowest first."""
    return [0.5**rung for rung in range(rungs, 0, -1)]


def rung_at(lesson: Lesson, generation: int) -> int | None:
    """Which rung is after so many generations, at least one; None where none is."""
    at = (int(height * lesson.generations) for height in heights(lesson.learner.rungs))
    return next((rung for rung, place in enumerate(at) if place == generation), None)


def not_climbed(lesson: Lesson) -> Scores:
    """The scores [rungs] of an attempt that begins."""
    return np.full(lesson.learner.rungs, -inf)


def is_behind(scores: Scores) -> bool:
    """Whether the last of the attempts that came to a rung, with these scores [attempts], is in their worse half."""
    others, own = scores[:-1], scores[-1]
    came, better = int(np.isfinite(others).sum()), int((others > own).sum())
    return better >= max(1, (came + 1) // 2)
