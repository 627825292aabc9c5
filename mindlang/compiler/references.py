"""Every name in the files of a mind, with what it names: where a rename writes, and what a removal would break."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mindrun.graph.graph import VARIED_NOUNS
from mindrun.kinds.registry import arguments, find_kind, kinds
from mindrun.numbers.quantity import Quantity
from mindrun.numbers.quantity import Reference as Noun

from mindlang.compiler import syntax
from mindlang.compiler.names import Names
from mindlang.compiler.syntax import Declaration, Fact, File, Header, Name, Phrase, of_form

READABLE_NOUNS = ("sensor", "memory")
VALUE_NOUNS = (*READABLE_NOUNS, "number", "actuator")  # an actuator is its command, in a task
DRIVABLE_NOUNS = ("actuator", "memory")
# The fields of facts that are names, and the nouns of these.
NAMED: Mapping[type[Header | Fact], Mapping[str, Sequence[str]]] = {
    syntax.Reads: {"name": READABLE_NOUNS, "stands_for": READABLE_NOUNS},
    syntax.Drives: {"name": DRIVABLE_NOUNS},
    syntax.Influences: {"name": ("skill",)},
    syntax.Fails: {"name": ("actuator", "sensor")},
    syntax.Teaches: {"skill": ("skill",), "task": ("task",), "master": ("skill",)},
}


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
            reader = _Reader(names, declaration)
            for line in (declaration.header, *declaration.facts):
                yield from reader.line(line)
                yield from reader.amounts(line)


def mentions_in(line: Header | Fact, names: Names, by: Declaration | None) -> Iterator[Mention]:
    """The names in a line, of a declaration where that is known, without those that stand in the place of amounts."""
    return _Reader(names, by).line(line)


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
    """Resolves the names in a line by what is declared: a memory is read like a sensor, a sensor hides a measure."""

    names: Names
    by: Declaration | None

    def first_declared(self, name: Name | None, *nouns: str) -> Iterator[Mention]:
        """A name with the first of the nouns that it is declared with."""
        if name and (noun := self.names.noun_of(name.text, nouns)):
            yield Mention(noun, name, self.by)

    def amounts(self, line: Any) -> Iterator[Mention]:
        """The numbers that are named in a line in the place of an amount."""
        for node in syntax.walk_tree(line) if self.names.numbers else ():
            if isinstance(node, syntax.Amount) and node.name:
                yield from self.first_declared(node.constant, "number")

    def line(self, line: Header | Fact) -> Iterator[Mention]:
        """The names in a line; that of `for each` is its own."""
        for field, nouns in NAMED.get(type(line), {}).items():
            yield from self.first_declared(getattr(line, field), *nouns)
        match line:
            case Header(noun, name, phrase, like=like, inside=inside):
                yield Mention(noun.text, name, self.by, is_own=True)
                yield from self.first_declared(like, noun.text)
                yield from self.first_declared(inside, "scene")
                yield from self.phrase(noun.text, phrase)
            case syntax.Contains(name, phrase):
                yield Mention("thing", name, self.by)
                yield from self.phrase("content", phrase)
            case syntax.Varies(of=of):
                yield Mention(self.names.noun_of(of.text, VARIED_NOUNS) or "thing", of, self.by)
            case syntax.Outcome(_, event) | syntax.Counts(event) | syntax.Rewards(_, event):
                yield from self.phrase("event", event)
            case syntax.Teaches():
                yield from self.arguments(line.arguments, kinds("curriculum").values())
        each = line.each if isinstance(line, syntax.Rewards) else None
        yield from self.first_declared(each.sensor if each else None, *READABLE_NOUNS)
        yield from self.expressions(line, own=each.name.text if each else "")

    def expressions(self, line: Header | Fact, own: str) -> Iterator[Mention]:
        """The readings and commands in the expressions of a line, and the things that their measures are about."""
        for term in (term for expression in syntax.expressions_in(line) for term in expression.terms):
            if not isinstance(term, Phrase) or (term.kind.text == own and not term.arguments):
                continue
            if not term.arguments and self.names.noun_of(term.kind.text, VALUE_NOUNS):
                yield from self.first_declared(term.kind, *VALUE_NOUNS)
            else:
                yield from self.phrase("measure", term)

    def phrase(self, noun: str, phrase: Phrase | None) -> Iterator[Mention]:
        """The names among the arguments of a kind."""
        if phrase and phrase.arguments and (cls := find_kind(noun, phrase.kind.text)):
            yield from self.arguments(phrase.arguments, [cls])

    def arguments(self, written: Iterable[syntax.Argument], classes: Iterable[type[Any]]) -> Iterator[Mention]:
        """The names among arguments of some kinds; a lesson begins `from` a skill."""
        wanted = {each.key: each.type for cls in classes for each in arguments(cls)}
        for key, value in ((each.key.text, each.value) for each in written):
            match value, wanted.get(key):
                case Name(), Noun(noun="thing"):
                    yield Mention("thing", value, self.by)
                case Name(), Noun(noun="sensor"):
                    yield from self.first_declared(value, *READABLE_NOUNS)
                case Name(), Quantity():
                    yield from self.first_declared(value, "number")
                case Name(), None if key == "from":
                    yield from self.first_declared(value, "skill")
