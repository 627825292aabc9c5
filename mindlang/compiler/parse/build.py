"""Lark's tree of one line → the dataclasses of `syntax`."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, cast

from lark import Token, Tree, v_args
from lark.visitors import Transformer_NonRecursive

from mindlang.compiler import syntax
from mindlang.compiler.source import Source, Span
from mindlang.compiler.syntax import Amount, Expression, Name, Operator, Phrase, Term

Terms = list[Term]

_NUMBER = re.compile(r"([+-]?)[ \t]*([0-9./]+)")


def build(tree: Tree[Token], source: Source, offset: int) -> syntax.Line | syntax.Stop:
    """The line that stands at `offset` of `source`."""
    return cast(syntax.Line | syntax.Stop, Builder(source, offset).transform(tree))


@dataclass(frozen=True, slots=True)
class _Like:
    name: Name


@dataclass(frozen=True, slots=True)
class _Inside:
    name: Name


@dataclass(frozen=True, slots=True)
class _Computed:
    phrase: Phrase
    at: Expression


@dataclass(frozen=True, slots=True)
class _Rate:
    unit: str


@v_args(meta=True)
class Builder(Transformer_NonRecursive[Token, Any]):
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
        alias = self._name(parts[1]) if len(parts) > 1 else None
        return syntax.Use(parts[0][1:-1], self._span(parts[0]), alias)

    def master(self, meta: Any, parts: list[Any]) -> syntax.Master:
        return syntax.Master(self._name(parts[0]), self._span(meta))

    def tick(self, meta: Any, parts: list[Any]) -> syntax.Tick:
        return syntax.Tick(parts[0], self._span(meta))

    def mind(self, meta: Any, parts: list[Any]) -> syntax.Version:
        return syntax.Version(parts[0], self._span(meta))

    def unit(self, meta: Any, parts: list[Any]) -> syntax.Unit:
        return syntax.Unit(parts[0], self._span(meta))

    def number(self, meta: Any, parts: list[Any]) -> syntax.Number:
        name, amount = parts
        return syntax.Number(self._name(name), amount, self._span(meta))

    def header(self, meta: Any, parts: list[Any]) -> syntax.Header:
        noun, name, what = parts
        span = self._span(meta)
        match what:
            case _Like():
                return syntax.Header(self._name(noun), self._name(name), None, span, like=what.name)
            case _Inside():
                return syntax.Header(self._name(noun), self._name(name), None, span, inside=what.name)
            case _Computed():
                return syntax.Header(self._name(noun), self._name(name), what.phrase, span, at=what.at)
        return syntax.Header(self._name(noun), self._name(name), what, span)

    def like(self, meta: Any, parts: list[Any]) -> _Like:
        return _Like(self._name(parts[0]))

    def inside(self, meta: Any, parts: list[Any]) -> _Inside:
        return _Inside(self._name(parts[0]))

    def computed(self, meta: Any, parts: list[Any]) -> _Computed:
        kind = self._name(parts[0])
        return _Computed(Phrase(kind, (), kind.span), parts[1])

    def numbered(self, meta: Any, parts: list[Any]) -> Phrase:
        """The numbers go as an argument that is called as its kind; a name before them is that of a part."""
        kind, *rest = self._name(parts[0]), *parts[1:]
        part = self._name(rest.pop(0)) if isinstance(rest[0], Token) else None
        which = tuple(each for each in rest if isinstance(each, Amount))
        span = Span(self.source, which[0].span.start, which[-1].span.end)
        first = [syntax.Argument(kind, syntax.Numbers(which, span), Span(self.source, kind.span.start, span.end))]
        if part:
            first.append(syntax.Argument(Name("part", part.span), part, part.span))
        return Phrase(kind, (*first, *rest[len(which) :]), self._span(meta))

    def outside(self, meta: Any, parts: list[Any]) -> Phrase:
        """The environment goes as an argument that is called as its kind."""
        kind, environment = map(self._name, parts)
        return Phrase(kind, (syntax.Argument(kind, environment, self._span(meta)),), self._span(meta))

    def its(self, meta: Any, parts: list[Any]) -> Phrase:
        """What an environment says has both words for a name."""
        return Phrase(Name(f"{parts[0]} {parts[1]}", self._span(meta)), (), self._span(meta))

    def reads(self, meta: Any, parts: list[Any]) -> syntax.Reads:
        stands_for = self._name(parts[1]) if len(parts) > 1 else None
        return syntax.Reads(self._name(parts[0]), stands_for, self._span(meta))

    def drives(self, meta: Any, parts: list[Any]) -> syntax.Drives:
        return syntax.Drives(
            self._name(parts[0]), _one(parts, Expression), _one(parts, syntax.Gate), self._span(meta)
        )  # fmt: skip

    def influences(self, meta: Any, parts: list[Any]) -> syntax.Influences:
        at, gate, cuts = (_one(parts, form) for form in (Expression, syntax.Gate, Amount))
        return syntax.Influences(self._name(parts[0]), at, gate, cuts, self._span(meta))

    def gate(self, meta: Any, parts: list[Any]) -> syntax.Gate:
        when, otherwise = (*parts, None)[:2]
        return syntax.Gate(when, otherwise, self._span(meta))

    def cuts(self, meta: Any, parts: list[Any]) -> Amount:
        return cast(Amount, parts[-1])

    facing = cuts

    def stays(self, meta: Any, parts: list[Any]) -> syntax.Stays:
        return syntax.Stays(self._name(parts[0]), self._span(meta))

    def contains(self, meta: Any, parts: list[Any]) -> syntax.Contains:
        return syntax.Contains(self._name(parts[0]), parts[1], self._span(meta))

    def starts(self, meta: Any, parts: list[Any]) -> syntax.Starts:
        return syntax.Starts(_one(parts, tuple), _one(parts, Amount), self._span(meta))

    def place(self, meta: Any, parts: list[Any]) -> tuple[Amount, ...]:
        return tuple(parts)

    def varies(self, meta: Any, parts: list[Any]) -> syntax.Varies:
        argument, of, low, high = parts
        return syntax.Varies(self._name(argument), of, low, high, self._span(meta))

    def fails(self, meta: Any, parts: list[Any]) -> syntax.Fails:
        return syntax.Fails(self._name(parts[0]), parts[1], self._span(meta))

    def lasts(self, meta: Any, parts: list[Any]) -> syntax.Lasts:
        return syntax.Lasts(parts[0], self._span(meta))

    def ends(self, meta: Any, parts: list[Any]) -> syntax.Ends:
        times, event, when = (_one(parts, form) for form in (Amount, Phrase, syntax.When))
        return syntax.Ends(times, event, when, self._span(meta))

    def succeeds(self, meta: Any, parts: list[Any]) -> syntax.Succeeds:
        times, event, when = (_one(parts, form) for form in (Amount, Phrase, syntax.When))
        return syntax.Succeeds(times, event, when, self._span(meta))

    def stop(self, meta: Any, parts: list[Any]) -> syntax.Stop:
        """A tick stands in a list, since the times of an event are an amount, too."""
        times, event, when, tick = (_one(parts, form) for form in (Amount, Phrase, syntax.When, list))
        return syntax.Stop(times, event, when, tick[0] if tick else None, self._span(meta))

    def moment(self, meta: Any, parts: list[Any]) -> list[Amount]:
        return parts

    def transmission(self, meta: Any, parts: list[Any]) -> syntax.Transmits:
        skill, to, level, amount = parts
        return syntax.Transmits(self._name(skill), self._name(to), str(level), amount, self._span(meta))

    def rewards(self, meta: Any, parts: list[Any]) -> syntax.Rewards:
        amount, *rest = parts
        if isinstance(amount, Phrase):
            amount = Expression((amount,), amount.span)
        on, each, when = (_one(rest, form) for form in (Phrase, syntax.Each, syntax.When))
        return syntax.Rewards(amount, on, each, when, self._span(meta))

    def counts(self, meta: Any, parts: list[Any]) -> syntax.Counts:
        return syntax.Counts(parts[0], self._span(meta))

    def teaches(self, meta: Any, parts: list[Any]) -> syntax.Teaches:
        skill, task, *rest = parts
        master = rest.pop(0) if isinstance(rest[0], Name) else None
        generations, *more = rest
        arguments = tuple(part for part in more if isinstance(part, syntax.Argument))
        needs = tuple(part for part in more if isinstance(part, syntax.Needs))
        return syntax.Teaches(
            self._name(skill), self._name(task), master, generations, arguments, needs, self._span(meta)
        )

    def needs(self, meta: Any, parts: list[Any]) -> syntax.Needs:
        measure, compare, above = parts
        return syntax.Needs(self._name(measure), str(compare), above, self._span(meta))

    def each(self, meta: Any, parts: list[Any]) -> syntax.Each:
        return syntax.Each(self._name(parts[0]), self._name(parts[1]), self._span(meta))

    def when(self, meta: Any, parts: list[Any]) -> syntax.When:
        return syntax.When(parts[0], self._span(meta))

    def condition(self, meta: Any, parts: list[Any]) -> tuple[Any, ...]:
        return tuple(parts[::2])

    conjunction = condition

    def comparison(self, meta: Any, parts: list[Any]) -> syntax.Comparison:
        left, compare, right = parts
        return syntax.Comparison(left, str(compare), right, self._span(meta))

    def phrase(self, meta: Any, parts: list[Any]) -> Phrase:
        return Phrase(self._name(parts[0]), tuple(parts[1:]), self._span(meta))

    def argument(self, meta: Any, parts: list[Any]) -> syntax.Argument:
        return syntax.Argument(self._name(parts[0]), parts[1], self._span(meta))

    def numbers(self, meta: Any, parts: list[Any]) -> syntax.Numbers:
        return syntax.Numbers(tuple(parts), self._span(meta))

    def stretch(self, meta: Any, parts: list[Any]) -> syntax.Range | syntax.Points:
        """A range where one number stands on each side of `to`, or else places."""
        by = parts.pop() if isinstance(parts[-1], Amount) else None
        sides = [_side(part) for part in parts]
        if len(sides) == 2 and all(len(side.amounts) == 1 for side in sides):
            first, last = (side.amounts[0] for side in sides)
            return syntax.Range(first, last, by, self._span(meta))
        return syntax.Points(tuple(sides), by, self._span(meta))

    def origin(self, meta: Any, parts: list[Any]) -> syntax.Argument:
        key, skill = map(self._name, parts)
        return syntax.Argument(key, skill, self._span(meta))

    def name(self, meta: Any, parts: list[Any]) -> Name:
        return self._name(parts[0])

    def text(self, meta: Any, parts: list[Any]) -> syntax.Text:
        return syntax.Text(str(parts[0])[1:-1], self._span(meta))

    def constant(self, meta: Any, parts: list[Any]) -> Amount:
        return Amount(1.0, "", self._span(meta), name=str(parts[0]))

    def rate(self, meta: Any, parts: list[Any]) -> _Rate:
        return _Rate(str(parts[0]))

    def quantity(self, meta: Any, parts: list[Any]) -> Amount:
        per = parts.pop().unit if isinstance(parts[-1], _Rate) else ""
        unit = str(parts.pop()) if parts[-1].type == "UNIT" else ""
        if parts[-1].type == "NAME":
            return Amount(-1.0 if parts[0] == "-" else 1.0, "", self._span(meta), name=str(parts[-1]))
        return Amount(number("".join(parts)), unit, self._span(meta), per)

    under, word, call, setting, amounts, amount = name, name, phrase, argument, numbers, quantity

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

    def bare(self, meta: Any, parts: list[Any]) -> Phrase:
        name = self._name(parts[0])
        return Phrase(name, (), name.span)

    def extreme(self, meta: Any, parts: list[Any]) -> Terms:
        """The least of several is the least of the first and the second, then of that and the third, and so on."""
        word = Operator(parts[0].split()[0], self._span(parts[0]))
        terms = _terms(parts[1])
        for operand in parts[2:]:
            terms += [*_terms(operand), word]
        return terms


def _one(parts: Sequence[Any], form: type[Any]) -> Any:
    """The part of a form; None where there is none."""
    return next((part for part in parts if isinstance(part, form)), None)


def _side(part: syntax.Numbers | Name) -> syntax.Numbers:
    if isinstance(part, Name):
        return syntax.Numbers((Amount(1.0, "", part.span, name=part.text),), part.span)
    return part


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
