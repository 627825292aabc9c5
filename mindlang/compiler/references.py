"""Every name in the files of a mind, with what it names: where a rename writes, and what a removal would break."""

from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from mindrun.kinds.registry import arguments, kinds
from mindrun.kinds.variation import VARIED_NOUNS
from mindrun.numbers.quantity import Quantity
from mindrun.numbers.quantity import Reference as Noun
from msgspec import Struct
from msgspec.structs import astuple

from mindlang.compiler.names import Names
from mindlang.compiler.syntax import (
    Amount,
    Argument,
    Contains,
    Counts,
    Declaration,
    Drives,
    Ends,
    Expression,
    Fact,
    Fails,
    File,
    Influences,
    Master,
    Name,
    Number,
    Phrase,
    Reads,
    Rewards,
    Setting,
    Succeeds,
    Teaches,
    Varies,
)

READABLE_NOUNS = ("sensor", "memory")
VALUE_NOUNS = (*READABLE_NOUNS, "number", "actuator")  # an actuator is its command, in a task
DRIVABLE_NOUNS = ("actuator", "memory")


@dataclass(frozen=True, slots=True)
class Mention:
    """A name where it stands; `by` is the declaration in which that is, its own one perhaps.

    It `is_own` where it is declared.
    """

    noun: str
    name: Name
    by: Declaration | None
    is_own: bool = False


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
            case Drives(name):
                yield from self.first_declared(name, *DRIVABLE_NOUNS)
                yield from self.expressions("", *fact.expressions)
            case Influences(name):
                yield from self.first_declared(name, "skill")
                yield from self.expressions("", *fact.expressions)
            case Contains(name, phrase):
                yield Mention("thing", name, self.by)
                yield from self.phrase("content", phrase)
            case Varies(of=of):
                yield from self.varying(of)
            case Fails(name):
                yield from self.first_declared(name, "actuator", "sensor")
            case Ends(_, event, when) | Succeeds(_, event, when):
                yield from self.phrase("event", event)
                yield from self.expressions("", *(when.expressions if when else ()))
            case Counts(event):
                yield from self.phrase("event", event)
            case Rewards():
                yield from self.reward(fact)
            case Teaches():
                yield from self.lesson(fact)

    def varying(self, of: Name) -> Iterator[Mention]:
        """What a number is of that varies: a part of the robot, or a thing."""
        if self.names.noun_of(of.text, VARIED_NOUNS):
            yield from self.first_declared(of, *VARIED_NOUNS)
        else:
            yield Mention("thing", of, self.by)

    def amounts(self, node: Any) -> Iterator[Mention]:
        """The numbers that are named in a line in the place of an amount."""
        match node:
            case Amount():
                if node.name:
                    yield from self.first_declared(node.constant, "number")
            case tuple():
                for part in node:
                    yield from self.amounts(part)
            case Struct():
                for part in astuple(node):
                    yield from self.amounts(part)

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
        """The readings and commands in expressions, and the things that their measures are about."""
        for term in (term for expression in expressions if expression for term in expression.terms):
            if not isinstance(term, Phrase) or (term.kind.text == own and not term.arguments):
                continue
            if not term.arguments and self.names.noun_of(term.kind.text, VALUE_NOUNS):
                yield from self.first_declared(term.kind, *VALUE_NOUNS)
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
            case Name() as name, Quantity():
                yield from self.first_declared(name, "number")


def mentions(files: Iterable[File], names: Names) -> Iterator[Mention]:
    """Every name in these files that is declared somewhere in them, in no particular order."""
    for file in files:
        for setting in file.settings:
            yield from _setting(setting, _Reader(names, None))
        for declaration in file.declarations:
            yield from _declaration(declaration, _Reader(names, declaration))


def names_in(fact: Fact, names: Names, by: Declaration | None) -> Iterator[Mention]:
    """The names in a fact, of a declaration where that is known."""
    return _Reader(names, by).fact(fact)


def introductions(files: Collection[File]) -> Iterator[Mention]:
    """Every name where it is declared, those of things where a task or a scene contains them."""
    numbers = (each for file in files for each in file.settings if isinstance(each, Number))
    yield from (Mention("number", number.name, None, is_own=True) for number in numbers)
    for declaration in (declaration for file in files for declaration in file.declarations):
        yield Mention(declaration.header.noun.text, declaration.header.name, declaration, is_own=True)
        contained = (fact.name for fact in declaration.facts if isinstance(fact, Contains))
        yield from (Mention("thing", name, declaration) for name in contained)


def _setting(setting: Setting, reader: _Reader) -> Iterator[Mention]:
    if isinstance(setting, Master):
        yield from reader.first_declared(setting.name, "skill")
    if isinstance(setting, Number):
        yield Mention("number", setting.name, None, is_own=True)
    if reader.names.numbers:
        yield from reader.amounts(setting)


def _declaration(declaration: Declaration, reader: _Reader) -> Iterator[Mention]:
    header = declaration.header
    yield Mention(header.noun.text, header.name, declaration, is_own=True)
    if header.like:
        yield from reader.first_declared(header.like, header.noun.text)
    if header.inside:
        yield from reader.first_declared(header.inside, "scene")
    yield from reader.phrase(header.noun.text, header.phrase)
    yield from reader.expressions("", header.at)
    for fact in declaration.facts:
        yield from reader.fact(fact)
    if reader.names.numbers:
        yield from reader.amounts((header, *declaration.facts))
