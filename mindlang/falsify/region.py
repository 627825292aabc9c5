"""The region of a task's numbers in which most runs fail: a box that is peeled out of all that can be drawn.

Bump hunting (Friedman and Fisher, 1999): a tenth of the runs is cut off at one end of one number, where that leaves the
greatest share of failures, again and again. Of all boxes that fail twice as often as usual the best is the one that is
most like the failures themselves: it holds many of them, and little else (Dice, 1945).
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mindlang.falsify.failures import Mask

PEELED_SHARE = 0.1  # of the runs in a box, by which it shrinks
MIN_FAILURES = 5  # in a box that is told
KEPT_SHARE = 0.95  # of what makes a box the best, with which a bound more is not worth being told
TIMES_WORSE = 2.0  # as often as anywhere a region fails

Doubles = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Box:
    """A range of each number, `low` to `high` [numbers]: runs whose numbers lie within them or at their ends."""

    low: Doubles
    high: Doubles

    def holds(self, drawn: Doubles) -> Mask:
        """A mask [runs] of the runs with these numbers [runs, numbers] that lie in the box."""
        return np.asarray(((drawn >= self.low) & (drawn <= self.high)).all(axis=1))

    def cut(self, number: int, side: str, value: float) -> "Box":
        """The box with another end of one of its numbers, `low` or `high`."""
        ends = getattr(self, side).copy()
        ends[number] = value
        return replace(self, **{side: ends})


@dataclass(frozen=True, slots=True)
class Tried:
    """Runs by their numbers [runs, numbers], whether they `failed` [runs], and their weights [runs].

    By its weight a run stands for so many of any: a search has made more where more fail.
    """

    drawn: Doubles
    failed: Mask
    weights: Doubles

    def share(self, box: Box) -> float:
        """The share of failures in a box."""
        held = box.holds(self.drawn)
        return float(self.weights[held & self.failed].sum() / max(self.weights[held].sum(), np.finfo(float).tiny))

    def failures(self, box: Box) -> int:
        return int((box.holds(self.drawn) & self.failed).sum())

    def likeness(self, box: Box) -> float:
        """How alike the runs in a box and those that failed are, 1 if they are the same; 0 where too few fail there."""
        held, failures = box.holds(self.drawn), float(self.weights[self.failed].sum())
        if self.share(box) < TIMES_WORSE * failures / self.weights.sum():
            return 0.0
        return float(2 * self.weights[held & self.failed].sum() / (self.weights[held].sum() + failures))


def worst_box(whole: Box, tried: Tried) -> Box | None:
    """The box that is most like the failures; None where no box fails twice as often as usual.

    `whole` is all that numbers can be. A bound that adds little is left out.
    """
    best, peeled = whole, [whole]
    while peeled and tried.failures(box := max(peeled, key=tried.share)) >= MIN_FAILURES:
        if tried.likeness(box) > tried.likeness(best):
            best = box
        peeled = [*_peeled(box, tried)]
    if best is whole:
        return None
    least = KEPT_SHARE * tried.likeness(best)
    for number in range(len(whole.low)):
        for side in ("low", "high"):
            wider = best.cut(number, side, getattr(whole, side)[number])
            if tried.likeness(wider) >= least:
                best = wider
    return best


def _peeled(box: Box, tried: Tried) -> Iterator[Box]:
    """The boxes that are left where runs of some weight, at least one, are cut off at one end of one number."""
    held = box.holds(tried.drawn)
    for number, values in enumerate(tried.drawn[held].T):
        order = np.argsort(values, kind="stable")
        below_each = np.cumsum(tried.weights[held][order])
        ends = np.array([PEELED_SHARE, 1 - PEELED_SHARE]) * below_each[-1]
        least, most = values[order][np.searchsorted(below_each, ends).clip(max=len(values) - 1)]
        if len(above := values[values > least]):
            yield box.cut(number, "low", float(above.min()))
        if len(below := values[values < most]):
            yield box.cut(number, "high", float(below.max()))
