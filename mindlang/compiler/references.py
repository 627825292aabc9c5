"""Every name in the files of a mind, with what it names: where a rename writes, and what a removal would break."""

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from mindrun.graph.graph import VARIED_NOUNS, Receiver
from mindrun.kinds.registry import arguments, find_kind, kinds
from mindrun.numbers.quantity import Quantity
from mindrun.numbers.quantity import Reference as Noun

from mindlang.compiler import syntax
from mindlang.compiler.names import Names
from mindlang.compiler.syntax import Declaration, Fact, File, Header, Name, Phrase, Setting, of_form

READABLE_NOUNS = ("sensor", "memory")
VALUE_NOUNS = (*READABLE_NOUNS, "number", "actuator", "draw")  # an actuator is its command, in a task
DRIVABLE_NOUNS: tuple[Receiver, ...] = ("actuator", "memory")


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
        for setting in file.settings:
            if isinstance(setting, syntax.Number):
                yield Mention("number", setting.name, None, is_own=True)
            yield from mentions_in(setting, names, None)
            yield from _amounts(setting, names, None)
        for declaration in file.declarations:
            for line in (declaration.header, *declaration.facts):
                yield from mentions_in(line, names, declaration)
                yield from _amounts(line, names, declaration)


def mentions_in(line: Setting | Header | Fact, names: Names, by: Declaration | None) -> Iterator[Mention]:
    """The names in a line, of a declaration where that is known, without those that stand in the place of amounts."""
    if isinstance(line, Header):
        yield Mention(line.noun.text, line.name, by, is_own=True)
    for name, nouns in names_in(line):
        local = "thing" if "thing" in nouns else "draw" if "draw" in nouns and name.text in names.draws else ""
        if noun := names.noun_of(name.text, nouns) or local:
            yield Mention(noun, name, by)


def _amounts(line: Any, names: Names, by: Declaration | None) -> Iterator[Mention]:
    """The numbers that are named in a line in the place of an amount, also those that a task draws."""
    for node in syntax.walk_tree(line) if names.numbers or names.draws else ():
        if isinstance(node, syntax.Amount) and (node.name in names.numbers or node.name in names.draws):
            yield Mention("number" if node.name in names.numbers else "draw", node.constant, by)


def introductions(files: Collection[File]) -> Iterator[Mention]:
    """Every name where it is declared, those of things where a task or a scene contains them."""
    numbers = (each for file in files for each in of_form(file.settings, syntax.Number))
    yield from (Mention("number", number.name, None, is_own=True) for number in numbers)
    for declaration in (declaration for file in files for declaration in file.declarations):
        yield Mention(declaration.header.noun.text, declaration.header.name, declaration, is_own=True)
        contained = of_form(declaration.facts, syntax.Contains)
        yield from (Mention("thing", fact.name, declaration) for fact in contained)
        drawn = of_form(declaration.facts, syntax.Draws)
        yield from (Mention("draw", fact.name, declaration) for fact in drawn)


Named = tuple[Name, Sequence[str]]  # with the nouns that it may be of: the first that declares it counts


def names_in(line: Setting | Header | Fact | syntax.Stop) -> Iterator[Named]:
    """The names in a line but for its own, and for those that stand in the place of amounts.

    A memory is read like a sensor, a sensor hides a measure; a thing need not be declared.
    """
    match line:
        case syntax.Master(name):
            yield name, ("skill",)
        case Header(noun, _, phrase, like=like, inside=inside):
            yield from (*_if_any(like, noun.text), *_if_any(inside, "scene"), *_in_phrase(noun.text, phrase))
            yield from _in_expressions(*syntax.expressions_in(line))
        case syntax.Reads(name, stands_for):
            yield name, READABLE_NOUNS
            yield from _if_any(stands_for, *READABLE_NOUNS)
        case syntax.Sends():
            yield from _in_output(line)
        case syntax.Promise() | syntax.Keeps() | syntax.Prefers():
            yield from _in_expressions(*syntax.expressions_in(line))
        case syntax.Contains(name, phrase):
            yield name, ("thing",)
            yield from _in_phrase("content", phrase)
            yield from _in_expressions(*syntax.expressions_in(line))
        case syntax.Draws(name):
            yield name, ("draw",)
        case syntax.Varies(of=of):
            yield of, (*VARIED_NOUNS, "thing")
        case syntax.Fails(name):
            yield name, ("actuator", "sensor")
        case syntax.Outcome(event=event) | syntax.Counts(event) | syntax.Wants(event=event):
            yield from _if_any(line.name if isinstance(line, syntax.Opens) else None, "thing")
            yield from _in_phrase("event", event)
            yield from _in_expressions(*syntax.expressions_in(line))
        case syntax.Rewards(amount, on, each, when):
            own = each.name.text if each else ""
            yield from _in_expressions(*syntax.expressions_in(amount, when), own=own)
            yield from _in_phrase("event", on)
            yield from _if_any(each.sensor if each else None, *READABLE_NOUNS)
        case syntax.Teaches():
            yield from _in_lesson(line)


