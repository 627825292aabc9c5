"""The names of a mind: each noun (sensor, skill, task …) has its own, and each name is declared once."""

import re
import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain, islice
from typing import TypeVar

from msgspec.structs import replace

from mindlang.compiler.diagnostic import Findings, a, listed
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Contains, Declaration, Draws, File, Name, Number, of_form

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
    numbers: dict[str, Number] = field(default_factory=dict)

    def of(self, *nouns: str) -> list[str]:
        """The names declared with one of these nouns."""
        return [name for noun in nouns for name in self._of(noun)]

    def noun_of(self, name: str, nouns: Iterable[N]) -> N | None:
        """The first of the nouns with which the name is declared."""
        return next((noun for noun in nouns if name in self._of(noun)), None)

    def _of(self, noun: str) -> Mapping[str, Declaration | Number]:
        return self.numbers if noun == "number" else self.table.get(noun, {})

    def place_of(self, noun: str, name: str) -> Span:
        """Where a name is declared."""
        declared = self._of(noun)[name]
        return declared.name.span if isinstance(declared, Number) else declared.header.name.span

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

    @cached_property
    def draws(self) -> frozenset[str]:
        """The names of the numbers that tasks and scenes draw."""
        worlds = (each for noun in ("task", "scene") for each in self.table.get(noun, {}).values())
        return frozenset(fact.name.text for each in worlds for fact in of_form(each.facts, Draws))

    @cached_property
    def _all_things(self) -> dict[str, set[str]]:
        return declared_things(*self.table.get("task", {}).values())


def declared_things(*tasks: Declaration) -> dict[str, set[str]]:
    """The things of some tasks, with the kinds that they are of."""
    found: dict[str, set[str]] = {}
    for fact in of_form((fact for task in tasks for fact in task.facts), Contains):
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
    for number in (setting for file in files for setting in of_form(file.settings, Number)):
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
