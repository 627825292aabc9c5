"""The types of arrays that kinds, engine and learning exchange; the operators of expressions on arrays."""

from collections.abc import Callable, Mapping
from operator import add, mul, neg, sub, truediv
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.numbers.expression import Program, fold

Array = NDArray[Any]
Doubles = NDArray[np.float64]
Singles = NDArray[np.float32]
Integers = NDArray[np.int64]
Bools = NDArray[np.bool_]
Readings = Singles
Reader = Callable[[int, Readings, Readings | None], Readings | np.float32]  # the tick's number, readings now and before
Keeper = Callable[[Singles, np.float32, Readings], Singles]  # what a memory keeps, its command, the readings
Weights = NDArray[np.float32]  # of one skill: [genes]
WeightsBySkill = Mapping[str, Weights]
Layers = tuple[tuple[int, int], ...]  # of a network: (values in, values out) of each
Compute = Callable[[Singles], Singles]  # a skill's inputs to its outputs
Leaf = Callable[[str, Any], Any]  # the word and the operand of a leaf of an expression to its values [rows], or to one
Frame = NDArray[np.uint8]  # of a camera: [row, column, blue green red]


def _known(holds: Any, left: Any, right: Any) -> Any:
    return np.where(np.isnan(left) | np.isnan(right), np.nan, holds)[()]


def _when(value: Any, holds: Any) -> Any:
    chosen = np.where((holds > 0) & np.isfinite(value), value, np.nan)
    return np.where(holds == 0, np.inf, chosen)[()]


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
    "when": _when,
    "otherwise": lambda value, other: np.where(value == np.inf, other, value)[()],
}  # fmt: skip


def columns(readings: Readings) -> Leaf:
    """The leaves of expressions over readings [rows, width], float64 as in the engine."""
    return lambda word, x: readings[:, int(x)].astype(np.float64) if word == "reading" else np.float64(x)


def evaluate_rows(program: Program, leaf: Leaf, rows: int) -> NDArray[np.float64]:
    """The value of an expression in each of so many rows, `leaf` giving those of its readings [rows]."""
    with np.errstate(all="ignore"):
        value = fold(program, leaf, neg, lambda operator, left, right: OPERATORS[operator](left, right))
        return np.broadcast_to(np.float64(value), (rows,))
