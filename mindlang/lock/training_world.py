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
from typing import Annotated, Any, NoReturn

from msgspec import Meta, Struct, ValidationError, convert, defstruct, field

HEADING = re.compile(r"world (?P<name>[0-9a-f]{16})")
MOST_FACT_CHARACTERS = 1 << 20
_FACT = re.compile(r"  (?P<subject>[^\s=]+(?: [^\s=]+)?) = (?P<value>.+)")


class KindForm:
    """A kind as `mindrun.graph.codec` says it: its name and its arguments."""


class ArgumentForm:
    """An argument of a kind, in one of the forms ARGUMENTS."""


def _table(name: str, *fields: Any) -> type[Struct]:
    return defstruct(name, fields, forbid_unknown_fields=True)


Number = Annotated[float, Meta(gt=-1e300, lt=1e300)]
ARGUMENTS: tuple[Any, ...] = (
    None | bool | str | Number | _table("Span", ("first", Number), ("last", Number), ("by", Number | None)),
    list[Number],
    list[str],
    list[tuple[Number, Number]],
    list[list[tuple[Number, Number]]],
    list[tuple[str, str | Number]],  # an expression over readings, of words with a number or a name each
)
SKILL = dict[str, str | list[str] | dict[str, str]]  # the files that a procedure uses have a hash each
NAMED = {**dict.fromkeys(("actuator", "memory", "sensor", "thing"), KindForm), "skill": SKILL}
_MAYBE: tuple[Any, ...] = (("succeeds", list[str], field(default=[])), ("opens", list[str], field(default=[])))
FORMS = {
    "tick": Annotated[float, Meta(gt=0, lt=1e300)],
    "claw": Number,
    "body": KindForm,
    "task": _table("Task", ("scene", KindForm), ("ticks", Number), ("ends", list[str]), *_MAYBE),
    "environment": _table("Environment", ("text", str)),
    "physics": _table("Physics", ("pymunk", str), ("world", int)),
    "start": _table("Start", ("at", ArgumentForm), ("facing", ArgumentForm)),
    "varying": list[str],
    "rewards": list[tuple[str, str]],
    "lesson": _table(
        "Lesson",
        *(("task", str), ("master", str), ("with_subskills", bool), ("from_scratch", bool), ("learner", KindForm)),
        ("starts_from", str, ""),
        ("hard", str, ""),
    ),
}  # what a fact may be, by its subject or, of those with a name, by the noun in NAMED


@dataclass(frozen=True, slots=True)
class LessonKey:
    """The key of a lesson: a skill can be taught on several tasks, under several masters, alone or `jointly`."""

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
        lesson = self.facts["lesson"]
        return LessonKey(lesson["task"], lesson["master"], lesson["with_subskills"])

    def text(self) -> str:
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
    noun, _, name = subject.partition(" ")
    form = (NAMED if name else FORMS).get(noun)
    if form is None or not _fits(value, form):
        raise ValueError(f"{subject} cannot be so")
    return value


def _no_number(text: str) -> NoReturn:
    raise ValueError(f"{text} is no number")


def _fits(value: Any, form: Any) -> bool:
    try:
        convert(value, form, dec_hook=_checked)
    except (ValidationError, OverflowError):
        return False
    return True


def _checked(form: type[KindForm | ArgumentForm], value: Any) -> KindForm | ArgumentForm:
    """An instance of the form, once the value is checked to be a kind or an argument; ValueError where it is none."""
    if form is ArgumentForm:
        is_one = any(_fits(value, each) for each in ARGUMENTS)
    else:
        is_named = isinstance(value, dict) and isinstance(value.get("is"), str)
        is_one = is_named and all(_fits(argument, ArgumentForm) for argument in value.values())
    if not is_one:
        raise ValueError("it cannot be so")
    return form()
