"""Mind → Graph: names become indices, expressions programs, skills stand in the order of influence."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, fields
from itertools import accumulate, count
from typing import Any, TypeVar

from mindrun.graph import graph
from mindrun.kinds.events.event import EventKind

from mindlang.compiler import model
from mindlang.compiler.families import said
from mindlang.compiler.format import spaced
from mindlang.compiler.hierarchy import topological_order
from mindlang.compiler.names import DRIVABLE_NOUNS
from mindlang.compiler.syntax import VERBS, Expression, Rewards, When, verb_of

GOALS_MET = "all goals met"  # the end of a run with goals

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Places:
    """Indices of the names in expressions: readings as (start, width), actuators, what a task draws, and measures.

    Measures, events and tallies are added to.
    """

    readings: Mapping[str, tuple[int, int]]
    actuators: Mapping[str, int] = field(default_factory=dict)
    measures: dict[Any, int] = field(default_factory=dict)
    draws: Mapping[Any, int] = field(default_factory=dict)
    events: dict[Any, int] = field(default_factory=dict)
    tallies: dict[Any, int] = field(default_factory=dict)


def lower(mind: model.Mind) -> graph.Graph:
    """The compiled graph of a mind."""
    starts = [*accumulate((sensor.width for sensor in mind.sensors), initial=0)]
    placed = zip(mind.sensors, starts[:-1], strict=True)
    sensors = [graph.Sensor(each.name, each.kind, start, each.width) for each, start in placed]
    begins = accumulate((memory.kind.kept for memory in mind.memories), initial=starts[-1])
    memories = [graph.Memory(each.name, each.kind, place) for each, place in zip(mind.memories, begins, strict=False)]
    readings = {sensor.name: (sensor.start, sensor.width) for sensor in sensors}
    readings |= {memory.name: (memory.start, memory.kind.width) for memory in memories}
    commands = _numbered(actuator.name for actuator in mind.actuators)
    return graph.Graph(
        mind.tick,
        mind.body.kind,
        mind.master,
        tuple(sensors),
        tuple(memories),
        tuple(graph.Actuator(actuator.name, actuator.kind) for actuator in mind.actuators),
        tuple(_skills(mind, readings)),
        tuple(_task(task, Places(readings, commands, {}, _numbered(task.draws))) for task in mind.tasks),
        tuple(graph.Lesson(*(getattr(each, of.name) for of in fields(graph.Lesson))) for each in mind.lessons),
    )


def _numbered(names: Iterable[T]) -> dict[T, int]:
    return {name: number for number, name in enumerate(names)}


def _skills(mind: model.Mind, readings: Mapping[str, tuple[int, int]]) -> Iterator[graph.Skill]:
    skills, order = {skill.name: skill for skill in mind.skills}, topological_order(mind.influences)
    numbers = {
        "skill": _numbered(order),
        "actuator": _numbered(actuator.name for actuator in mind.actuators),
        "memory": _numbered(memory.name for memory in mind.memories),
    }
    for skill in map(skills.__getitem__, order):
        places = [start + i for start, width in (readings[name] for name in skill.reads) for i in range(width)]
        edges = tuple(_edges(skill, numbers, Places(readings)))
        promises = tuple(_promise(each, Places(readings)) for each in skill.promises)
        said = skill.frozen, skill.like, skill.chooses, promises, tuple(sorted(skill.files))
        yield graph.Skill(skill.name, skill.function, tuple(places), edges, *said)


def _promise(promise: model.Promise, places: Places) -> graph.Promise:
    word: Any = verb_of(promise.fact)
    return graph.Promise(word, promise.text, program_of(promise.when, places))


def _edges(skill: model.Skill, numbers: Mapping[str, Mapping[str, int]], places: Places) -> Iterator[graph.Edge]:
    outputs = count()
    for edge in skill.edges:
        gate = None
        if edge.gate:
            otherwise = program_of(edge.gate.otherwise, places) if edge.gate.otherwise else None
            gate = graph.Gate(program_of(edge.gate.when, places), otherwise)
        output, value = (None, program_of(edge.at, places)) if edge.at else (next(outputs), ())
        over: list[graph.Sink] = [
            (noun, numbers[noun][name]) for name in edge.over for noun in DRIVABLE_NOUNS if name in numbers[noun]
        ]
        yield graph.Edge(edge.to, numbers[edge.to][edge.target], output, value, gate, edge.cuts, tuple(sorted(over)))


def _task(task: model.Task, places: Places) -> graph.Task:
    events = places.events
    ends = tuple(dict.fromkeys(_end(end, events, places) for end in task.ends))
    rewards = tuple(_reward(reward, events, places) for reward in task.rewards)
    counts = tuple(dict.fromkeys(_event(event, events) for event in task.counts))
    whens = ((each, program_of(each.when, places) if each.when else ()) for each in task.things)
    things = tuple(graph.Thing(each.name, each.kind, when, each.by, each.many, each.master) for each, when in whens)
    return graph.Task(
        task.name, task.scene, things, task.ticks, tuple(places.measures), tuple(events), ends, rewards, counts
    , task.start, task.varies, task.fails, task.draws, tuple(places.tallies))  # fmt: skip


def _end(end: model.End, events: dict[Any, int], places: Places) -> graph.End:
    event = None if end.event is None else _event(end.event, events)
    if end.when is None:
        return graph.End(event, end.times, None, end.succeeds, opens=end.opens)
    if said(end.fact).startswith(verb_of(end.fact)):
        text = spaced(f"ends {said(end.fact.when)}").removeprefix("ends when ")
    else:  # of a goal
        text = GOALS_MET if end.succeeds else spaced(said(end.fact))
    return graph.End(event, end.times, program_of(end.when, places), end.succeeds, text, end.opens)


def _event(event: EventKind, known: dict[Any, int]) -> int:
    """The place of an event among the known ones, to which it is added, and so is the one that it comes soon after."""
    found = _index(event, known)
    if event.within:
        _index(event.within.of, known)
    return found


def _index(value: T, known: dict[T, int]) -> int:
    """The place of a value among the known ones, to which it is added."""
    return known.setdefault(value, len(known))


def _reward(reward: model.Reward, events: dict[Any, int], places: Places) -> graph.Reward:
    return graph.Reward(
        _reward_text(reward.fact),
        program_of(reward.amount, places),
        None if reward.on is None else _event(reward.on, events),
        None if reward.each is None else places.readings[reward.each],
        None if reward.when is None else program_of(reward.when, places),
        bool(reward.fact.final),
    )


def _reward_text(fact: Rewards) -> str:
    """The line of a reward; of a goal the goal, or what it pays for being near to what that wants."""
    text = spaced(said(fact))
    return text if text.partition(" ")[0] in VERBS else f"near to {text}"


def program_of(expression: Expression | When, places: Places) -> graph.Program:
    """An expression or a condition as a postfix program."""

    def placed(word: str, operand: Any) -> tuple[str, float | int]:
        match word:
            case "reading":
                return word, places.readings[operand][0]
            case "command":
                return word, places.actuators[operand]
            case "drawn":
                return word, places.draws[operand]
            case "measure":
                return word, _index(operand, places.measures)
            case "tally":
                event = None if operand.event is None else _event(operand.event, places.events)
                when = None if operand.when is None else program_of(operand.when, places)
                of = None if operand.value is None else program_of(operand.value, places)
                return word, _index(graph.Tally(event, when, operand.word.text == "longest", of), places.tallies)
        return word, operand

    return tuple(placed(*instruction) for instruction in expression.formula)
