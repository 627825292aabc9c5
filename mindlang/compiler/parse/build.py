"""Lark's tree of one line → the structs of `syntax`."""

import re
from collections.abc import Mapping
from functools import cache
from typing import Any, cast, get_type_hints

from lark import Token, Tree, v_args
from lark.visitors import Transformer_NonRecursive
from msgspec import Struct
from msgspec.structs import replace

from mindlang.compiler import syntax
from mindlang.compiler.source import Source, Span
from mindlang.compiler.syntax import Amount, Argument, Expression, Name, Numbers, Phrase, Term

Terms = list[Amount | Phrase | Term]
SIGNS = ("+", "-")

_NUMBER = re.compile(r"([+-]?)[ \t]*([0-9./]+)")
# Rules that are not called as the struct that they become. Which field of it a part is, the field's type says.
_FORMS: Mapping[str, type[Struct]] = {
    **{form.__name__.lower(): form for form in vars(syntax).values() if isinstance(form, type(Struct))},
    "mind": syntax.Version, "transmission": syntax.Transmits, "setting": Argument, "origin": Argument,
    "often": syntax.Needs, "until": syntax.Needs, "after": syntax.Deadline,
}  # fmt: skip


@cache
def _fields(form: type[Struct]) -> list[tuple[str, Any]]:
    """The fields of a struct that a rule fills, each with its type: a tuple's without what is in it."""
    hints = get_type_hints(form)
    types = {name: tuple if "tuple" in str(hints[name]) else hints[name] for name in form.__struct_fields__}
    return [(name, Phrase if of is Any else of) for name, of in types.items() if name != "span" and of is not bool]


def build_line(tree: Tree[Token], source: Source, offset: int) -> syntax.Line | syntax.Stop:
    return cast(syntax.Line | syntax.Stop, Builder(source, offset).transform(tree))


