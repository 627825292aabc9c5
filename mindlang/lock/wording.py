"""Compiled expressions and arguments as text: numbers in the units of the language, no more brackets than needed."""

from collections.abc import Callable
from typing import Any

from mindrun.graph.graph import Program
from mindrun.kinds.registry import arguments, kinds
from mindrun.numbers.expression import TRUTHS, fold
from mindrun.numbers.quantity import EXPRESSION, UNSAID, Quantity, Reference

PRECEDENCE = {"or": -2, "and": -1, **dict.fromkeys(TRUTHS[:4], 0), "+": 1, "-": 1, "*": 2, "/": 2}
NEGATION_PRECEDENCE, EXTREME_PRECEDENCE, ATOM_PRECEDENCE = 3, 4, 5

UNSAID_VALUES: tuple[Any, ...] = ([], "", None, {"by": None, "first": UNSAID.first, "last": UNSAID.last})

Leaf = Callable[[str, float], str]
Part = tuple[str, int]  # of an expression: its text, and how tightly it binds


def infix(program: Program, leaf: Leaf) -> str:
    """An expression as it is written; `leaf` says a reading or a measure by its word and its index."""

    def part(word: str, operand: float | int) -> Part:
        return number(operand) if word == "number" else leaf(word, operand), ATOM_PRECEDENCE

    def negated(value: Part) -> Part:
        return f"-{_within(value, NEGATION_PRECEDENCE)}", NEGATION_PRECEDENCE

    def combined(operator: str, left: Part, right: Part) -> Part:
        if operator not in PRECEDENCE:
            sides = f"{_within(left, ATOM_PRECEDENCE)} {_within(right, ATOM_PRECEDENCE)}"
            return f"{operator} of {sides}", EXTREME_PRECEDENCE
        here = PRECEDENCE[operator]
        return f"{_within(left, here)} {operator} {_within(right, here + 1)}", here

    return fold(program, part, negated, combined)[0] if program else ""


def _within(part: Part, binding: int) -> str:
    text, own = part
    return text if own >= binding else f"({text})"


def number(value: float) -> str:
    """A number that reads back as the same."""
    short = f"{value:g}"
    return short if float(short) == value else repr(value)


def argument(noun: str, kind: str, field: str, value: Any) -> str:
    """An argument of a kind, as plain data, in words: range 12, at 0 22.5 deg, size 3 to 1 by 0.1; without along."""
    if value in UNSAID_VALUES:
        return f"without {field.removesuffix('_')}"
    meaning = meaning_of(noun, kind, field)
    if meaning == EXPRESSION:
        return f"{field} {infix(tuple((word, x) for word, x in value), lambda _, name: str(name))}"
    if isinstance(value, list) and value and isinstance(value[0], list):
        words = " to ".join(" ".join(_converted(each, meaning) for each in place) for place in value)
    else:
        words = " ".join(_converted(each, meaning) for each in (value if isinstance(value, list) else [value]))
    if not words:
        return f"{field.removesuffix('_')} none"
    unit = next(iter(meaning.units), "") if isinstance(meaning, Quantity) else ""
    return f"{field.removesuffix('_')} {words} {unit}".rstrip()


def meaning_of(noun: str, kind: str, field: str) -> Quantity | Reference | None:
    """What an argument of a kind is; None of what this version does not know."""
    known = {each.field: each for each in arguments(kinds(noun)[kind])} if kind in kinds(noun) else {}
    return known[field].type if field in known else None


def _converted(value: Any, meaning: Quantity | Reference | None) -> str:
    match value:
        case {"first": first, "last": last, "by": by}:
            span = number(first) if first == last and by is None else f"{number(first)} to {number(last)}"
            return span if by is None else f"{span} by {number(by)}"
        case bool() | str() | None:
            return str(value)
    factor = next(iter(meaning.units.values()), 1.0) if isinstance(meaning, Quantity) else 1.0
    return number(value) if factor == 1.0 else f"{value / factor:g}"
