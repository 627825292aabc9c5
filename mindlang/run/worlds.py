"""Worlds in which a mind was not taught: its task with one number changed, by a quarter or as bad as on a robot."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import Any, NamedTuple

from mindrun.graph.codec import encode
from mindrun.graph.graph import Graph, Task, Variation
from mindrun.graph.measured import measured_in_world
from mindrun.graph.validate import graph_flaw
from mindrun.kinds.registry import arguments, names, varying_of
from mindrun.numbers.quantity import ANGLE, COUNT, NUMBER, RATIO, TICKS, UNSAID, Quantity, Span, fits

from mindlang.lock.world_facts import argument
from mindlang.run.comparison import SCORE, SUCCESS

AS_TAUGHT = "as taught"
SCALED_SHARES = (0.75, 1.25)  # of what a number is as taught
WEAKER_SHARE = 0.9  # the share of one of several actuators, while the others are as taught
ADDED_SHARES = {"noise": 0.05, "lost": 0.05, "slip": 0.2}
LATE_SECONDS = 0.1  # of delay
NUMBER_DIGITS = 12  # of a number, so that 0.75 × 3.3 is 2.475
TOGETHER = ("lost", "delay")  # of all sensors or all actuators at once; other numbers only of those of one kind
REGISTERED = {"scene": "task", "thing": "content"}  # nouns that the registry has under another name

Change = tuple[float, float]  # what a number is multiplied by, and what is added to it


class Part(NamedTuple):
    """A scene, thing, body, actuator or sensor, as its noun says; a scene and a body have no name."""

    noun: str
    name: str
    kind: Any


@dataclass(frozen=True, slots=True)
class World:
    """A world that differs from the one as taught in one number, of one part or of several alike.

    Each of the `changes` has the `noun` and `name` of a part, and an argument as a file has it: as it `was`, and `now`.
    """

    name: str
    changes: tuple[Mapping[str, str], ...]
    graph: Graph


def worlds(graph: Graph, task: Task, master: str) -> list[World]:
    """The world as taught, then each in which a number of a task differs; none that no file could say."""
    found = {AS_TAUGHT: World(AS_TAUGHT, (), graph)}
    for (who, field, change), parts in _groups(graph, task, master).items():
        if (world := _changed(graph, task, parts, field, change, who)) and _is_possible(world.graph, task.name):
            found.setdefault(world.name, world)
    return [*found.values()]


def _is_possible(graph: Graph, name: str) -> bool:
    """True if a task may be so: it has room for all that it says, and not more than a world takes."""
    task = next(each for each in graph.tasks if each.name == name)
    has_room = task.start.at is None or task.scene.has_room(task.start.at, graph.body.radius)
    return has_room and not any(thing.kind.mistake(task.scene) for thing in task.things) and not graph_flaw(graph)


def _groups(graph: Graph, task: Task, master: str) -> dict[tuple[str, str, Change], list[Part]]:
    """Who changes in one world, in which argument and how: parts of one kind, or all of a noun; and one part alone."""
    found: dict[tuple[str, str, Change], list[Part]] = {}
    added = ADDED_SHARES | {"delay": round(LATE_SECONDS / graph.tick)}
    for part in _parts(graph, task, master):
        for field in _numbers(part):
            for change in [(1.0, added[field])] if field in added else [(share, 0.0) for share in SCALED_SHARES]:
                found.setdefault((_who(part, field), field, change), []).append(part)
    for (_, field, change), parts in [*found.items()]:
        if change[0] < 1 and len(parts) > 1 and parts[0].noun == "actuator":
            found[parts[0].name, field, (WEAKER_SHARE, 0.0)] = parts[:1]
    return found


def _parts(graph: Graph, task: Task, master: str) -> Iterator[Part]:
    """All that is in a task's world, the body, what moves, and what a run measures."""
    yield Part("scene", "", task.scene)
    yield from (Part("thing", each.name, each.kind) for each in task.things)
    if not task.scene.environment:
        yield Part("body", "", graph.body)
    yield from (Part("actuator", each.name, each.kind) for each in graph.actuators)
    measured = measured_in_world(graph, master, task)
    yield from (Part("sensor", each.name, each.kind) for each in measured if varying_of(each.kind))


