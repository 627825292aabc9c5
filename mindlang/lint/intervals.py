"""Interval arithmetic: the range of an expression's value, and conditions that hold always or never."""

from collections.abc import Callable, Iterator, Sequence
from math import inf
from typing import Any, NamedTuple

from mindrun.numbers.expression import OPERATIONS, OPERATORS, Formula, fold
from mindrun.numbers.intervals import UNIT_INTERVAL, Interval, negated
from mindrun.numbers.intervals import combined as combined_interval

from mindlang.compiler.syntax import Comparison, Expression, When

Readings = Callable[[str], Interval]  # the range of each reading
Range = Callable[[Expression], Interval]  # in which the value of an expression lies

COMPARISON_WORDS = {"<": "below", "<=": "at or below", ">": "above", ">=": "at or above"}
OPPOSITES = {"<": ">=", "<=": ">", ">": "<=", ">=": "<"}
TURNED = {"<": ">", "<=": ">=", ">": "<", ">=": "<="}  # the same with its sides the other way round
UPPER = ("<", "<=")
STRICT = ("<", ">")


def unknown_reading(name: str) -> Interval:
    """The range of a reading of which nothing is known."""
    return UNIT_INTERVAL


def interval(of: Expression | Formula, reading: Readings = unknown_reading, each: Interval = UNIT_INTERVAL) -> Interval:
    """The range of an expression whose readings have these ranges, that of `for each` the range `each`."""
    return _folded(of, reading, each, combined_interval)


def divisors(
    of: Expression | Formula, reading: Readings = unknown_reading, each: Interval = UNIT_INTERVAL
) -> list[Interval]:
    """The ranges of all that an expression divides by."""
    found: list[Interval] = []

    def combined(symbol: str, left: Interval, right: Interval) -> Interval:
        if symbol == "/":
            found.append(right)
        return combined_interval(symbol, left, right)

    _folded(of, reading, each, combined)
    return found


def _folded(
    of: Expression | Formula, reading: Readings, each: Interval, combined: Callable[[str, Interval, Interval], Interval]
) -> Interval:
    def leaf(word: str, operand: Any) -> Interval:
        match word:
            case "number":
                return operand, operand
            case "reading":
                return reading(operand)
            case "measure" | "drawn" | "tally":
                interval: Interval = operand.interval
                return interval
        return each if word == "each" else UNIT_INTERVAL

    formula = of.formula if isinstance(of, Expression) else of
    return fold(formula, leaf, negated, combined)


def is_constant(of: Expression) -> bool:
    """True if an expression is made of numbers alone."""
    return all(word in ("number", "negate", *OPERATORS) for word, _ in of.formula)


def range_in_words(of: Interval) -> str:
    low, high = (bound + 0.0 for bound in of)  # -0.0 is 0
    if low == high:
        return f"always {low:g}"
    if low == -inf:
        return "anything" if high == inf else f"at most {high:g}"
    return f"at least {low:g}" if high == inf else f"{low:g} to {high:g}"


def why_never(when: When, value: Range) -> str | None:
    """Why a condition never holds: what is wrong with the first of its alternatives; None where one may hold."""
    reasons = [_why_never(all_, value) for all_ in when.alternatives]
    return reasons[0] if all(reasons) else None


def why_always(when: When, value: Range) -> str | None:
    """Why a condition holds whatever is read; None where it may not."""
    for all_ in when.alternatives:
        if not any(_can_be(each, OPPOSITES[each.compare], value) for each in all_):
            return _in_words(all_[0], "always", value)
    return None


def _why_never(all_: Sequence[Comparison], value: Range) -> str | None:
    """Why comparisons never hold all at once, in words; None where they may."""
    never = next((each for each in all_ if not _can_be(each, each.compare, value)), None)
    return _in_words(never, "never", value) if never else _contradiction(all_)


def _can_be(each: Comparison, compare: str, value: Range) -> bool:
    """True if the sides of a comparison can be so that `left compare right` holds."""
    (low, high), (least, most) = value(each.left), value(each.right)
    left, right = (low, most) if compare in UPPER else (high, least)
    return OPERATIONS[compare](left, right) == 1


def _in_words(each: Comparison, how_often: str, value: Range) -> str:
    left, right = (range_in_words(value(side)) for side in (each.left, each.right))
    compared = f"{COMPARISON_WORDS[each.compare]} {right.removeprefix('always ')}"
    return f"{each.left.span.text} is {left}, {how_often} {compared}"


class Bound(NamedTuple):
    """`side compare number`."""

    side: Expression
    compare: str
    number: float

    @property
    def subject(self) -> str:
        """The text of its side."""
        return " ".join(self.side.span.text.split())

    @property
    def strictness(self) -> tuple[float, bool]:
        """The order of upper bounds, of which the least is the strictest, and of lower ones: there the greatest."""
        return self.number, (self.compare in STRICT) != (self.compare in UPPER)

    def __str__(self) -> str:
        return f"{COMPARISON_WORDS[self.compare]} {self.number:g}"


def bounds(all_: Sequence[Comparison]) -> Iterator[Bound]:
    """The bounds that comparisons with a number set to their other side."""
    for each in all_:
        if is_constant(each.right):
            yield Bound(each.left, each.compare, interval(each.right)[0])
        elif is_constant(each.left):
            yield Bound(each.right, TURNED[each.compare], interval(each.left)[0])


def _contradiction(all_: Sequence[Comparison]) -> str | None:
    """In words, which reading the comparisons want below a number and above a greater one; None if there is none."""
    found = [*bounds(all_)]
    for subject in dict.fromkeys(bound.subject for bound in found):
        own = [bound for bound in found if bound.subject == subject]
        upper = min((each for each in own if each.compare in UPPER), key=lambda each: each.strictness, default=None)
        lower = max((each for each in own if each.compare not in UPPER), key=lambda each: each.strictness, default=None)
        if upper and lower:
            is_open = lower.compare in STRICT or upper.compare in STRICT
            if lower.number > upper.number or (lower.number == upper.number and is_open):
                return f"{subject} is never {upper} and {lower} at once"
    return None
