"""A compiled mind with other names: every place of a graph where one stands."""

from collections.abc import Callable, Mapping
from dataclasses import Field, fields, is_dataclass, replace
from typing import Any, TypeVar

from mindrun.graph.graph import (
    Actuator,
    End,
    Failure,
    Graph,
    Lesson,
    Memory,
    Reward,
    Sensor,
    Skill,
    Task,
    Thing,
    Variation,
)
from mindrun.kinds.registry import arguments, names
from mindrun.numbers.quantity import EXPRESSION, SENSOR, THING

from mindlang.compiler.references import READABLE_NOUNS

T = TypeVar("T")
Name = Callable[..., str]  # what a name is called that may be of these nouns
NounNames = Mapping[str, Mapping[str, str]]  # what is called otherwise now, by noun

NAMED: Mapping[type, Mapping[str, str]] = {
    Graph: {"master": "skill"},
    Sensor: {"name": "sensor"},
    Memory: {"name": "memory"},
    Actuator: {"name": "actuator"},
    Skill: {"name": "skill", "like": "skill"},
    Thing: {"name": "thing"},
    Task: {"name": "task"},
    Failure: {"actuator": "actuator"},
    Lesson: {"curriculum": "curriculum", "skill": "skill", "task": "task", "master": "skill", "starts_from": "skill"},
}  # the nouns of the fields that are names


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
    if isinstance(node, Reward | End) and field.name == "text":
        return ""
    if isinstance(node, Variation) and field.name == "of":
        return name(value, node.noun)
    if noun := NAMED.get(type(node), {}).get(field.name):
        return name(value, noun)
    taken = arguments(type(node)) if type(node) in names() else ()
    match next((each.type for each in taken if each.field == field.name), None):
        case found if found == THING:
            return name(value, "thing")
        case found if found == SENSOR:
            return name(value, *READABLE_NOUNS)
        case found if found == EXPRESSION:
            return tuple((word, name(x, *READABLE_NOUNS) if isinstance(x, str) else x) for word, x in value)
    return renamed(value, name)
