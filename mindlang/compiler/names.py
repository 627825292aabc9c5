"""The names of a mind: each noun (sensor, skill, task …) has its own, and each name is declared once.

Every name in the files, with what it names, is a mention: where a rename writes, and what a removal would break.
"""

import re
import unicodedata
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain, islice
from typing import Any, TypeVar

from mindrun.graph.graph import VARIED_NOUNS, Receiver
from mindrun.kinds.registry import arguments, find_kind, kinds
from mindrun.numbers.quantity import Quantity
from mindrun.numbers.quantity import Reference as Noun
from msgspec.structs import replace

from mindlang.compiler import syntax
from mindlang.compiler.diagnostic import Findings, a, listed
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Declaration, Fact, File, Header, Name, Phrase, Setting, of_form

# A memory is read like a sensor and driven like an actuator, so its name must be neither's.
# In an expression, a number's name stands where a reading's may, in rewards a command's, and in tasks that of a draw.
SHARED = {
    "sensor": ("memory", "number"),
    "actuator": ("memory", "number"),
    "memory": ("sensor", "actuator", "number"),
    "number": ("sensor", "memory", "actuator"),
    "draw": ("sensor", "memory", "actuator", "number"),
}
_WORD = re.compile(r"\w[\w.+-]*")
NOUN_USES = {
    "sensor": "a skill reads sensors",
    "memory": "a skill reads and drives memories",
    "actuator": "a skill drives actuators",
    "skill": "skills are influenced, taught, and one is the master",
}


N = TypeVar("N", bound=str)


@dataclass(frozen=True)
class Names:
    """Declarations by noun and name, in the order of the sources.

    `unread` are the words of the lines that could not be read: any of them may have been declared there.
    """

    table: dict[str, dict[str, Declaration]]
    unread: Set[str] = frozenset()
    numbers: dict[str, syntax.Number] = field(default_factory=dict)

    def of(self, *nouns: str) -> list[str]:
        """The names declared with one of these nouns."""
        return [name for noun in nouns for name in self._of(noun)]

    def noun_of(self, name: str, nouns: Iterable[N]) -> N | None:
        """The first of the nouns with which the name is declared."""
        return next((noun for noun in nouns if name in self._of(noun)), None)

    def _of(self, noun: str) -> Mapping[str, Declaration | syntax.Number]:
        return self.numbers if noun == "number" else self.table.get(noun, {})

    def place_of(self, noun: str, name: str) -> Span:
        declared = self._of(noun)[name]
        return declared.name.span if isinstance(declared, syntax.Number) else declared.header.name.span

    def declarations(self, noun: str) -> Iterator[tuple[str, Declaration]]:
        """The declarations of a noun with their names."""
        yield from self.table.get(noun, {}).items()

    def find(self, name: Name, nouns: Sequence[N], findings: Findings) -> N | None:
        """The noun with which the name is declared; a name that is not is reported."""
        if noun := self.noun_of(name.text, nouns):
            return noun
        if not self.unread.isdisjoint((name.text, name.span.text)):  # that of a member stands in no line by itself
            return None
        wanted = listed(nouns)
        other = self.noun_of(name.text, [noun for noun in NOUN_USES if noun not in nouns])
        if other:
            hint = f"There is {a(other)} of that name, but {NOUN_USES[other]}."
        else:
            known = (self._of(noun) for noun in nouns)
            hint = findings.suggest(name.text, *known) or self._offer(nouns)
            if "sensor" in nouns and name.text in self._all_things:
                what = f"{name.text} is a thing of a task; what the robot knows of it is a sensor"
                hint = f"{what}, such as bearing of {name.text}."
            if odd := next((letter for letter in name.text if not letter.isascii()), None):
                hint += f" Its letter {odd} is {unicodedata.name(odd, 'an odd one').lower()}."
        findings.error(f"unknown-{nouns[0]}", name.span, f"There is no {wanted} called {name.text}.", hint)
        return None

    def _offer(self, nouns: Sequence[str]) -> str:
        known = [*islice(chain.from_iterable(map(self._of, nouns)), 9)]
        if not known:
            return f"Declare it: {nouns[0]} NAME {'in' if nouns[0] == 'task' else 'is'} KIND."
        more = ", …" if len(known) > 8 else ""
        return f"Declared are {', '.join(known[:8])}{more}." if len(known) > 1 else f"The only one is {known[0]}."

    def things(self) -> dict[str, set[str]] | None:
        """The things that some task contains, with the kinds that they are of; None where this is not known."""
        tasks = self.table.get("task", {}).values()
        return self._all_things if tasks and all(task.whole for task in tasks) else None

    def kind_of_memory(self, name: str) -> type[Any] | None:
        """The kind of the memory of that name; None where there is none, or none of a kind that is known."""
        memory = self.table.get("memory", {}).get(name)
        return find_kind("memory", memory.header.phrase.kind.text) if memory and memory.header.phrase else None

    def is_place(self, name: str) -> bool:
        """True if the name is that of a memory of which a bearing can be."""
        kind = self.kind_of_memory(name)
        return kind is not None and kind.is_place

    @cached_property
    def draws(self) -> frozenset[str]:
        """The names of the numbers that tasks and scenes draw."""
        worlds = (each for noun in ("task", "scene") for each in self.table.get(noun, {}).values())
        return frozenset(fact.name.text for each in worlds for fact in of_form(each.facts, syntax.Draws))

    @cached_property
    def _all_things(self) -> dict[str, set[str]]:
        return declared_things(*self.table.get("task", {}).values())


