"""Differences in meaning between two minds; spacing, comments and order are none."""

from collections import defaultdict, deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from difflib import SequenceMatcher
from operator import attrgetter
from typing import Any

from msgspec import Struct

from mindlang.compiler import syntax
from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.families import said
from mindlang.compiler.format import spaced
from mindlang.compiler.model import Lesson, Mind, Part, Skill, Task
from mindlang.compiler.names import Names
from mindlang.compiler.resolve.kinds import Scope, make_kind

PLACES = {"span", "fact", "declaration", "curriculum"}  # fields of the model that say where a thing stands
ORDERED = {"curriculum"}  # nouns whose lines mean something by their order


@dataclass(frozen=True, slots=True)
class MindDifference:
    """A declaration or a setting that is new, gone, or changed: lines of it that are new and that are gone, as written.

    A declaration that is itself new or gone has its header among them.
    """

    what: str
    gone: tuple[str, ...]
    new: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class _Line:
    """A line as it is written, but for its spaces, and what it means."""

    text: str
    meaning: Any


def mind_differences(old: Mind, new: Mind) -> list[MindDifference]:
    """The declarations that differ between two minds, noun by noun.

    Nothing for comments, spaces, other spellings and the order of lines, but for the lessons of a curriculum.
    """
    found = [*_settings(old, new)]
    before_maps, after_maps = _drawn(old), _drawn(new)
    for name in before_maps.keys() & after_maps.keys():
        found += _difference(f"map {name}", before_maps[name], after_maps[name], ordered=True)
    before, after = _declared(old), _declared(new)
    for noun in syntax.NOUNS:
        for name in dict.fromkeys((*before[noun], *after[noun])):
            lines = before[noun].get(name, ()), after[noun].get(name, ())
            found += _difference(f"{noun} {name}", *lines, noun in ORDERED)
    return found


def _settings(old: Mind, new: Mind) -> Iterator[MindDifference]:
    if old.master != new.master:
        yield MindDifference("master", (f"master {old.master}",), (f"master {new.master}",))
    for name, value in old.numbers.items():
        if name in new.numbers and new.numbers[name] != value:
            before, after = (_written(mind.names.numbers[name]) for mind in (old, new))
            yield MindDifference(f"number {name}", (before,), (after,))
    if old.unit_metres != new.unit_metres:
        lengths = ([] if mind.unit_metres is None else [mind.unit_metres] for mind in (old, new))
        yield MindDifference("unit", *(tuple(f"unit {100 * metres:.6g} cm" for metres in said) for said in lengths))
    if old.tick != new.tick:
        yield MindDifference("tick", (f"tick {old.tick:.6g} s",), (f"tick {new.tick:.6g} s",))


def _drawn(mind: Mind) -> dict[str, list[_Line]]:
    """The lines of each map by the name of its file."""
    found = {}
    for task in mind.tasks:
        for fact, thing in zip(syntax.of_form(task.facts, syntax.Contains), task.things, strict=True):
            for value in (argument.value for argument in fact.phrase.arguments):
                if isinstance(value, syntax.Text):
                    found[value.text] = [_Line(line, line) for line in thing.kind.drawing]
    return found


def _difference(what: str, old: Sequence[_Line], new: Sequence[_Line], ordered: bool) -> Iterator[MindDifference]:
    before, after = _numbered(old, new)
    kept = set(before) & set(after)
    if ordered:  # only what stands in the same order in both
        blocks = SequenceMatcher(None, before, after, autojunk=False).get_matching_blocks()
        kept = {number for block in blocks for number in before[block.a : block.a + block.size]}
    gone = tuple(line.text for line, number in zip(old, before, strict=True) if number not in kept)
    come = tuple(line.text for line, number in zip(new, after, strict=True) if number not in kept)
    if gone or come:
        yield MindDifference(what, gone, come)


def _numbered(old: Sequence[_Line], new: Sequence[_Line]) -> tuple[list[int], list[int]]:
    """Numbers of old and of new lines; an old and a new line that match, in text or else in meaning, share a number."""
    after: dict[int, int] = {}
    for sameness in (attrgetter("text"), attrgetter("meaning")):
        paired, alike = {*after.values()}, defaultdict[Any, deque[int]](deque)
        for number, line in enumerate(old):
            if number not in paired:
                alike[sameness(line)].append(number)
        for place, line in enumerate(new):
            if place not in after and alike[sameness(line)]:
                after[place] = alike[sameness(line)].popleft()
    return list(range(len(old))), [after.get(place, len(old) + place) for place in range(len(new))]


