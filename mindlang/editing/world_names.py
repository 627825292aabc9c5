"""Renames inside of a training world: the facts of a lock after sensors, tasks or skills have been renamed."""

import re
from collections.abc import Callable, Mapping
from typing import Any

from mindrun.quantity import Reference
from mindrun.registry import arguments, kinds

from mindlang.compiler.references import READABLE_NOUNS
from mindlang.lock.training_world import TrainingWorld

NounNames = Mapping[str, Mapping[str, str]]  # what is called otherwise now, by noun
ENDS = ("ends", "succeeds")
OF_THINGS = {"of", "toward", "from"}  # words before the name of a thing, in a phrase
_WORD = re.compile(r"[^\s()]+")

Name = Callable[..., str]


def relabelled(world: TrainingWorld, names: NounNames) -> TrainingWorld:
    """A training world with these renames applied to its facts."""

    def name(text: str, *nouns: str) -> str:
        return next((names[noun][text] for noun in nouns if text in names.get(noun, {})), text)

    return TrainingWorld(
        {_subject(subject, name): _fact(subject, value, name) for subject, value in world.facts.items()}
    )


def _subject(subject: str, name: Name) -> str:
    noun, space, named = subject.partition(" ")
    return f"{noun}{space}{name(named, noun)}"


def _fact(subject: str, value: Any, name: Name) -> Any:
    match subject.partition(" ")[0]:
        case "sensor":
            nouns = _named_by(value["is"])
            return {key: _renamed(part, nouns[key], name) if key in nouns else part for key, part in value.items()}
        case "skill":
            return {key: _skill_part(key, part, name) for key, part in value.items()}
        case "task":
            ends = {key: sorted(_phrase(event, name) for event in value[key]) for key in ENDS if key in value}
            return {**value, **ends}
        case "rewards":
            return sorted([_phrase(part, name) for part in reward] for reward in value)
        case "lesson":
            renamed = {"task": name(value["task"], "task"), "master": name(value["master"], "skill")}
            if "starts_from" in value:
                renamed["starts_from"] = name(value["starts_from"], "skill")
            return {**value, **renamed}
    return value


def _renamed(part: Any, noun: str, name: Name) -> Any:
    """The name that an argument says, or the readings in its expression."""
    if noun == "expression":
        return [[word, name(x, *READABLE_NOUNS) if isinstance(x, str) else x] for word, x in part]
    return name(part, *(READABLE_NOUNS if noun == "sensor" else (noun,)))


def _named_by(kind: str) -> dict[str, str]:
    """The arguments of a kind of sensor that name something, with its noun."""
    known = kinds("sensor").get(kind)
    taken = arguments(known) if known else ()
    return {each.field: each.type.noun for each in taken if isinstance(each.type, Reference)}


def _skill_part(key: str, value: Any, name: Name) -> Any:
    if key == "like":
        return name(value, "skill")
    if key == "reads":
        return [_read(each, name) for each in value]
    if key not in ("sends", "answers"):
        return value
    return [_sent(each, name) for each in value]


def _read(text: str, name: Name) -> str:
    """What a skill reads, and in place of what where it is like another."""
    return " for ".join(name(each, "sensor", "memory") for each in text.split(" for "))


def _sent(text: str, name: Name) -> str:
    target, at, value = text.partition(" at ")
    return f"{name(target, 'skill', 'actuator', 'memory')}{at}{_phrase(value, name)}"


def _phrase(text: str, name: Name) -> str:
    """An expression, an event or a measure with other names."""
    before = ""

    def instead(found: re.Match[str]) -> str:
        nonlocal before
        nouns = ("thing",) if before in OF_THINGS else ("sensor", "memory")
        before = found.group()
        return name(before, *nouns)

    return _WORD.sub(instead, text)
