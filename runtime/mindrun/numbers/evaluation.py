"""The value of an expression, in float64."""

from collections.abc import Callable
from operator import add, mul, sub, truediv
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.numbers.expression import Program


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


def evaluate(program: Program, readings: NDArray[np.float32]) -> np.float64:
    """The value of an `at` expression over the readings; a division by zero gives inf or NaN, as numpy has it.

    A `fold` written out: a robot computes this in every tick, and it takes two thirds of the time.
    """
    stack: list[np.float64] = []
    for word, operand in program:
        match word:
            case "number":
                stack.append(np.float64(operand))
            case "reading":
                stack.append(np.float64(readings[int(operand)]))
            case "negate":
                stack.append(-stack.pop())
            case _:
                right = stack.pop()
                stack.append(OPERATORS[word](stack.pop(), right))
    return stack.pop()
