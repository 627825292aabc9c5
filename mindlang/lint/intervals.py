"""The range in which the value of an expression must lie, by interval arithmetic."""

from collections.abc import Callable, Iterable, Iterator
from itertools import product
from math import inf, isnan
from typing import Any

from mindrun.numbers.expression import Formula, fold

from mindlang.compiler.model import Command, Expression, Measured, Number, Reading, Term
from mindlang.compiler.syntax import Operator

Interval = tuple[float, float]
UNBOUNDED: Interval = (-inf, inf)
UNIT_INTERVAL: Interval = (0.0, 1.0)


def share(name: str) -> Interval:
    """The range of a reading of which nothing is known."""
    return UNIT_INTERVAL


def interval(of: Expression, reading: Callable[[str], Interval] = share, each: Interval = UNIT_INTERVAL) -> Interval:
    """The range of an expression whose readings have these ranges, that of `for each` the range `each`."""
    return fold(words(of), _leaf(reading, each), _negated, _combined)


def divisors(
    of: Expression, reading: Callable[[str], Interval] = share, each: Interval = UNIT_INTERVAL
) -> list[Interval]:
    """The ranges of all that an expression divides by."""
    return _divisors(words(of), _leaf(reading, each))


def formula_divisors(of: Formula, reading: Callable[[str], Interval] = share) -> list[Interval]:
    """The ranges of all that the formula of a sensor divides by."""
    return _divisors(of, lambda word, term: (term, term) if word == "number" else reading(term))


def formula_interval(of: Formula, reading: Callable[[str], Interval] = share) -> Interval:
    """The range of the formula of a sensor."""
    return fold(of, lambda word, term: (term, term) if word == "number" else reading(term), _negated, _combined)


def _divisors(words: Iterable[tuple[str, Any]], leaf: Callable[[str, Any], Interval]) -> list[Interval]:
    found: list[Interval] = []

    def combined(symbol: str, left: Interval, right: Interval) -> Interval:
        if symbol == "/":
            found.append(right)
        return _combined(symbol, left, right)

    fold(words, leaf, _negated, combined)
    return found


def words(of: Expression) -> Iterator[tuple[str, Term]]:
    """The terms of an expression, each with the word by which `fold` knows it."""
    return ((term.symbol if isinstance(term, Operator) else "term", term) for term in of.terms)


def _leaf(reading: Callable[[str], Interval], each: Interval) -> Callable[[str, Term], Interval]:
    def leaf(_: str, term: Term) -> Interval:
        match term:
            case Number(value):
                return value, value
            case Reading(name):
                return reading(name)
            case Measured(measure):
                return measure.interval
            case Command():
                return UNIT_INTERVAL
        return each

    return leaf


def _negated(of: Interval) -> Interval:
    return -of[1], -of[0]


def is_constant(of: Expression) -> bool:
    """Whether an expression is made of numbers alone."""
    return all(isinstance(term, Number | Operator) for term in of.terms)


def range_in_words(of: Interval) -> str:
    """A range in words."""
    low, high = (bound + 0.0 for bound in of)  # -0.0 is 0
    if low == high:
        return f"always {low:g}"
    if low == -inf:
        return "anything" if high == inf else f"at most {high:g}"
    return f"at least {low:g}" if high == inf else f"{low:g} to {high:g}"


def _combined(symbol: str, left: Interval, right: Interval) -> Interval:
    match symbol:
        case "+":
            return _around([left[0] + right[0]], [left[1] + right[1]])
        case "-":
            return _around([left[0] - right[1]], [left[1] - right[0]])
        case "least":
            return min(left[0], right[0]), min(left[1], right[1])
        case "greatest":
            return max(left[0], right[0]), max(left[1], right[1])
        case "*":
            values = [a * b if a and b else 0.0 for a, b in product(left, right)]
            return _around(values, values)
    if right[0] <= 0 <= right[1]:
        return UNBOUNDED
    values = [a / b for a, b in product(left, right)]
    return _around(values, values)


def _around(lows: list[float], highs: list[float]) -> Interval:
    if any(map(isnan, [*lows, *highs])):
        return UNBOUNDED
    return min(lows), max(highs)
