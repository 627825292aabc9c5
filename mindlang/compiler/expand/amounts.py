"""Names of numbers replaced by what they stand for, and rates told how long a tick is."""

import re
from collections.abc import Callable, Iterable, Mapping, Set
from dataclasses import dataclass
from typing import Any

from mindrun.kinds.registry import arguments, find_kind, kinds
from mindrun.numbers.quantity import Quantity
from msgspec import Struct
from msgspec.structs import astuple, replace

from mindlang.compiler.expand.numbers import instead
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import (
    Amount,
    Argument,
    Contains,
    Counts,
    Declaration,
    Ends,
    Expression,
    Header,
    Name,
    Numbers,
    Phrase,
    Rewards,
    Stop,
    Succeeds,
    Teaches,
    Term,
)

LEARNER = "curriculum"
# Of which noun the kind is that a phrase names, by what the phrase stands in.
NOUNS: Mapping[type, str] = {
    Contains: "content", Ends: "event", Succeeds: "event", Counts: "event", Stop: "event", Rewards: "event",
    Expression: "measure", Teaches: LEARNER,
}  # fmt: skip
_WORD = re.compile(r"[a-z]\w*")


def written_out(declaration: Declaration, numbers: Mapping[str, Amount], tick_seconds: float) -> Declaration:
    """A declaration with its numbers; itself where it has none that has to be replaced."""
    line = writer(numbers, tick_seconds)
    header = line(declaration.header)
    facts = tuple(line(fact) for fact in declaration.facts)
    if header is declaration.header and all(new is old for new, old in zip(facts, declaration.facts, strict=True)):
        return declaration
    return replace(declaration, header=header, facts=facts)


def writer(numbers: Mapping[str, Amount], tick_seconds: float) -> Callable[[Any], Any]:
    """What writes the numbers into a line, in the place of their names."""
    return _Writer(numbers, tick_seconds, frozenset(name.rpartition(".")[2] for name in numbers)).line


def in_place(amount: Amount, numbers: Mapping[str, Amount]) -> Amount:
    """What an amount stands for; itself where it is no name of a number that has one."""
    return instead(amount, numbers[amount.name]) if amount.name in numbers else amount


@dataclass(frozen=True, slots=True)
class _Writer:
    """`words` are the last ones of the names: all that stands of them in a file that has an alias."""

    numbers: Mapping[str, Amount]
    tick_seconds: float
    words: Set[str]

    def line(self, line: Any) -> Any:
        """A line with its numbers; most have none, which their text says at once."""
        text = line.span.text
        has_names = self.words and not self.words.isdisjoint(_WORD.findall(text))
        if not has_names and "per" not in text:
            return line
        if isinstance(line, Rewards) and line.each and line.each.name.text in self.numbers:
            own = line.each.name.text  # as it would hide a reading
            others = {name: amount for name, amount in self.numbers.items() if name != own}
            return _Writer(others, self.tick_seconds, self.words).node(line, "")
        return self.node(line, "")

    def node(self, node: Any, noun: str) -> Any:
        """A part of a line; `noun` is that of the kinds which its phrases name."""
        match node:
            case Name() | Span() | None:
                return node
            case Amount():
                amount = in_place(node, self.numbers)
                return replace(amount, tick_seconds=self.tick_seconds) if amount.per == "s" else amount
            case Expression(terms, span):
                return Expression(tuple(self._term(term) for term in terms), span)
            case Phrase(kind, written, span):
                cls = find_kind(noun, kind.text) if written else None
                classes = [cls] if cls else []
                return Phrase(kind, tuple(self._argument(each, classes) for each in written), span)
            case Argument():
                return self._argument(node, kinds(noun).values())
            case tuple():
                return tuple(self.node(part, noun) for part in node)
            case Struct():
                of = node.noun.text if isinstance(node, Header) else NOUNS.get(type(node), noun)
                return type(node)(*[self.node(part, of) for part in astuple(node)])
        return node

    def _term(self, term: Term) -> Term:
        """A name alone in an expression is that of a number where there is one: no reading has it, too."""
        match term:
            case Phrase(kind, ()) if kind.text in self.numbers:
                return self._named(kind)
        term_: Term = self.node(term, "measure")
        return term_

    def _argument(self, argument: Argument, classes: Iterable[type[Any]]) -> Argument:
        match argument.value:
            case Name() as name if name.text in self.numbers and _takes_number(classes, argument.key.text):
                return replace(argument, value=Numbers((self._named(name),), name.span))
        return replace(argument, value=self.node(argument.value, ""))

    def _named(self, name: Name) -> Amount:
        amount: Amount = self.node(Amount(1.0, "", name.span, name=name.text), "")
        return amount


def _takes_number(classes: Iterable[type[Any]], key: str) -> bool:
    """Whether a number stands after a key; the argument of a kind that there is not takes anything."""
    meanings = [each.type for cls in classes for each in arguments(cls) if each.key == key]
    return all(isinstance(meaning, Quantity) for meaning in meanings)