def _numbers(part: Part) -> Iterator[str]:
    """The arguments of a part that may be others elsewhere: lengths, forces and their like, and imperfections.

    A late sensor is left out: where all are late nothing differs from late actuators. So is how many things there are
    to be reached: that is another task.
    """
    for each in arguments(type(part.kind)):
        is_measure = isinstance(each.type, Quantity) and each.type not in (RATIO, TICKS, ANGLE, NUMBER, COUNT)
        is_said = each.shape in ("one", "span", "extent") and getattr(part.kind, each.field) != UNSAID
        is_late = each.field == "delay" and part.noun == "actuator"
        if each.field in ADDED_SHARES or is_late or (is_measure and is_said):
            yield each.field


def _who(part: Part, field: str) -> str:
    """The name for all parts that change together."""
    if part.noun in ("thing", "body"):
        return part.name or part.noun
    return f"{part.noun}s" if field in TOGETHER else names()[type(part.kind)]


def _number(value: Any, factor: float, plus: float) -> Any:
    """A number, span or extent that is multiplied and added to; whole numbers stay whole."""
    match value:
        case Span(first, last, by):
            return Span(_number(first, factor, plus), _number(last, factor, plus), by and _number(by, factor, plus))
        case tuple():
            return tuple(_number(each, factor, plus) for each in value)
        case int():
            return round(value * factor + plus)
    return float(f"{value * factor + plus:.{NUMBER_DIGITS}g}")


def _changed(graph: Graph, task: Task, parts: Sequence[Part], field: str, change: Change, who: str) -> World | None:
    """The world in which an argument of some parts is another; None where none is, or one would not be allowed."""
    kinds, told = dict[tuple[str, str], Any](), list[dict[str, str]]()
    drawn: dict[tuple[str, str, str], Variation] = {(each.noun, each.of, each.argument): each for each in task.varies}
    for part in parts:
        number = next(each for each in arguments(type(part.kind)) if each.field == field)
        variation = drawn.get((part.noun, part.name, field))
        was = Span(variation.low, variation.high) if variation else getattr(part.kind, field)
        now = _number(was, *change)
        if variation:
            drawn[part.noun, part.name, field] = replace(variation, low=now.first, high=now.last)
        else:
            kinds[part.noun, part.name] = replace(part.kind, **{field: now})
        if not fits(number.type, now):
            return None
        if was != now:
            of = REGISTERED.get(part.noun, part.noun), names()[type(part.kind)], field
            texts = {"was": argument(*of, encode(was)), "now": argument(*of, encode(now))}
            told.append({"noun": part.noun, "name": part.name, **texts})
    if not told:
        return None

    def other(noun: str, of: tuple[Any, ...]) -> tuple[Any, ...]:
        return tuple(replace(each, kind=kinds.get((noun, each.name), each.kind)) for each in of)

    scene, things = kinds.get(("scene", ""), task.scene), other("thing", task.things)
    changed = replace(task, scene=scene, things=things, varies=tuple(drawn.values()))
    world = replace(
        graph,
        body=kinds.get(("body", ""), graph.body),
        sensors=other("sensor", graph.sensors),
        actuators=other("actuator", graph.actuators),
        tasks=tuple(changed if each.name == task.name else each for each in graph.tasks),
    )
    others = " …" * any(each["now"] != told[0]["now"] for each in told)
    return World(f"{who} {told[0]['now']}{others}", tuple(told), world)


def figure(found: Mapping[str, Any]) -> tuple[str, float | None, float | None]:
    """The name, the mean and the standard error of what a mind is measured by, in many runs as `bench_data` has them.

    It is the first event that its task counts, or the share of success, or the score.
    """
    score = {"mean": found["score_mean"], "standard_error": found["score_standard_error"]}
    success = {SUCCESS: found[SUCCESS]} if SUCCESS in found else {}
    name, spread = next(iter({**found["by_event"], **success, SCORE: score}.items()))
    return name, spread["mean"], spread["standard_error"]


def world_rows(found: Mapping[str, Mapping[str, Mapping[str, Any]]]) -> list[dict[str, Any]]:
    """What minds did in worlds, by world and mind, as taught first, then where any of them loses most of its figure.

    `of_as_taught` is the share of the figure that is left, None where that was not above 0 or is no number.
    """
    taught = {name: figure(data)[1] for name, data in found[AS_TAUGHT].items()}
    rows = []
    for world, minds in found.items():
        losses, each = [], []
        for name, data in minds.items():
            was, now = taught[name], figure(data)[1]
            share = now / was if now is not None and was is not None and was > 0 else None
            losses.append(inf if now is None or was is None else (was - now) / (abs(was) or 1))
            each.append({"name": name, **data, "of_as_taught": share})
        rows.append((world != AS_TAUGHT, -max(losses), {"world": world, "minds": each}))
    return [row for *_, row in sorted(rows, key=lambda row: row[:2])]