def declared_things(*tasks: Declaration) -> dict[str, set[str]]:
    """The things of some tasks, with the kinds that they are of."""
    found: dict[str, set[str]] = {}
    for fact in of_form((fact for task in tasks for fact in task.facts), syntax.Contains):
        found.setdefault(fact.name.text, set()).add(fact.phrase.kind.text)
    return found


def _words(span: Span) -> list[str]:
    """The words of the line on which a span starts."""
    text = span.source.text
    end = text.find("\n", span.start)
    words = _WORD.findall(text, text.rfind("\n", 0, span.start) + 1, end if end >= 0 else len(text))
    return [*words, *(word.replace("-", "_") for word in words)]


def declared_names(files: Iterable[File], findings: Findings) -> Names:
    """All declarations by name; of two with one name the second is reported."""
    names = Names({}, frozenset(word for found in findings.diagnostics if found.span for word in _words(found.span)))
    above: Declaration | None = None
    for declaration in (declaration for file in files for declaration in file.declarations):
        noun, name = declaration.header.noun.text, declaration.header.name
        other = names.noun_of(name.text, (noun, *SHARED.get(noun, ())))
        if other and above and not declaration.header.is_read:
            facts = (*above.facts, *declaration.facts)  # `senses eyes` was meant as a fact, not as a sensor
            declaration = replace(above, facts=facts, whole=False)
            noun, name = above.header.noun.text, above.header.name
        elif other:
            refuse_declared(names, other, name, findings)
            continue
        names.table.setdefault(noun, {})[name.text] = above = declaration
    for number in (setting for file in files for setting in of_form(file.settings, syntax.Number)):
        if other := names.noun_of(number.name.text, ("number", *SHARED["number"])):
            refuse_declared(names, other, number.name, findings)
        else:
            names.numbers[number.name.text] = number
    findings.numbers, findings.draws = names.numbers.keys() | names.unread, names.draws
    return names


def refuse_declared(names: Names, noun: str, name: Name, findings: Findings) -> None:
    """Report a name that a noun has already."""
    message, hint = f"There is already {a(noun)} called {name.text}.", "Give one of the two another name."
    places = names.place_of(noun, name.text), name.span
    findings.refuse_again("duplicate-name", places, message, hint, "first declared here")


READABLE_NOUNS = ("sensor", "memory")
VALUE_NOUNS = (*READABLE_NOUNS, "number", "actuator", "draw")  # an actuator is its command, in a task
DRIVABLE_NOUNS: tuple[Receiver, ...] = ("actuator", "memory")
_SKILL: tuple[Receiver, ...] = ("skill",)
# The nouns of what the names in a line may be, by its fields; those of its phrases and expressions their kinds say.
NAMED_NOUNS: Mapping[type[Any], Mapping[str, tuple[str, ...]]] = {
    syntax.Master: {"name": _SKILL},
    Header: {"inside": ("scene",)},
    syntax.Reads: {"name": READABLE_NOUNS, "stands_for": READABLE_NOUNS},
    syntax.Drives: {"name": DRIVABLE_NOUNS, "stands_for": DRIVABLE_NOUNS},
    syntax.Influences: {"name": _SKILL, "stands_for": _SKILL, "over": DRIVABLE_NOUNS},
    syntax.Contains: {"name": ("thing",), "master": _SKILL},
    syntax.Draws: {"name": ("draw",)},
    syntax.Varies: {"of": (*VARIED_NOUNS, "thing")},
    syntax.Fails: {"name": ("actuator", "sensor")},
    syntax.Opens: {"name": ("thing",)},
    syntax.Each: {"sensor": READABLE_NOUNS},
    syntax.Teaches: {"skill": _SKILL, "task": ("task",), "master": _SKILL},
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
        if "memory" in nouns and "thing" in nouns and not names.is_place(name.text):
            nouns = ("thing",)
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
    own = ""
    yield from _in_fields(line)
    match line:
        case Header(noun, _, phrase, like=like):
            yield from ((name, (noun.text,)) for name in (like,) if name)
            yield from _in_phrase(noun.text, phrase)
        case syntax.Contains(_, phrase):
            yield from _in_phrase("content", phrase)
        case syntax.Outcome(event=event) | syntax.Counts(event) | syntax.Wants(event=event):
            yield from _in_phrase("event", event)
        case syntax.Rewards(on=on, each=each):
            own = each.name.text if each else ""
            yield from (*_in_phrase("event", on), *_in_fields(each))
        case syntax.Teaches():
            yield from _in_arguments(line.arguments, kinds("curriculum").values())
            for need in (*line.needs, *([line.until] if line.until else [])):
                yield from _in_phrase("event", need.event)
    yield from _in_expressions(*syntax.expressions_in(line), own=own)


def _in_fields(node: Any) -> Iterator[Named]:
    """The names that are fields of a line or of a part of one."""
    for key, nouns in NAMED_NOUNS.get(type(node), {}).items():
        value = getattr(node, key) or ()
        yield from ((name, nouns) for name in (value if isinstance(value, tuple) else (value,)))


def _in_expressions(*expressions: syntax.Expression, own: str) -> Iterator[Named]:
    """The readings and commands in expressions, and the things that their measures are about."""
    for term in (term for expression in expressions for term in expression.terms):
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
