"""Expressions of the language as postfix programs, and their values, without numpy."""

from array import array
from collections.abc import Callable, Iterable, Mapping
from math import copysign, inf, isfinite, isnan, nan
from operator import add, ge, gt, le, lt, mul, sub
from typing import Any, TypeVar

T = TypeVar("T")

# An expression in postfix order: ("number", x), ("reading", index), ("each", 0), ("measure", index into the task's
# measures), ("command", index of an actuator), ("drawn", index of a number that the task draws), ("tally", index of a
# tally of the task), or (operator, 0) with one of OPERATORS or negate. A condition is one that ends in one of TRUTHS: 1
# where it holds, 0 where not, NaN where nobody can know. One of two values is (value, condition, "when", other value,
# "otherwise"): "when" makes NaN of what is not finite and of an unknown condition, and inf, for which "otherwise" takes
# the other value, where the condition does not hold.
Program = tuple[tuple[str, float | int], ...]

Formula = tuple[tuple[str, float | int | str], ...]  # a program in which readings stand by their names
TRUTHS = ("<", "<=", ">", ">=", "and", "or")
CHOICES = ("when", "otherwise")
OPERATORS = frozenset({"+", "-", "*", "/", "least", "greatest", *TRUTHS, *CHOICES})


def fold(
    program: Iterable[tuple[str, Any]],
    leaf: Callable[[str, Any], T],
    negated: Callable[[T], T],
    combined: Callable[[str, T, T], T],
) -> T:
    """Evaluate a program from its leaves up: `leaf` gets a word such as "number" or "reading" and its operand.

    `combined` gets an operator and the results left and right of it. IndexError where the program is not whole.
    """
    stack: list[T] = []
    for word, operand in program:
        if word in OPERATORS:
            right = stack.pop()
            stack.append(combined(word, stack.pop(), right))
        else:
            stack.append(negated(stack.pop()) if word == "negate" else leaf(word, operand))
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
    """True if a program gives 1 or 0: a comparison, or several with `and` and `or`."""
    return is_valid_program(program) and program[-1][0] in TRUTHS


def is_valid_program(program: Iterable[tuple[str, Any]]) -> bool:
    """True if a program never takes from an empty stack and leaves exactly one value."""
    height = 0
    for operator, _ in program:
        takes = 2 if operator in OPERATORS else 1 if operator == "negate" else 0
        if height < takes:
            return False
        height += 1 - takes
    return height == 1


def evaluate(program: Program, readings: Any = ()) -> float:
    """The value in float64 of a program over readings, by their indices; a division by zero gives inf or NaN."""
    stack: list[float] = []
    for word, operand in program:
        if word in OPERATIONS:
            right = stack.pop()
            stack.append(OPERATIONS[word](stack.pop(), right))
        elif word == "negate":
            stack.append(-stack.pop())
        else:
            stack.append(float(readings[int(operand)] if word == "reading" else operand))
    return stack.pop()


def single(value: float) -> float:
    """The float32 that is nearest, inf where it is beyond all of them."""
    return array("f", [value])[0]


def _quotient(left: float, right: float) -> float:
    if right:
        return left / right
    return nan if isnan(left) or not left else copysign(inf, left) * copysign(1.0, right)


def _least(left: float, right: float) -> float:
    return right if right < left or isnan(right) else left


def _greatest(left: float, right: float) -> float:
    return right if right > left or isnan(right) else left


def _when(value: float, holds: float) -> float:
    return inf if holds == 0 else value if holds > 0 and isfinite(value) else nan


def _truth(compare: Callable[[float, float], bool]) -> Callable[[float, float], float]:
    """A comparison as 1, 0 or NaN."""
    return lambda left, right: nan if isnan(left) or isnan(right) else float(compare(left, right))


OPERATIONS: Mapping[str, Callable[[float, float], float]] = {
    "+": add, "-": sub, "*": mul, "/": _quotient,
    "least": _least, "greatest": _greatest, "and": _least, "or": _greatest,
    "<": _truth(lt), "<=": _truth(le), ">": _truth(gt), ">=": _truth(ge),
    "when": _when, "otherwise": lambda value, other: other if value == inf else value,
}  # fmt: skip
