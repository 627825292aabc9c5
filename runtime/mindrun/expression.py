"""Expressions of the language as postfix programs, computed in float64."""

from collections.abc import Callable, Iterable
from operator import add, mul, sub, truediv
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

T = TypeVar("T")

# An expression in postfix order: ("number", x), ("reading", index), ("each", 0), ("measure", index into the task's
# measures), or (operator, 0) with one of + - * / negate.
Program = tuple[tuple[str, float | int], ...]

OPERATORS: dict[str, Callable[[Any, Any], Any]] = {"+": add, "-": sub, "*": mul, "/": truediv}


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


def leaves(program: Program, leaf: str) -> set[int]:
    """The indices that a program names as `leaf`: "reading" or "measure"."""
    return {int(operand) for operator, operand in program if operator == leaf}


def is_valid_program(program: Program) -> bool:
    """Whether a program never takes from an empty stack and leaves exactly one value."""
    height = 0
    for operator, _ in program:
        takes = 2 if operator in OPERATORS else 1 if operator == "negate" else 0
        if height < takes:
            return False
        height += 1 - takes
    return height == 1
