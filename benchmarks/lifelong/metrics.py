"""The figures of lifelong learning, from what each task counts after each lesson.

`p` [lessons, tasks] is the performance on each task after each lesson, 0 to 1, NaN where nobody could play it yet; task
number i is that of lesson number i. Average performance, forgetting and forward transfer as in Continual World
(Wołczyk et al., 2021) and COOM (Tomilin et al., 2023), backward transfer as in GEM (Lopez-Paz and Ranzato, 2017).
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Matrix = NDArray[np.float64]


def performance(counts: Matrix, reference: Matrix) -> Matrix:
    """Counts [lessons, tasks] as shares of those of a reference [tasks], 0 to 1: who does better has 1, too.

    >>> performance(np.array([[12.5, np.nan], [5.0, 60.0]]), np.array([25.0, 50.0]))
    array([[0.5, nan],
           [0.2, 1. ]])
    """
    return np.clip(counts / reference, 0.0, 1.0)


def average_performance(p: Matrix) -> float:
    """The mean over the tasks after the last lesson.

    >>> average_performance(np.array([[1.0, 0.0], [0.5, 1.0]]))
    0.75
    """
    return float(p[-1, : len(p)].mean())


def forgetting(p: Matrix) -> Matrix:
    """The loss of each task [task]: p after its own lesson less p after the last one.

    >>> forgetting(np.array([[1.0, 0.0], [0.25, 1.0]]))
    array([0.75, 0.  ])
    """
    return np.diagonal(p) - p[-1, : len(p)]


def backward_transfer(p: Matrix) -> float:
    """What all tasks but the last have gained since their own lessons, on the mean; NaN after one lesson.

    >>> backward_transfer(np.array([[0.5, 0.0], [0.75, 1.0]]))
    0.25
    """
    return float(-forgetting(p)[:-1].mean()) if len(p) > 1 else float("nan")


def area(curve: Sequence[tuple[int, float]], reference: float, ticks: float) -> float:
    """The area under a curve of (ticks, count) over a lesson of so many ticks, as a share of the reference's, 0 to 1.

    A count holds until the next; before the first it is 0.

    >>> area([(25, 5.0), (50, 20.0)], 10.0, 100)
    0.625
    """
    ends = [*(min(at, ticks) for at, _ in curve[1:]), ticks]
    spans = [max(0.0, end - at) for (at, _), end in zip(curve, ends, strict=False)]
    return sum(span * min(1.0, count / reference) for span, (_, count) in zip(spans, curve, strict=False)) / ticks


def forward_transfer(own: Matrix, scratch: Matrix) -> Matrix:
    """How much sooner each task was learnt than from scratch, by the areas of both: 1 at once, 0 as soon, < 0 later.

    >>> forward_transfer(np.array([0.9, 0.25]), np.array([0.5, 0.5]))
    array([ 0.8, -0.5])
    """
    return (own - scratch) / (1.0 - scratch)


def ticks_to(curve: Sequence[tuple[int, float]], least: float) -> float:
    """The ticks after which a champion first counts at least so much; infinite where none does.

    >>> ticks_to([(25, 5.0), (50, 20.0)], 9.0), ticks_to([], 1.0)
    (50.0, inf)
    """
    return next((float(at) for at, count in curve if count >= least), float("inf"))