def _in_lesson(line: syntax.Teaches) -> Iterator[Named]:
    """The names in a lesson: who is taught on what under whom, with what learner, and what it needs to happen."""
    yield from ((line.skill, ("skill",)), (line.task, ("task",)), *_if_any(line.master, "skill"))
    yield from _in_arguments(line.arguments, kinds("curriculum").values())
    for need in (*line.needs, *([line.until] if line.until else [])):
        yield from _in_phrase("event", need.event)


def _in_output(line: syntax.Sends) -> Iterator[Named]:
    """The names in a line that drives or influences: where it goes, and what it goes over."""
    nouns = DRIVABLE_NOUNS if isinstance(line, syntax.Drives) else ("skill",)
    yield line.name, nouns
    yield from _if_any(line.stands_for, *nouns)
    over = line.over or () if isinstance(line, syntax.Influences) else ()
    yield from ((each, DRIVABLE_NOUNS) for each in over)
    yield from _in_expressions(*syntax.expressions_in(line))


def _if_any(name: Name | None, *nouns: str) -> Iterator[Named]:
    if name:
        yield name, nouns


def _in_expressions(*expressions: syntax.Expression | None, own: str = "") -> Iterator[Named]:
    """The readings and commands in expressions, and the things that their measures are about."""
    for term in (term for expression in expressions if expression for term in expression.terms):
        if isinstance(term, syntax.Tally):
            yield from _in_phrase("event", term.event)
        elif isinstance(term, Phrase) and term.arguments:
            yield from _in_phrase("measure", term)
        elif isinstance(term, Phrase) and term.kind.text != own:
            yield term.kind, VALUE_NOUNS


def _in_phrase(noun: str, phrase: Phrase | None) -> Iterator[Named]:
    """The names among the arguments of a kind."""
    if phrase and phrase.arguments and (cls := find_kind(noun, phrase.kind.text)):
        yield from _in_arguments(phrase.arguments, [cls])
    if phrase and phrase.within:
        yield from _in_phrase(noun, phrase.within.of)


def _in_arguments(written: Iterable[syntax.Argument], classes: Iterable[type[Any]]) -> Iterator[Named]:
    """The names among arguments of some kinds; a lesson begins `from` a skill."""
    classes = [*classes]
    wanted = {each.key: each.type for cls in classes for each in arguments(cls)}
    about = ("memory", "thing") if any(getattr(cls, "can_be_reckoned", False) for cls in classes) else ("thing",)
    for key, value in ((each.key.text, each.value) for each in written):
        match value, wanted.get(key):
            case Name(), Noun(noun="thing"):
                yield value, about
            case syntax.AnyName(names), Noun(noun="thing"):
                yield from ((name, ("thing",)) for name in names)
            case Name(), Noun(noun="sensor"):
                yield value, READABLE_NOUNS
            case Name(), Noun(noun="skill"):
                yield value, ("skill",)
            case Name(), Noun(noun="servo"):
                yield value, ("actuator",)
            case Name(), Quantity():
                yield value, ("number", "draw")
            case Name(), None if key == "from":
                yield value, ("skill",)
