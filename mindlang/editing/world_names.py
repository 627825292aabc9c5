"""A compiled mind with other names, and the facts of a training world after sensors, tasks or skills were renamed.

A kind's arguments say what they name. Another fact is renamed as the mind says it now, whatever its sentence looks
like: the worlds of the mind are made once more with a mark for each renamed name, and say of every text what it was
and what it becomes. Only what the mind does not say any more is read as a line of the language.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import Field, dataclass, fields, is_dataclass, replace
from functools import cached_property
from itertools import count
from typing import Any, TypeVar, cast

from lark import UnexpectedInput
from mindrun.graph import graph
from mindrun.graph.draws import Draw
from mindrun.kinds.registry import arguments, names
from mindrun.kinds.things.thing import OR
from mindrun.numbers.quantity import EXPRESSION, SENSOR, SERVO, SKILL, THING, Quantity, Reference

from mindlang.compiler.names import READABLE_NOUNS, Names, mentions_in
from mindlang.compiler.parse.shape import parse_line
from mindlang.compiler.source import Source, spliced
from mindlang.compiler.syntax import Fact
from mindlang.editing.insertion import replace_span
from mindlang.lock.training_world import TrainingWorld
from mindlang.lock.world_changes import NOUNS
from mindlang.lock.world_facts import Worlds, meaning_of

T = TypeVar("T")
Name = Callable[..., str]  # what a name is called that may be of these nouns
NounNames = Mapping[str, Mapping[str, str]]  # what is called otherwise now, by noun

NAMED: Mapping[type, Mapping[str, str]] = {
    graph.Graph: {"master": "skill"},
    graph.Sensor: {"name": "sensor"},
    graph.Memory: {"name": "memory"},
    graph.Actuator: {"name": "actuator"},
    graph.Skill: {"name": "skill", "like": "skill"},
    graph.Thing: {"name": "thing"},
    graph.Task: {"name": "task"},
    graph.Failure: {"actuator": "actuator"},
    graph.End: {"opens": "thing"},
    Draw: {"name": "draw"},
    graph.Lesson: {
        "curriculum": "curriculum",
        "skill": "skill",
        "task": "task",
        "master": "skill",
        "starts_from": "skill",
    },
}  # the nouns of the fields that are names

OF_KINDS = "sensor", "memory", "actuator", "thing"  # the nouns of facts that are kinds

Role = tuple[str | int, ...]  # where a text stands: the noun of its fact, and the keys and numbers that lead to it
WORLDS = "task", "scene"
_MARK = re.compile("\0([0-9]+)\0")  # no name has such a character
_TITLE = re.compile(r"([a-z]\w*\.)?[A-Z]")
_AROUND_SENTENCE: Mapping[Role, Callable[[str], tuple[str, str]]] = {
    ("skill", "reads"): lambda _: ("reads ", ""),
    ("skill", "sends"): lambda text: ("influences " if _TITLE.match(text) else "drives ", ""),
    ("task", "ends"): lambda text: ("ends " if text.startswith("when ") else "ends on ", ""),
    ("task", "succeeds"): lambda text: ("ends " if text.startswith("when ") else "ends on ", ""),
    ("task", "opens"): lambda _: ("opens ", ""),
    ("varying",): lambda _: ("", ""),
    ("rewards", 0): lambda _: ("rewards ", " per tick"),
    ("rewards", 1): lambda _: ("rewards 1 ", ""),
}  # what stands before and after a text of a lock where it is a fact of a mind


@dataclass(frozen=True)
class Renaming:
    """New names by noun, and the minds in whose worlds the texts with these names are looked up."""

    names: NounNames
    minds: Sequence[graph.Graph]

    def name(self, text: str, *nouns: str) -> str:
        """The present name of something with one of these nouns."""
        return now_called(text, self.names, *nouns)

    def relabelled(self, world: TrainingWorld) -> TrainingWorld:
        """A training world with these names in its facts."""
        if not self._pairs:
            return world
        texts = self._texts(world)

        def text(role: Role, old: str) -> str:
            return texts.get((role, old)) or self._read_again(role, old)

        now = {}
        for subject, value in world.facts.items():
            noun, space, own = subject.partition(" ")
            now[f"{noun}{space}{self.name(own, noun)}"] = (
                {
                    key: _argument(part, meaning_of(NOUNS.get(noun, noun), value["is"], key), self.name)
                    for key, part in value.items()
                }
                if noun in OF_KINDS
                else _mapped(value, (noun,), text)
            )
        lesson = world.facts["lesson"]
        nouns = {"task": "task", "master": "skill", "starts_from": "skill"}
        named = {key: self.name(lesson[key], noun) for key, noun in nouns.items() if key in lesson}
        return TrainingWorld({**now, "lesson": {**lesson, **named}})

    def _texts(self, world: TrainingWorld) -> dict[tuple[Role, str], str]:
        """The new text for each role and old text, from the worlds of the same lesson in the minds."""
        found: dict[tuple[Role, str], str] = {}

        def noted(role: Role, text: str) -> str:
            found.setdefault((role, self._unmarked(text, 0)), self._unmarked(text, 1))
            return text

        lesson = world.lesson
        for mind in self._marked:
            task, master = self._mark(lesson.task, "task"), self._mark(lesson.master, "skill")
            if task in {each.name for each in mind.graph.tasks} and master in mind.graph.skill_numbers:
                facts = mind.of_gone(type(lesson)(task, master, lesson.jointly), {}).facts
                for subject, value in facts.items():
                    _mapped(value, (subject.partition(" ")[0],), noted)
        return found

    @cached_property
    def _pairs(self) -> list[tuple[str, str]]:
        return [pair for named in self.names.values() for pair in named.items()]

    @cached_property
    def _marks(self) -> NounNames:
        """The mark of each name, as it was and as it is now."""
        numbers = count()
        numbered = {noun: [(pair, next(numbers)) for pair in named.items()] for noun, named in self.names.items()}
        return {noun: {name: f"\0{i}\0" for pair, i in pairs for name in pair} for noun, pairs in numbered.items()}

    def _mark(self, text: str, *nouns: str) -> str:
        return now_called(text, self._marks, *nouns)

    @cached_property
    def _marked(self) -> list[Worlds]:
        return [Worlds(renamed(mind, self._mark), None) for mind in self.minds]

    def _unmarked(self, text: str, which: int) -> str:
        return _MARK.sub(lambda found: self._pairs[int(found[1])][which], text)

    @cached_property
    def _declared(self) -> Names:
        """All names of the minds and those that are renamed, so that a name stands for the noun that it does there.

        No fact of a world names a task.
        """
        table: dict[str, dict[str, Any]] = {noun: {**its} for noun, its in self.names.items() if noun not in WORLDS}
        for mind in self.minds:
            parts: list[Any] = [*mind.sensors, *mind.memories, *mind.actuators, *mind.skills]
            parts += [draw for task in mind.tasks for draw in task.draws]
            for part in parts:
                table.setdefault(type(part).__name__.lower(), {})[part.name] = part
        return Names(table)

    def _read_again(self, role: Role, text: str) -> str:
        """A text that no mind says now, read as the fact that it was once, with other names."""
        if role not in _AROUND_SENTENCE:
            is_name = role[0] == "skill" and role[-1] not in ("is", "chooses")
            return self.name(text, "skill", "actuator", "memory") if is_name else text
        before, after = _AROUND_SENTENCE[role](text)
        source = Source("a fact", f"{before}{text}{after}")
        try:
            fact = cast(Fact, parse_line(source.text, source, 0))
        except UnexpectedInput:
            return text
        mentions = mentions_in(fact, self._declared, None)
        splices = (replace_span(each.name.span, self.name(each.name.text, each.noun)) for each in mentions)
        return spliced(source, splices).removeprefix(before).removesuffix(after)


def _mapped(value: Any, role: Role, text: Callable[[Role, str], str]) -> Any:
    """A fact's value with other texts; those in a list have one role, those in a list of one their places, too."""
    match value:
        case str():
            return text(role, value)
        case dict():
            return {key: _mapped(part, (*role, key), text) for key, part in value.items()}
        case list():
            return [
                [_mapped(each, (*role, i), text) for i, each in enumerate(part)]
                if isinstance(part, list)
                else _mapped(part, role, text)
                for part in value
            ]
    return value


