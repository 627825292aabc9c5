"""The region of a task's numbers in which most runs fail: a box that is peeled out of all that can be drawn.

Bump hunting (Friedman and Fisher, 1999): a tenth of the runs is cut off at one end of one number, where that leaves the
greatest share of failures, again and again.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mindlang.falsify.failures import Mask, Rate

PEELED_SHARE = 0.1  # of the runs in a box, by which it shrinks
MIN_FAILURES = 5  # in a box that is told
KEPT_SHARE = 0.95  # of a box's lower bound, with which a bound more is not worth being told

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


def worst_box(whole: Box, drawn: Doubles, failed: Mask) -> Box | None:
    """The box with the greatest lower bound of its failures' share; None where no smaller one has a greater than all.

    `whole` is all that numbers [runs, numbers] can be. A bound that adds little is left out.
    """
    box, best = whole, whole
    while (rate := _rate(box, drawn, failed)).failures >= MIN_FAILURES:
        if rate.low > _rate(best, drawn, failed).low:
            best = box
        box = max(_peeled(box, drawn), key=lambda each: _order(_rate(each, drawn, failed)), default=best)
        if box is best:
            break
    least = KEPT_SHARE * _rate(best, drawn, failed).low
    for number in range(len(whole.low)):
        for side in ("low", "high"):
            wider = best.cut(number, side, getattr(whole, side)[number])
            if _rate(wider, drawn, failed).low >= least:
                best = wider
    is_smaller = (best.low > whole.low).any() or (best.high < whole.high).any()
    return best if is_smaller and _rate(best, drawn, failed).low > _rate(whole, drawn, failed).low else None


def _rate(box: Box, drawn: Doubles, failed: Mask) -> Rate:
    held = box.holds(drawn)
    return Rate.of(int((held & failed).sum()), int(held.sum()))


def _order(rate: Rate) -> tuple[float, int]:
    return rate.share, rate.runs


def _peeled(box: Box, drawn: Doubles) -> Iterator[Box]:
    """The boxes that are left where some of the runs, at least one, are cut off at one end of one number."""
    held = drawn[box.holds(drawn)]
    for number, values in enumerate(held.T):
        least, most = np.quantile(values, [PEELED_SHARE, 1 - PEELED_SHARE])
        if len(above := values[values > least]):
            yield box.cut(number, "low", float(above.min()))
        if len(below := values[values < most]):
            yield box.cut(number, "high", float(below.max()))