def _declared(mind: Mind) -> dict[str, dict[str, list[_Line]]]:
    """The lines of every declaration, by noun and name; a scene means what the tasks in it say."""
    lessons: dict[str, list[Lesson]] = {}
    for lesson in sorted(mind.lessons, key=lambda lesson: lesson.fact.span.start):
        lessons.setdefault(lesson.curriculum, []).append(lesson)
    parts: Mapping[str, Iterable[Any]] = {
        "body": (mind.body,), "actuator": mind.actuators, "sensor": mind.sensors, "memory": mind.memories,
        "skill": mind.skills, "task": mind.tasks,
    }  # fmt: skip
    become = {noun: {part.name: part for part in of} for noun, of in parts.items()} | {"curriculum": lessons}
    return {
        noun: {
            name: _lines(declaration, become[noun].get(name), mind)
            for name, declaration in (mind.names.declarations(noun) if noun in become else ())
        }
        for noun in syntax.NOUNS
    }


def _lines(declaration: syntax.Declaration, of: Any, mind: Mind) -> list[_Line]:
    """The header and the facts of a declaration, each with its meaning in the model.

    Of a task also what its scene says, or the task that it is like.
    """
    kind, facts = _parts(declaration.header, of)
    found = [_Line(_header(declaration.header, mind.names), _meaning(kind))]
    said = of.facts if isinstance(of, Task) else declaration.facts
    for verbs, meanings in facts.items():
        written = [fact for fact in said if syntax.verb_of(fact) in verbs.split()]
        found += [_Line(_written(fact), (verbs, _meaning(each))) for fact, each in zip(written, meanings, strict=True)]
    return found


def _parts(header: syntax.Header, of: Any) -> tuple[Any, dict[str, Sequence[Any]]]:
    """The resolved header of a declaration, and the values that its facts have become, by verb and in their order."""
    match of:
        case Skill(like=like) if like:
            lines = (fact for fact in of.declaration.facts if isinstance(fact, syntax.Reads | syntax.Sends))
            instead = [(syntax.verb_of(f), f.name.text, f.stands_for and f.stands_for.text) for f in lines]
            return like, {"reads drives influences": instead, **_promised(of)}
        case Skill():
            how = {"chooses": [True] * of.chooses, "stays": [True] * of.frozen, "uses": of.files}
            return of.function, {"reads": of.reads, "drives influences": of.edges, **how, **_promised(of)}
        case Task():
            starts = [of.start] * bool(syntax.of_form(of.facts, syntax.Starts))
            judged = {"lasts": [of.ticks], "ends succeeds opens": of.ends, "rewards": of.rewards, "counts": of.counts}
            world = {"contains": of.things, "starts": starts, "draws": of.draws, "varies": of.varies, "fails": of.fails}
            return of.scene, judged | world
        case Part():
            return of.kind, {}
    phrase = header.phrase
    return phrase and make_kind("curriculum", phrase, Scope(Names({}), None), Findings()), {"teaches": of or []}


def _promised(skill: Skill) -> dict[str, Sequence[Any]]:
    """Each of what a skill promises, by the verb of its line."""
    found: dict[str, list[Any]] = {}
    for each in skill.promises:
        found.setdefault(syntax.verb_of(each.fact), []).append(each)
    return {**found}


def _header(header: syntax.Header, names: Names) -> str:
    """A header as it is written; of a task in a scene by its name, with what that scene is."""
    said = header
    while header.noun.text == "task" and not said.phrase:
        noun, other = ("scene", said.inside) if said.inside else (said.noun.text, said.like)
        said = names.table[noun][other.text if other else ""].header
    return _written(header) if said is header else f"task {header.name.text} in {_written(said.phrase)}"


def _written(node: Any) -> str:
    return spaced(said(node))


def _meaning(node: Any) -> Any:
    """A part of the model without its places."""
    if isinstance(node, tuple):
        return tuple(map(_meaning, node))
    if not isinstance(node, Struct) and not is_dataclass(node):
        return node
    names = node.__struct_fields__ if isinstance(node, Struct) else [field.name for field in fields(node)]
    return (type(node).__name__, *(_meaning(getattr(node, name)) for name in names if name not in PLACES))
