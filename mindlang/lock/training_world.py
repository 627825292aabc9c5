"""The world in which a skill was taught, as facts that a lock keeps and that can be held against a mind.

Each fact has a subject (`tick`, `body`, `sensor eye`, `skill Grab`, `thing ball`, `rewards`, `lesson`, …) and is plain
JSON. In a lock a world is a block of lines, named by a hash of them:

    world 1f3c9a2b77d04c55
      body = {"angular_damping": 20.0, "density": 2.0, "is": "disc", "linear_damping": 5.0, "size": 2.0}
      tick = 0.016666666666666666
"""

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from hashlib import sha256
from math import isfinite
from typing import Any, NoReturn

HEADING = re.compile(r"world (?P<name>[0-9a-f]{16})")
MOST_FACT_CHARACTERS = 1 << 20
_FACT = re.compile(r"  (?P<subject>[^\s=]+(?: [^\s=]+)?) = (?P<value>.+)")
_PARTS = ("actuator", "memory", "sensor", "thing")


@dataclass(frozen=True, slots=True)
class LessonKey:
    """Which lesson it was: a skill can be taught on several tasks, under several masters, alone or `jointly`."""

    task: str
    master: str
    jointly: bool


@dataclass(frozen=True)
class TrainingWorld:
    """The facts by subject. Two worlds with the same facts are equal."""

    facts: Mapping[str, Any]

    @cached_property
    def name(self) -> str:
        """The start of the SHA-256 of its lines."""
        return sha256("\n".join(self._lines()).encode()).hexdigest()[:16]

    @property
    def lesson(self) -> LessonKey:
        """The lesson that was taught in it."""
        lesson = self.facts["lesson"]
        return LessonKey(lesson["task"], lesson["master"], lesson["with_subskills"])

    def text(self) -> str:
        """Its block in a lock."""
        return "\n".join([f"world {self.name}", *self._lines()])

    def _lines(self) -> Iterator[str]:
        for subject in sorted(self.facts):
            yield f"  {subject} = {json.dumps(self.facts[subject], ensure_ascii=False, sort_keys=True)}"


def world_of(name: str, lines: Iterable[str]) -> TrainingWorld:
    """The world that the lines of a block say; ValueError where they are not what `text` wrote."""
    facts: dict[str, Any] = {}
    for line in lines:
        found = _FACT.fullmatch(line)
        if found is None or found["subject"] in facts or len(line) > MOST_FACT_CHARACTERS:
            raise ValueError("this is not a fact of a world")
        facts[found["subject"]] = _value(found["subject"], found["value"])
    world = TrainingWorld(facts)
    if not {"tick", "body", "rewards", "lesson"} <= facts.keys() or world.name != name:
        raise ValueError(f"these are not the facts of world {name}")
    return world


def _value(subject: str, text: str) -> Any:
    """A fact's value, in the form that its subject asks for; ValueError where it is not."""
    try:
        value = json.loads(text, parse_constant=_no_number)
    except RecursionError:
        raise ValueError("it is nested too deeply") from None
    if not _is_valid_fact(subject, value):
        raise ValueError(f"{subject} cannot be so")
    return value


def _no_number(text: str) -> NoReturn:
    raise ValueError(f"{text} is no number")


def _is_valid_fact(subject: str, value: Any) -> bool:
    match subject.split(" "):
        case ["tick"]:
            return _is_number(value) and value > 0
        case ["claw"]:
            return _is_number(value)
        case ["body"]:
            return _is_kind(value)
        case [noun, _] if noun in _PARTS:
            return _is_kind(value)
        case ["skill", _]:
            return _is_skill(value)
        case ["task"]:
            return isinstance(value, dict) and _is_task(value)
        case ["environment"]:
            return isinstance(value, dict) and value.keys() == {"text"} and isinstance(value["text"], str)
        case ["physics"]:
            known = {"pymunk": str, "world": int}
            return isinstance(value, dict) and {key: type(part) for key, part in value.items()} == known
        case ["start"]:
            return (
                isinstance(value, dict) and value.keys() == {"at", "facing"} and all(map(_is_argument, value.values()))
            )
        case ["varying"]:
            return _are_strings(value)
        case ["rewards"]:
            return isinstance(value, list) and all(_are_strings(each) and len(each) == 2 for each in value)
        case ["lesson"]:
            return isinstance(value, dict) and _is_lesson(value)
    return False


def _is_skill(value: Any) -> bool:
    """Whether it is what `facts.py` says of a skill: strings, or lists of them."""
    return isinstance(value, dict) and all(isinstance(each, str) or _are_strings(each) for each in value.values())


def _is_task(value: dict[str, Any]) -> bool:
    match value:
        case {"scene": scene, "ticks": ticks, "ends": ends}:
            successes = value.get("succeeds", [])
            known = len(value) == 3 + ("succeeds" in value) and _are_strings(ends) and _are_strings(successes)
            return known and _is_kind(scene) and _is_number(ticks)
    return False


def _is_lesson(value: dict[str, Any]) -> bool:
    match value:
        case {"task": str(), "master": str(), "with_subskills": bool(), "from_scratch": bool(), "learner": learner}:
            origin = value.get("starts_from", "")
            return len(value) == 5 + ("starts_from" in value) and isinstance(origin, str) and _is_kind(learner)
    return False


def _is_kind(value: Any) -> bool:
    """Whether it is a kind as `mindrun.graph.codec` says it: its name and its arguments."""
    return isinstance(value, dict) and isinstance(value.get("is"), str) and all(map(_is_argument, value.values()))


def _is_argument(value: Any) -> bool:
    match value:
        case None | bool() | str():
            return True
        case list():
            return (
                all(map(_is_number, value)) or _are_strings(value) or all(map(_is_place, value)) or _is_formula(value)
            )
        case dict():
            by = value.get("by")
            is_span = value.keys() == {"first", "last", "by"} and (by is None or _is_number(by))
            return is_span and _is_number(value["first"]) and _is_number(value["last"])
    return _is_number(value)


def _is_place(value: Any) -> bool:
    return isinstance(value, list) and len(value) == 2 and all(map(_is_number, value))


def _is_formula(value: list[Any]) -> bool:
    """Whether it is an expression over readings, of words with a number or a name each."""
    return all(
        isinstance(step, list)
        and len(step) == 2
        and isinstance(step[0], str)
        and (isinstance(step[1], str) or _is_number(step[1]))
        for step in value
    )


def _is_number(value: Any) -> bool:
    # Not isinstance: true and false would be numbers.
    return type(value) in (int, float) and abs(value) < 1e300 and isfinite(value)


def _are_strings(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(each, str) for each in value)
