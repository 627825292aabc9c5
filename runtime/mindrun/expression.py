"""Expressions of the language as postfix programs, computed in float64."""

from operator import add, mul, sub, truediv

import numpy as np
from numpy.typing import NDArray

OPERATORS = {"+": add, "-": sub, "*": mul, "/": truediv}


def evaluate(program: tuple[tuple[str, float | int], ...], readings: NDArray[np.float32]) -> np.float64:
    """The value of an `at` expression over the readings; a division by zero gives inf or NaN, as numpy has it."""
    stack: list[np.float64] = []
    for operator, operand in program:
        match operator:
            case "number":
                stack.append(np.float64(operand))
            case "reading":
                stack.append(np.float64(readings[int(operand)]))
            case "negate":
                stack.append(-stack.pop())
            case _:
                right = stack.pop()
                stack.append(OPERATORS[operator](stack.pop(), right))
    return stack.pop()


def leaves(program: tuple[tuple[str, float | int], ...], leaf: str) -> set[int]:
    """The indices that a program names as `leaf`: "reading" or "measure"."""
    return {int(operand) for operator, operand in program if operator == leaf}


def is_sound(program: tuple[tuple[str, float | int], ...]) -> bool:
    """Whether a program never takes from an empty stack and leaves exactly one value."""
    height = 0
    for operator, _ in program:
        takes = 2 if operator in OPERATORS else 1 if operator == "negate" else 0
        if height < takes:
            return False
        height += 1 - takes
    return height == 1
