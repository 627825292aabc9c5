"""Terms of formulas: what Python would make of each, written anew for numba. Whatever is more is refused."""

import ast
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from typing import Any, NoReturn

EXACT_INTEGERS = 2**53  # whole numbers up to here are floats
MAX_POWER = 64
OPERATORS: Mapping[type[ast.operator], str] = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*"}
COMPARISONS: Mapping[type[ast.cmpop], str] = {
    ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!=",
}  # fmt: skip


class NoFormulaError(Exception):
    """A procedure is more than arithmetic with floats; the text says where."""


class Kind(Enum):
    """What Python makes of a term: a float, a whole number or a float, a truth."""

    FLOAT, NUMBER, TRUTH = range(3)


@dataclass(frozen=True, slots=True)
class Term:
    """A term of the new text. Where it is a whole number, it is at most `size` from 0; `whole` is which, if known."""

    text: str
    kind: Kind
    size: int = 1
    whole: int | None = None

    @property
    def number(self) -> str:
        """The term as a float."""
        return f"(1.0 if {self.text} else 0.0)" if self.kind is Kind.TRUTH else self.text

    @property
    def truth(self) -> str:
        """The term as a truth."""
        return self.text if self.kind is Kind.TRUTH else f"({self.text} != 0.0)"


def named(name: str) -> str:
    """The name of a variable in the new text."""
    return f"v_{name}"


def refuse(node: ast.AST) -> NoReturn:
    """NoFormulaError, which says what is more than arithmetic."""
    text = ast.unparse(node).split("\n")[0]
    said = text if len(text) <= 40 else f"{text[:39]}…"
    raise NoFormulaError(f"`{said}` in line {getattr(node, 'lineno', '?')} is more than arithmetic with floats")


def constant(value: Any, node: ast.expr) -> Term:
    """A number or a truth that is known."""
    match value:
        case bool():
            return Term(str(value), Kind.TRUTH)
        case int() if abs(value) <= EXACT_INTEGERS:
            return Term(f"({float(value)!r})", Kind.NUMBER, abs(value), value)
        case float():
            return Term({"inf": "INF", "-inf": "(-INF)", "nan": "NAN"}.get(repr(value), f"({value!r})"), Kind.FLOAT)
    return refuse(node)


def number_of(term: Term) -> Term:
    """A term that is calculated with: a truth is 1 or 0."""
    return Term(term.number, Kind.NUMBER) if term.kind is Kind.TRUTH else term


def unary(op: ast.unaryop, term: Term, node: ast.expr) -> Term:
    """A sign, or not."""
    match op:
        case ast.Not():
            return Term(f"(not {term.truth})", Kind.TRUTH)
        case ast.USub() | ast.UAdd():
            sign, number = "-" if isinstance(op, ast.USub) else "+", number_of(term)
            whole = None if term.whole is None else -term.whole if sign == "-" else term.whole
            return replace(number, text=f"({sign}{number.text})", whole=whole)
    return refuse(node)


def binary(op: ast.operator, left: Term, right: Term, node: ast.expr) -> Term:
    """An operation on two numbers; whole ones must stay exact."""
    a, b = number_of(left), number_of(right)
    if isinstance(op, ast.Pow):
        if b.whole is None or abs(b.whole) > MAX_POWER:
            refuse(node)
        text, size = f"power(wrong, {a.text}, {b.text})", a.size ** abs(b.whole)
        if a.kind is Kind.FLOAT or b.whole < 0:
            return Term(text, Kind.FLOAT)
        return Term(text, Kind.NUMBER, size) if size <= EXACT_INTEGERS else refuse(node)
    if isinstance(op, ast.Div):
        return Term(f"divide(wrong, {a.text}, {b.text})", Kind.FLOAT)
    if isinstance(op, ast.Mod):
        text, size = f"modulo(wrong, {a.text}, {b.text})", b.size
    elif type(op) in OPERATORS:
        text = f"({a.text} {OPERATORS[type(op)]} {b.text})"
        size = a.size * b.size if isinstance(op, ast.Mult) else a.size + b.size
    else:
        refuse(node)
    if Kind.FLOAT in (a.kind, b.kind):
        return Term(text, Kind.FLOAT)
    return Term(text, Kind.NUMBER, size) if size <= EXACT_INTEGERS else refuse(node)


def has_truth(*terms: Term) -> bool:
    """Whether one of the terms is a truth."""
    return any(term.kind is Kind.TRUTH for term in terms)


def are_truths(terms: Sequence[Term]) -> bool:
    """Whether all terms are truths."""
    return all(term.kind is Kind.TRUTH for term in terms)


def either(text: str, *terms: Term) -> Term:
    """One of several terms, whichever it is."""
    kinds = {term.kind for term in terms}
    return Term(text, kinds.pop() if len(kinds) == 1 else Kind.NUMBER, max(term.size for term in terms))
