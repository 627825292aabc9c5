"""Every name in the files of a mind, with what it names: where a rename writes, and what a removal would break."""

from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from mindrun.kinds.registry import arguments, kinds
from mindrun.kinds.variation import VARIED_NOUNS
from mindrun.numbers.quantity import Quantity
from mindrun.numbers.quantity import Reference as Noun

from mindlang.compiler import syntax
from mindlang.compiler.names import Names
from mindlang.compiler.syntax import Amount, Declaration, Expression, Fact, File, Name, Phrase, of_form, walk

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


def mentions(files: Iterable[File], names: Names) -> Iterator[Mention]:
    """Every name in these files that is declared somewhere in them, in no particular order."""
    for file in files:
        reader = _Reader(names, None)
        for setting in file.settings:
            if isinstance(setting, syntax.Master):
                yield from reader.first_declared(setting.name, "skill")
            if isinstance(setting, syntax.Number):
                yield Mention("number", setting.name, None, is_own=True)
            yield from reader.amounts(setting)
        for declaration in file.declarations:
            yield from _Reader(names, declaration).declaration(declaration)


def names_in(fact: Fact, names: Names, by: Declaration | None) -> Iterator[Mention]:
    """The names in a fact, of a declaration where that is known."""
    return _Reader(names, by).fact(fact)


def introductions(files: Collection[File]) -> Iterator[Mention]:
    """Every name where it is declared, those of things where a task or a scene contains them."""
    numbers = (each for file in files for each in of_form(file.settings, syntax.Number))
    yield from (Mention("number", number.name, None, is_own=True) for number in numbers)
    for declaration in (declaration for file in files for declaration in file.declarations):
        yield Mention(declaration.header.noun.text, declaration.header.name, declaration, is_own=True)
        contained = of_form(declaration.facts, syntax.Contains)
        yield from (Mention("thing", fact.name, declaration) for fact in contained)


@dataclass(frozen=True, slots=True)
class _Reader:
    """What a name means depends on which names there are: a memory is read like a sensor, a sensor hides a measure."""

    names: Names
    by: Declaration | None

    def declaration(self, declaration: Declaration) -> Iterator[Mention]:
        """The names in a declaration, its own included."""
        header = declaration.header
        yield Mention(header.noun.text, header.name, declaration, is_own=True)
        yield from self.first_declared(header.like, header.noun.text)
        yield from self.first_declared(header.inside, "scene")
        yield from self.phrase(header.noun.text, header.phrase)
        yield from self.expressions(header.at)
        for fact in declaration.facts:
            yield from self.fact(fact)
        yield from self.amounts((header, *declaration.facts))

    def first_declared(self, name: Name | None, *nouns: str) -> Iterator[Mention]:
        """A name with the first of the nouns that it is declared with."""
        if name and (noun := self.names.noun_of(name.text, nouns)):
            yield Mention(noun, name, self.by)

    def amounts(self, lines: Any) -> Iterator[Mention]:
        """The numbers that are named in lines in the place of an amount."""
        for node in walk(lines) if self.names.numbers else ():
            if isinstance(node, Amount) and node.name:
                yield from self.first_declared(node.constant, "number")

    def fact(self, fact: Fact) -> Iterator[Mention]:
        """The names in a fact; that of `for each` is its own."""
        match fact:
            case syntax.Reads(name, stands_for):
                yield from self.first_declared(name, *READABLE_NOUNS)
                yield from self.first_declared(stands_for, *READABLE_NOUNS)
            case syntax.Drives(name):
                yield from self.first_declared(name, *DRIVABLE_NOUNS)
                yield from self.expressions(*fact.expressions)
            case syntax.Influences(name):
                yield from self.first_declared(name, "skill")
                yield from self.expressions(*fact.expressions)
            case syntax.Contains(name, phrase):
                yield Mention("thing", name, self.by)
                yield from self.phrase("content", phrase)
            case syntax.Varies(of=of):
                yield Mention(self.names.noun_of(of.text, VARIED_NOUNS) or "thing", of, self.by)
            case syntax.Fails(name):
                yield from self.first_declared(name, "actuator", "sensor")
            case syntax.Outcome(_, event, when):
                yield from self.phrase("event", event)
                yield from self.expressions(*(when.expressions if when else ()))
            case syntax.Counts(event):
                yield from self.phrase("event", event)
            case syntax.Rewards(amount, on, each, when):
                own = each.name.text if each else ""
                yield from self.expressions(amount, *(when.expressions if when else ()), own=own)
                yield from self.phrase("event", on)
                yield from self.first_declared(each.sensor if each else None, *READABLE_NOUNS)
            case syntax.Teaches(skill, task, master):
                yield from self.first_declared(skill, "skill")
                yield from self.first_declared(task, "task")
                yield from self.first_declared(master, "skill")
                for value in (each.value for each in fact.arguments if each.key.text == "from"):
                    yield from self.first_declared(value if isinstance(value, Name) else None, "skill")

    def expressions(self, *expressions: Expression | None, own: str = "") -> Iterator[Mention]:
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
            match argument.value, wanted.get(argument.key.text):
                case Name() as name, Noun(noun="thing"):
                    yield Mention("thing", name, self.by)
                case Name() as name, Noun(noun="sensor"):
                    yield from self.first_declared(name, *READABLE_NOUNS)
                case Name() as name, Quantity():
                    yield from self.first_declared(name, "number")
