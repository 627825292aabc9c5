"""The operators of expressions on arrays, in float64."""

from collections.abc import Callable
from operator import add, mul, sub, truediv
from typing import Any

import numpy as np


def _known(holds: Any, left: Any, right: Any) -> Any:
    return np.where(np.isnan(left) | np.isnan(right), np.nan, holds)[()]


def least(left: Any, right: Any) -> Any:
    """The smaller of two numbers; NaN where one of them is NaN."""
    return np.where((right < left) | np.isnan(right), right, left)[()]


def greatest(left: Any, right: Any) -> Any:
    """The larger of two numbers; NaN where one of them is NaN."""
    return np.where((right > left) | np.isnan(right), right, left)[()]


OPERATORS: dict[str, Callable[[Any, Any], Any]] = {
    "+": add, "-": sub, "*": mul, "/": truediv, "least": least, "greatest": greatest, "and": least, "or": greatest,
    "<": lambda left, right: _known(left < right, left, right),
    "<=": lambda left, right: _known(left <= right, left, right),
    ">": lambda left, right: _known(left > right, left, right),
    ">=": lambda left, right: _known(left >= right, left, right),
}  # fmt: skip
