"""Interval arithmetic in float64: between which two numbers the value of an operation lies."""

from collections.abc import Callable
from itertools import product
from math import inf, isnan
from operator import add, sub, truediv

from mindrun.numbers.expression import TRUTHS

Interval = tuple[float, float]
UNBOUNDED: Interval = (-inf, inf)
UNIT_INTERVAL: Interval = (0.0, 1.0)


def _product(left: float, right: float) -> float:
    return left * right if left and right else 0.0  # an infinite bound is no value: 0 times whatever is read is 0


CORNERS: dict[str, Callable[[float, float], float]] = {
    "+": add, "-": sub, "*": _product, "/": truediv, "least": min, "greatest": max,
}  # fmt: skip


def negated(of: Interval) -> Interval:
    """The range of what has this range, with the other sign."""
    return -of[1], -of[0]


def combined(symbol: str, left: Interval, right: Interval) -> Interval:
    """All operations have their least and greatest value in corners, unless the divisor can be 0.

    A choice has both of its values.
    """
    if symbol in TRUTHS:
        return UNIT_INTERVAL
    if symbol == "when":
        return left
    if symbol == "otherwise":
        return min(left[0], right[0]), max(left[1], right[1])
    if symbol == "/" and right[0] <= 0 <= right[1]:
        return UNBOUNDED
    corners = [CORNERS[symbol](a, b) for a, b in product(left, right)]
    return UNBOUNDED if any(map(isnan, corners)) else (min(corners), max(corners))