@v_args(meta=True)
class Builder(Transformer_NonRecursive[Token, Any]):
    """A method for each rule that is no struct of `syntax` as it stands: of where it is and what its parts became.

    Names have become `Name` before; signs, units and numbers are still tokens.
    """

    def __init__(self, source: Source, offset: int) -> None:
        super().__init__()
        self.source = source
        self.offset = offset

    def __default__(self, data: str, children: list[Any], meta: Any) -> Any:
        """A rule that is a struct: each of its fields is the first part of its type that is left, if any is."""
        form, found = _FORMS[data], dict[str, Any]()
        for field, of in _fields(form):
            place = next((place for place, part in enumerate(children) if isinstance(part, of)), None)
            found[field] = None if place is None else children.pop(place)
        return form(**found, span=self._span(meta))

    def _span(self, at: Any) -> Span:
        return Span(self.source, self.offset + at.start_pos, self.offset + at.end_pos)

    def NAME(self, token: Token) -> Name:  # noqa: N802 (Lark calls it as the terminal)
        """A word."""
        return Name(str(token), self._span(token))

    TITLE = LETTER = PART = WHOLE = TASK = COMPUTED = NUMBERED = SEVERAL = ORDERED = BROKEN = NAME
    GYMNASIUM = ENVIRONMENT = FROM = TO = BY = ON = OF = FACING = AT = ALONG = WITHIN = NAME
    COUNT = LONGEST = SUM = FINAL = SOON = HOW = NAME

    def COMPARE(self, token: Token) -> str:  # noqa: N802
        """A sign between two values."""
        return str(token)

    LEVEL = COMPARE

    def line(self, meta: Any, parts: list[Any]) -> Any:
        line, *families = parts
        return syntax.Repeated(line, families[0], self._span(meta)) if families else line

    def name(self, meta: Any, parts: list[Any]) -> Any:
        return parts[-1]

    under = word = cuts = facing = name

    def use(self, meta: Any, parts: list[Any]) -> syntax.Use:
        path, alias = (*parts, None)[:2]
        return syntax.Use(path[1:-1], self._span(path), alias)

    def header(self, meta: Any, parts: list[Any]) -> syntax.Header:
        noun, name, what = parts
        fields = what if isinstance(what, dict) else {"phrase": what}
        return syntax.Header(noun, name, **{"phrase": None, **fields}, span=self._span(meta))

    def like(self, meta: Any, parts: list[Any]) -> dict[str, Any]:
        return {"like": parts[0]}

    def inside(self, meta: Any, parts: list[Any]) -> dict[str, Any]:
        return {"inside": parts[0]}

    def computed(self, meta: Any, parts: list[Any]) -> dict[str, Any]:
        kind, at, gate = (*parts, None)[:3]
        return {"phrase": Phrase(kind, (), kind.span), "at": at, "gate": gate}

    def numbered(self, meta: Any, parts: list[Any]) -> Phrase:
        """The numbers go as an argument that is called as its kind; a name before them is that of a part.

        A letter with no number behind it is that of a family.
        """
        kind, *rest = parts
        part = [rest.pop(0)] if isinstance(rest[0], Name) else []
        if part and not (rest and isinstance(rest[0], Amount)):
            letter = part.pop()
            rest.insert(0, Amount(1.0, "", letter.span, name=letter.text))
        which = tuple(each for each in rest if isinstance(each, Amount))
        span = Span(self.source, which[0].span.start, which[-1].span.end)
        first = Argument(kind, Numbers(which, span), Span(self.source, kind.span.start, span.end))
        named = [Argument(Name("part", name.span), name, name.span) for name in part]
        return Phrase(kind, (first, *named, *rest[len(which) :]), self._span(meta))

    def ordered(self, meta: Any, parts: list[Any]) -> Phrase:
        """The ends of its range go as an argument that is called as its kind."""
        kind, ends, *rest = parts
        first = Argument(kind, ends, Span(self.source, kind.span.start, ends.span.end))
        return Phrase(kind, (first, *rest), self._span(meta))

    def last(self, meta: Any, parts: list[Any]) -> Argument:
        span = self._span(meta)
        key = Name("to", Span(span.source, span.start, span.start + 2))
        return Argument(key, Numbers((parts[0],), parts[0].span), span)

    def outside(self, meta: Any, parts: list[Any]) -> Phrase:
        """The environment, or the skill, goes as an argument that is called as its kind."""
        kind, name = parts
        return Phrase(kind, (Argument(kind, name, self._span(meta)),), self._span(meta))

    broken = outside

    def its(self, meta: Any, parts: list[Any]) -> Phrase:
        """A phrase of the environment's own (its reward): both words are the name of its kind."""
        return Phrase(Name(f"{parts[0]} {parts[1].text}", self._span(meta)), (), self._span(meta))

    def place(self, meta: Any, parts: list[Any]) -> tuple[Amount, ...]:
        return tuple(parts)

    def contains(self, meta: Any, parts: list[Any]) -> syntax.Contains:
        name, phrase, *rest = parts
        master = rest.pop(0) if rest and isinstance(rest[0], Name) else None
        return syntax.Contains(name, phrase, (*rest, None)[0], self._span(meta), master)

    def teaches(self, meta: Any, parts: list[Any]) -> syntax.Teaches:
        skill, task, *rest = parts
        master = rest.pop(0) if isinstance(rest[0], Name) else None
        until = rest.pop(0) if isinstance(rest[0], syntax.Needs) else None
        generations, *more = rest
        arguments = tuple(part for part in more if isinstance(part, Argument))
        needs = tuple(part for part in more if isinstance(part, syntax.Needs))
        return syntax.Teaches(skill, task, master, generations, arguments, needs, self._span(meta), until)

    def condition(self, meta: Any, parts: list[Any]) -> tuple[Any, ...]:
        return tuple(parts[::2])

    conjunction = over = condition

    def phrase(self, meta: Any, parts: list[Any]) -> Phrase:
        """Names with `or` between become the value of one argument."""
        found: list[Argument] = []
        for part in parts[1:]:
            before, options = found[-1].value if found else None, getattr(part.value, "options", ())
            others = syntax.of_form(options, Name)
            if isinstance(before, Name) and others and len(others) == len(options):
                named, whole = (Span(self.source, of.span.start, part.span.end) for of in (before, found[-1]))
                found[-1] = replace(found[-1], value=syntax.AnyName((before, *others), named), span=whole)
            else:
                found.append(part)
        return Phrase(parts[0], tuple(found), self._span(meta))

    def call(self, meta: Any, parts: list[Any]) -> Phrase:
        return Phrase(parts[0], tuple(parts[1:]), self._span(meta))

    def event(self, meta: Any, parts: list[Any]) -> Phrase:
        phrase, within = (*parts, None)[:2]
        return Phrase(phrase.kind, phrase.arguments, self._span(meta), within)

    def then(self, meta: Any, parts: list[Any]) -> syntax.Wants | syntax.Keeps:
        goal: syntax.Wants | syntax.Keeps = replace(parts[0], then=True, span=self._span(meta))
        return goal

    def wants(self, meta: Any, parts: list[Any]) -> syntax.Wants:
        times = parts.pop(0) if isinstance(parts[0], Amount) else None
        deadline = parts.pop() if isinstance(parts[-1], syntax.Deadline) else None
        event, within = (*parts, None)[:2]
        span = Span(self.source, event.span.start, (within or event).span.end)
        return syntax.Wants(times, Phrase(event.kind, event.arguments, span, within), deadline, self._span(meta))

    def numbers(self, meta: Any, parts: list[Any]) -> Numbers | syntax.Sums:
        """Amounts, or where anything is computed sums: where only numbers stand a sign never adds, as `10 - 20`."""
        amounts = [each for part in parts for each in ([part] if isinstance(part, Amount) else _listed(part))]
        if all(isinstance(each, Amount) for each in amounts):
            return Numbers(tuple(amounts), self._span(meta))
        sums = (part if isinstance(part, Expression) else as_expression(part) for part in parts)
        return syntax.Sums(tuple(sums), self._span(meta))

    amounts = from_name = numbers

    def total(self, meta: Any, parts: list[Any]) -> Expression:
        return Expression(tuple(term for each in _terms(parts[0]) for term in named_terms(each)), self._span(meta))

    led = total

    def nested(self, meta: Any, parts: list[Any]) -> Terms:
        return _terms(parts[0])

    def stretch(self, meta: Any, parts: list[Any]) -> syntax.Range | syntax.Points:
        """A range where one number stands on each side of `to`, or else places."""
        by = parts.pop() if isinstance(parts[-1], Amount) else None
        sides = [_side(part) for part in parts]
        ends = [side.amounts[0] for side in sides if isinstance(side, Numbers) and len(side.amounts) == 1]
        if len(sides) == len(ends) == 2:
            return syntax.Range(ends[0], ends[1], by, self._span(meta))
        return syntax.Points(tuple(sides), by, self._span(meta))

    def instead(self, meta: Any, parts: list[Any]) -> Argument:
        """The alternatives go as one argument, which is called as the word before each."""
        key, span = parts[0], self._span(meta)
        return Argument(Name(str(key), self._span(key)), syntax.Either(tuple(parts[1::2]), span), span)

    def text(self, meta: Any, parts: list[Any]) -> syntax.Text:
        return syntax.Text(str(parts[0])[1:-1], self._span(meta))

    def constant(self, meta: Any, parts: list[Any]) -> Amount:
        return Amount(1.0, "", self._span(meta), name=parts[0].text)

    def rate(self, meta: Any, parts: list[Any]) -> Token:
        return Token("RATE", str(parts[0]))

    def quantity(self, meta: Any, parts: list[Any]) -> Amount:
        if isinstance(parts[-1], Name):
            return Amount(-1.0 if parts[0] == "-" else 1.0, "", self._span(meta), name=parts[-1].text)
        said = {part.type: str(part) for part in parts}
        value = parse_number(said.get("SIGN", "") + said["NUMBER"])
        return Amount(value, said.get("UNIT", ""), self._span(meta), said.get("RATE", ""))

    amount = figure = quantity

    def expression(self, meta: Any, parts: list[Any]) -> Expression:
        return Expression(tuple(_terms(parts[0])), self._span(meta))

    def chain(self, meta: Any, parts: list[Any]) -> Terms:
        terms = _terms(parts[0])
        for operator, right in zip(parts[1::2], parts[2::2], strict=True):
            terms += [*_terms(right), Term(str(operator), 0, self._span(operator))]
        return terms

    product = chain

    def negative(self, meta: Any, parts: list[Any]) -> Terms:
        return [*_terms(parts[1]), Term("negate", 0, self._span(parts[0]))]

    def bare(self, meta: Any, parts: list[Any]) -> Phrase:
        return Phrase(parts[0], (), parts[0].span)

    variable = bare

    def extreme(self, meta: Any, parts: list[Any]) -> Terms:
        """The least of several is the least of the first and the second, then of that and the third, and so on."""
        word = Term(parts[0].split()[0], 0, self._span(parts[0]))
        terms = _terms(parts[1])
        for operand in parts[2:]:
            terms += [*_terms(operand), word]
        return terms


