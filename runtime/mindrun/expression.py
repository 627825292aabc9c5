"""Expressions of the language as postfix programs, computed in float64."""

from collections.abc import Callable, Iterable, Mapping
from operator import add, mul, sub, truediv
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

T = TypeVar("T")

# An expression in postfix order: ("number", x), ("reading", index), ("each", 0), ("measure", index into the task's
# measures), ("command", index of an actuator), or (operator, 0) with one of OPERATORS or negate. A condition is one
# that ends in one of TRUTHS: 1 where it holds, 0 where not, NaN where nobody can know.
Program = tuple[tuple[str, float | int], ...]

Formula = tuple[tuple[str, float | int | str], ...]  # a program in which readings stand by their names
TRUTHS = ("<", "<=", ">", ">=", "and", "or")


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


def fold(
    program: Iterable[tuple[str, Any]],
    leaf: Callable[[str, Any], T],
    negated: Callable[[T], T],
    combined: Callable[[str, T, T], T],
) -> T:
    """What a program comes to, from its leaves up: `leaf` gets a word such as "number" or "reading" and its operand.

    `combined` gets an operator, what is left of it and what is right. IndexError where the program is not whole.
    """
    stack: list[T] = []
    for word, operand in program:
        if word in OPERATORS:
            right = stack.pop()
            stack.append(combined(word, stack.pop(), right))
        else:
            stack.append(negated(stack.pop()) if word == "negate" else leaf(word, operand))
    return stack.pop()


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


def placed(formula: Formula, starts: Mapping[str, int]) -> Program:
    """The program of a formula; KeyError where it names what is not there."""
    return tuple((word, starts[x] if isinstance(x, str) else x) for word, x in formula)


def named(formula: Formula) -> tuple[str, ...]:
    """The readings that a formula names, each once."""
    return tuple(dict.fromkeys(x for _, x in formula if isinstance(x, str)))


def leaves(program: Program, leaf: str) -> set[int]:
    """The indices that a program names as `leaf`: "reading" or "measure"."""
    return {int(operand) for operator, operand in program if operator == leaf}


def is_condition(program: Program) -> bool:
    """Whether a program says 1 or 0: a comparison, or several with `and` and `or`."""
    return is_valid_program(program) and program[-1][0] in TRUTHS


def is_valid_program(program: Program) -> bool:
    """Whether a program never takes from an empty stack and leaves exactly one value."""
    height = 0
    for operator, _ in program:
        takes = 2 if operator in OPERATORS else 1 if operator == "negate" else 0
        if height < takes:
            return False
        height += 1 - takes
    return height == 1
