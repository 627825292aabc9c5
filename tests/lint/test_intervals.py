"""Ranges of expressions: those of all that their readings may be, tried one by one; and how a range is said."""

from collections.abc import Callable, Iterator
from itertools import product
from math import inf

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.numbers.intervals import UNBOUNDED, UNIT_INTERVAL, Interval

from mindlang.compiler.source import Source, Span
from mindlang.compiler.syntax import Expression, Term
from mindlang.lint.intervals import (
    divisors,
    interval,
    is_constant,
    range_in_words,
)

HERE = Span(Source("x", ""), 0, 0)
COMPUTED: dict[str, Callable[[float, float], float]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
    "least": min,
    "greatest": max,
}
RANGES = st.tuples(st.integers(-4, 4), st.integers(-4, 4)).map(lambda ends: (min(ends), max(ends)))
READ = {"a": (-inf, 2.0), "b": (3.0, inf), "c": (0.0, inf), "all": UNBOUNDED, "none": (0.0, 0.0), "half": (0.5, 0.5)}


def expression(*words: str | float) -> Expression:
    """Terms in postfix order: numbers, operators, readings."""
    return Expression(tuple(terms(*words)), HERE)


def terms(*words: str | float) -> Iterator[Term]:
    for word in words:
        if isinstance(word, str):
            yield Term(word, 0, HERE) if word in (*COMPUTED, "negate") else Term("reading", word, HERE)
        else:
            yield Term("number", word, HERE)


@given(RANGES, RANGES, st.sampled_from([*COMPUTED]), st.booleans())
def test_it_is_the_range_of_all_that_may_be_read(a: Interval, b: Interval, symbol: str, is_negated: bool) -> None:
    of = expression("a", "b", symbol, *["negate"] * is_negated)
    found = interval(of, {"a": a, "b": b}.__getitem__)
    if symbol == "/" and b[0] <= 0 <= b[1]:
        assert found == UNBOUNDED
        return
    each = (range(int(low), int(high) + 1) for low, high in (a, b))
    values = [COMPUTED[symbol](*both) * (-1 if is_negated else 1) for both in product(*each)]
    assert found == (min(values), max(values))


@pytest.mark.parametrize(
    ("words", "found"),
    [
        (("a", "b", "+"), UNBOUNDED),
        (("a", "b", "-"), (-inf, -1)),
        (("b", "a", "-"), (1, inf)),
        (("none", "all", "*"), (0, 0)),
        (("all", "none", "*"), (0, 0)),
        (("c", "a", "*"), UNBOUNDED),
        (("c", "b", "*"), (0, inf)),
        (("all", "all", "-"), UNBOUNDED),
        (("half", "b", "/"), (0, 1 / 6)),
        (("b", "b", "/"), UNBOUNDED),  # ∞ / ∞
        (("a", "b", "least"), (-inf, 2)),
        (("a", "b", "greatest"), (3, inf)),
        (("half", 2, "*", 1, "-"), (0, 0)),
    ],
)
def test_of_what_has_no_end_as_much_is_known_as_can_be(words: tuple[str, ...], found: Interval) -> None:
    assert interval(expression(*words), READ.__getitem__) == found


def test_commands_and_readings_are_shares_where_nothing_is_known() -> None:
    for term in (Term("reading", "x", HERE), Term("command", "x", HERE), Term("each", 0, HERE)):
        assert interval(Expression((term,), HERE)) == UNIT_INTERVAL
    of = Expression((Term("reading", "x", HERE), Term("each", 0, HERE), Term("+", 0, HERE)), HERE)
    assert interval(of, each=(2, 3)) == (2, 4)


def test_all_that_is_divided_by_is_told() -> None:
    of = expression(1, "half", 2, "/", "/", "c", 3, "+", "/")
    assert divisors(of, READ.__getitem__) == [(2, 2), (0.25, 0.25), (3, inf)]
    assert divisors(expression("a", "b", "*")) == []
    of = Expression((Term("number", 1, HERE), Term("each", 0, HERE), Term("/", 0, HERE)), HERE)
    assert divisors(of, each=(1, 4)) == [(1, 4)]
    formula = (("reading", "b"), ("number", 4.0), ("/", 0), ("reading", "a"), ("/", 0))
    assert divisors(formula, READ.__getitem__) == [(4, 4), (-inf, 2)]
    assert divisors(formula) == [(4, 4), UNIT_INTERVAL]


def test_what_is_made_of_numbers_is_constant() -> None:
    assert is_constant(expression(1, 2, "+", "negate"))
    assert not is_constant(expression(1, "a", "+"))


@pytest.mark.parametrize(
    ("of", "said"),
    [
        ((0.5, 0.5), "always 0.5"), ((-0.0, 0.0), "always 0"), ((0.0, 1.0), "0 to 1"), ((-inf, 2.0), "at most 2"),
        ((3.0, inf), "at least 3"), (UNBOUNDED, "anything"), ((-1.0, -0.0), "-1 to 0"),
    ],
)  # fmt: skip
def test_a_range_is_said_in_words(of: Interval, said: str) -> None:
    assert range_in_words(of) == said