def named_terms(term: Amount | Phrase | Term) -> tuple[Amount | Phrase | Term, ...]:
    """A term of an expression; a name with a sign, as where numbers stand, becomes two."""
    if not isinstance(term, Amount) or not term.name:
        return (term,)
    sign = (Term("negate", 0, term.span),) if term.number < 0 else ()
    return (Phrase(term.constant, (), term.constant.span), *sign)


def as_expression(amount: Amount) -> Expression:
    """The expression of a number, or of a name that stands where numbers do."""
    return Expression(named_terms(amount), amount.span)


def _listed(total: Expression) -> list[Any]:
    """The numbers of a sum of numbers alone, each with the sign before it; itself where it is anything else."""
    numbers, signs = syntax.of_form(total.terms, Amount), syntax.of_form(total.terms, Term)
    is_list = len(numbers) + len(signs) == len(total.terms) and all(each.word in SIGNS for each in signs)
    if not is_list or "(" in total.span.text:
        return [total]
    first, *others = numbers
    spans = [Span(total.span.source, sign.span.start, of.span.end) for sign, of in zip(signs, others, strict=True)]
    return [first, *(replace(of, number=parse_number(at.text), span=at) for of, at in zip(others, spans, strict=True))]


def _side(part: Numbers | Name | syntax.Sums) -> Numbers | syntax.Sums:
    if isinstance(part, Name):
        return Numbers((Amount(1.0, "", part.span, name=part.text),), part.span)
    return part


def _terms(part: Any) -> Terms:
    return part if isinstance(part, list) else [part]


def parse_number(text: str) -> float:
    """The number at the beginning of an amount, as in `- 1/2 deg`."""
    sign, digits = _NUMBER.findall(text)[0]
    above, _, below = f"{sign}{digits}".partition("/")
    try:
        return float(above) / float(below or 1)
    except ZeroDivisionError:
        return float("nan")
