"""Every name in the files of a mind, with what it names: where a rename writes, and what a removal would break."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from mindrun.quantity import Reference as Noun
from mindrun.registry import arguments, kinds

from mindlang.compiler.names import Names
from mindlang.compiler.syntax import (
    Argument,
    Contains,
    Counts,
    Declaration,
    Drives,
    Ends,
    Expression,
    Fact,
    File,
    Influences,
    Master,
    Name,
    Phrase,
    Reads,
    Rewards,
    Succeeds,
    Teaches,
)

READABLE_NOUNS = ("sensor", "memory")
DRIVABLE_NOUNS = ("actuator", "memory")


@dataclass(frozen=True, slots=True)
class Mention:
    """A name where it stands; `by` is the declaration in which that is, its own one perhaps."""

    noun: str
    name: Name
    by: Declaration | None

    @property
    def is_own(self) -> bool:
        """Whether this is where the name is declared."""
        return self.by is not None and self.name is self.by.header.name


@dataclass(frozen=True, slots=True)
class _Reader:
    """What a name means depends on which names there are: a memory is read like a sensor, a sensor hides a measure."""

    names: Names
    by: Declaration | None

    def first_declared(self, name: Name, *nouns: str) -> Iterator[Mention]:
        """A name with the first of the nouns that it is declared with."""
        if noun := self.names.noun_of(name.text, nouns):
            yield Mention(noun, name, self.by)

    def fact(self, fact: Fact) -> Iterator[Mention]:
        """The names in a fact."""
        match fact:
            case Reads(name, stands_for):
                yield from self.first_declared(name, *READABLE_NOUNS)
                if stands_for:
                    yield from self.first_declared(stands_for, *READABLE_NOUNS)
            case Drives(name, at, gate):
                yield from self.first_declared(name, *DRIVABLE_NOUNS)
                yield from self.expressions("", at, *(gate.expressions if gate else ()))
            case Influences(name, at, gate):
                yield from self.first_declared(name, "skill")
                yield from self.expressions("", at, *(gate.expressions if gate else ()))
            case Contains(name, phrase):
                yield Mention("thing", name, self.by)
                yield from self.phrase("content", phrase)
            case Ends(_, event, when) | Succeeds(_, event, when):
                yield from self.phrase("event", event)
                yield from self.expressions("", *(when.expressions if when else ()))
            case Counts(event):
                yield from self.phrase("event", event)
            case Rewards():
                yield from self.reward(fact)
            case Teaches():
                yield from self.lesson(fact)

    def reward(self, fact: Rewards) -> Iterator[Mention]:
        """The names in a reward; that of `for each` is its own."""
        own = fact.each.name.text if fact.each else ""
        yield from self.expressions(own, fact.amount, *(fact.when.expressions if fact.when else ()))
        if fact.on:
            yield from self.phrase("event", fact.on)
        if fact.each:
            yield from self.first_declared(fact.each.sensor, *READABLE_NOUNS)

    def lesson(self, fact: Teaches) -> Iterator[Mention]:
        """The names in a lesson."""
        yield from self.first_declared(fact.skill, "skill")
        yield from self.first_declared(fact.task, "task")
        if fact.master:
            yield from self.first_declared(fact.master, "skill")
        for argument in fact.arguments:
            if argument.key.text == "from" and isinstance(argument.value, Name):
                yield from self.first_declared(argument.value, "skill")

    def expressions(self, own: str, *expressions: Expression | None) -> Iterator[Mention]:
        """The readings in expressions, and the things that their measures are about."""
        for term in (term for expression in expressions if expression for term in expression.terms):
            if not isinstance(term, Phrase) or (term.kind.text == own and not term.arguments):
                continue
            if not term.arguments and self.names.noun_of(term.kind.text, READABLE_NOUNS):
                yield from self.first_declared(term.kind, *READABLE_NOUNS)
            else:
                yield from self.phrase("measure", term)

    def phrase(self, noun: str, phrase: Phrase | None) -> Iterator[Mention]:
        """The names among the arguments of a kind."""
        cls = kinds(noun).get(phrase.kind.text) if phrase else None
        if phrase is None or cls is None:
            return
        wanted = {parameter.key: parameter.type for parameter in arguments(cls)}
        for argument in phrase.arguments:
            yield from self._argument(argument, wanted.get(argument.key.text))

    def _argument(self, argument: Argument, wanted: Any) -> Iterator[Mention]:
        match argument.value, wanted:
            case Name() as name, Noun(noun="thing"):
                yield Mention("thing", name, self.by)
            case Name() as name, Noun(noun="sensor"):
                yield from self.first_declared(name, *READABLE_NOUNS)


def mentions(files: Iterable[File], names: Names) -> Iterator[Mention]:
    """Every name in these files that is declared somewhere in them, in no particular order."""
    for file in files:
        for setting in file.settings:
            if isinstance(setting, Master):
                yield from _Reader(names, None).first_declared(setting.name, "skill")
        for declaration in file.declarations:
            yield from _declaration(declaration, _Reader(names, declaration))


def names_in(fact: Fact, names: Names, by: Declaration) -> Iterator[Mention]:
    """The names in a fact of a declaration."""
    return _Reader(names, by).fact(fact)


def introductions(files: Iterable[File]) -> Iterator[Mention]:
    """Every name where it is declared, those of things where a task contains them."""
    for declaration in (declaration for file in files for declaration in file.declarations):
        yield Mention(declaration.header.noun.text, declaration.header.name, declaration)
        contained = (fact.name for fact in declaration.facts if isinstance(fact, Contains))
        yield from (Mention("thing", name, declaration) for name in contained)


def _declaration(declaration: Declaration, reader: _Reader) -> Iterator[Mention]:
    header = declaration.header
    yield Mention(header.noun.text, header.name, declaration)
    yield from reader.phrase(header.noun.text, header.phrase)
    if header.like:
        yield from reader.first_declared(header.like, header.noun.text)
    for fact in declaration.facts:
        yield from reader.fact(fact)
