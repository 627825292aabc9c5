"""Lark's tree of one line → the dataclasses of `syntax`."""

import re
from typing import Any, cast

from lark import Token, Tree, v_args
from lark.visitors import Transformer_NonRecursive

from mindlang.compiler import syntax
from mindlang.compiler.source import Source, Span
from mindlang.compiler.syntax import Amount, Expression, Name, Operator, Phrase, Term

Terms = list[Term]

_NUMBER = re.compile(r"([+-]?)[ \t]*([0-9./]+)")


def build(tree: Tree[Token], source: Source, offset: int) -> syntax.Line:
    """The line that stands at `offset` of `source`."""
    return cast(syntax.Line, _Builder(source, offset).transform(tree))


@v_args(meta=True)
class _Builder(Transformer_NonRecursive[Token, Any]):
    """One method per rule of the grammar; each takes the positions of its rule and what its parts became."""

    def __init__(self, source: Source, offset: int) -> None:
        super().__init__()
        self.source = source
        self.offset = offset

    def _span(self, at: Any) -> Span:
        return Span(self.source, self.offset + at.start_pos, self.offset + at.end_pos)

    def _name(self, token: Token) -> Name:
        return Name(str(token), self._span(token))

    def line(self, meta: Any, parts: list[Any]) -> Any:
        return parts[0]

    def use(self, meta: Any, parts: list[Any]) -> syntax.Use:
        return syntax.Use(parts[0][1:-1], self._span(parts[0]))

    def master(self, meta: Any, parts: list[Any]) -> syntax.Master:
        return syntax.Master(self._name(parts[0]), self._span(meta))

    def tick(self, meta: Any, parts: list[Any]) -> syntax.Tick:
        return syntax.Tick(parts[0], self._span(meta))

    def header(self, meta: Any, parts: list[Any]) -> syntax.Header:
        noun, name, phrase = parts
        return syntax.Header(self._name(noun), self._name(name), phrase, self._span(meta))

    def reads(self, meta: Any, parts: list[Any]) -> syntax.Reads:
        return syntax.Reads(self._name(parts[0]), self._span(meta))

    def drives(self, meta: Any, parts: list[Any]) -> syntax.Drives:
        name, at = (*parts, None)[:2]
        return syntax.Drives(self._name(name), at, self._span(meta))

    def influences(self, meta: Any, parts: list[Any]) -> syntax.Influences:
        name, at = (*parts, None)[:2]
        return syntax.Influences(self._name(name), at, self._span(meta))

    def stays(self, meta: Any, parts: list[Any]) -> syntax.Stays:
        return syntax.Stays(self._name(parts[0]), self._span(meta))

    def contains(self, meta: Any, parts: list[Any]) -> syntax.Contains:
        return syntax.Contains(self._name(parts[0]), parts[1], self._span(meta))

    def lasts(self, meta: Any, parts: list[Any]) -> syntax.Lasts:
        return syntax.Lasts(parts[0], self._span(meta))

    def ends(self, meta: Any, parts: list[Any]) -> syntax.Ends:
        return syntax.Ends(parts[0], self._span(meta))

    def rewards(self, meta: Any, parts: list[Any]) -> syntax.Rewards:
        amount, *rest = parts
        on = next((part for part in rest if isinstance(part, Phrase)), None)
        each = next((part for part in rest if isinstance(part, syntax.Each)), None)
        when = next((part for part in rest if isinstance(part, syntax.When)), None)
        return syntax.Rewards(amount, on, each, when, self._span(meta))

    def counts(self, meta: Any, parts: list[Any]) -> syntax.Counts:
        return syntax.Counts(parts[0], self._span(meta))

    def teaches(self, meta: Any, parts: list[Any]) -> syntax.Teaches:
        skill, task, *rest = parts
        master = rest.pop(0) if isinstance(rest[0], Name) else None
        generations, *arguments = rest
        return syntax.Teaches(
            self._name(skill), self._name(task), master, generations, tuple(arguments), self._span(meta)
        )

    def each(self, meta: Any, parts: list[Any]) -> syntax.Each:
        return syntax.Each(self._name(parts[0]), self._name(parts[1]), self._span(meta))

    def when(self, meta: Any, parts: list[Any]) -> syntax.When:
        left, compare, right = parts
        return syntax.When(left, str(compare), right, self._span(meta))

    def phrase(self, meta: Any, parts: list[Any]) -> Phrase:
        return Phrase(self._name(parts[0]), tuple(parts[1:]), self._span(meta))

    def argument(self, meta: Any, parts: list[Any]) -> syntax.Argument:
        return syntax.Argument(self._name(parts[0]), parts[1], self._span(meta))

    def numbers(self, meta: Any, parts: list[Any]) -> syntax.Numbers:
        return syntax.Numbers(tuple(parts), self._span(meta))

    def range(self, meta: Any, parts: list[Any]) -> syntax.Range:
        first, last, by = (*parts, None)[:3]
        return syntax.Range(first, last, by, self._span(meta))

    def name(self, meta: Any, parts: list[Any]) -> Name:
        return self._name(parts[0])

    def quantity(self, meta: Any, parts: list[Any]) -> Amount:
        unit = str(parts.pop()) if parts[-1].type == "UNIT" else ""
        return Amount(number("".join(parts)), unit, self._span(meta))

    under, call, setting, amounts, amount = name, phrase, argument, numbers, quantity

    def expression(self, meta: Any, parts: list[Any]) -> Expression:
        return Expression(tuple(_terms(parts[0])), self._span(meta))

    def chain(self, meta: Any, parts: list[Any]) -> Terms:
        terms = _terms(parts[0])
        for operator, right in zip(parts[1::2], parts[2::2], strict=True):
            terms += [*_terms(right), Operator(str(operator), self._span(operator))]
        return terms

    product = chain

    def negative(self, meta: Any, parts: list[Any]) -> Terms:
        return [*_terms(parts[1]), Operator("negate", self._span(parts[0]))]


def _terms(part: Any) -> Terms:
    return part if isinstance(part, list) else [part]


def number(text: str) -> float:
    """The number at the beginning of an amount, as in `- 1/2 deg`."""
    sign, digits = _NUMBER.findall(text)[0]
    above, _, below = f"{sign}{digits}".partition("/")
    try:
        return float(above) / float(below or 1)
    except ZeroDivisionError:
        return float("nan")