def now_called(name: str, names: NounNames, *nouns: str) -> str:
    """The new name of something with one of these nouns; the old one where it was not renamed."""
    return next((names[noun][name] for noun in nouns if name in names.get(noun, {})), name)


def renamed(node: T, name: Name) -> T:
    """A graph, or a part of one, with the names that `name(TEXT, *NOUNS)` gives, without texts as they were written."""
    if isinstance(node, tuple):
        return tuple(renamed(each, name) for each in node)  # type: ignore[return-value]
    if not is_dataclass(node) or isinstance(node, type):
        return node
    return replace(node, **{field.name: _value(node, field, name) for field in fields(node)})


def _value(node: Any, field: Field[Any], name: Name) -> Any:
    value = getattr(node, field.name)
    if isinstance(node, graph.Reward | graph.End | graph.Promise) and field.name == "text":
        return ""
    if isinstance(node, graph.Variation) and field.name == "of":
        return name(value, node.noun)
    if noun := NAMED.get(type(node), {}).get(field.name):
        return name(value, noun)
    taken = arguments(type(node)) if type(node) in names() else ()
    return renamed(_argument(value, next((each.type for each in taken if each.field == field.name), None), name), name)


def _argument(value: Any, meaning: Quantity | Reference | None, name: Name) -> Any:
    """An argument of a kind, of a graph or a fact, with other names."""
    if meaning == THING:
        return OR.join(name(each, "thing") for each in value.split(OR)) if isinstance(value, str) else value
    if meaning == SENSOR:
        return name(value, *READABLE_NOUNS)
    if meaning == SKILL:
        return name(value, "skill")
    if meaning == SERVO:
        return name(value, "actuator")
    if meaning == EXPRESSION:
        new = ((word, name(x, *READABLE_NOUNS) if isinstance(x, str) else x) for word, x in value)
        return type(value)(map(type(value), new))
    return value
