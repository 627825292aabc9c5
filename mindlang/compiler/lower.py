"""Mind → Graph: names become indices, expressions programs, skills stand in the order of influence."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, TypeVar

from mindrun.graph import graph

from mindlang.compiler import model
from mindlang.compiler.format import spaced
from mindlang.compiler.hierarchy import in_order
from mindlang.compiler.syntax import Operator

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Places:
    """Where what expressions name stands: readings as (start, width), actuators, and measures, to which more come."""

    readings: Mapping[str, tuple[int, int]]
    actuators: Mapping[str, int] = field(default_factory=dict)
    measures: dict[Any, int] = field(default_factory=dict)


def lower(mind: model.Mind) -> graph.Graph:
    """The compiled graph of a mind."""
    sensors = _sensors(mind)
    start = sum(sensor.width for sensor in sensors)
    memories = tuple(
        graph.Memory(memory.name, memory.kind, start + index) for index, memory in enumerate(mind.memories)
    )
    places = {sensor.name: (sensor.start, sensor.width) for sensor in sensors}
    places |= {memory.name: (memory.start, 1) for memory in memories}
    commands = {actuator.name: index for index, actuator in enumerate(mind.actuators)}
    return graph.Graph(
        mind.tick,
        mind.body.kind,
        mind.master,
        sensors,
        memories,
        tuple(graph.Actuator(actuator.name, actuator.kind) for actuator in mind.actuators),
        _skills(mind, places),
        tuple(_task(task, places, commands) for task in mind.tasks),
        tuple(_lesson(lesson) for lesson in mind.lessons),
    )


def _sensors(mind: model.Mind) -> tuple[graph.Sensor, ...]:
    sensors: list[graph.Sensor] = []
    start = 0
    for sensor in mind.sensors:
        sensors.append(graph.Sensor(sensor.name, sensor.kind, start, sensor.width))
        start += sensor.width
    return tuple(sensors)


def _skills(mind: model.Mind, places: Mapping[str, tuple[int, int]]) -> tuple[graph.Skill, ...]:
    skills = {skill.name: skill for skill in mind.skills}
    order = [skills[name] for name in in_order(mind.influences)]
    targets = {
        "skill": {skill.name: index for index, skill in enumerate(order)},
        "actuator": {actuator.name: index for index, actuator in enumerate(mind.actuators)},
        "memory": {memory.name: index for index, memory in enumerate(mind.memories)},
    }
    return tuple(
        graph.Skill(
            skill.name,
            skill.function,
            tuple(start + i for start, width in (places[read] for read in skill.reads) for i in range(width)),
            _edges(skill, targets, places),
            skill.frozen,
            skill.like,
        )
        for skill in order
    )


def _edges(
    skill: model.Skill, targets: Mapping[str, Mapping[str, int]], places: Mapping[str, tuple[int, int]]
) -> tuple[graph.Edge, ...]:
    edges: list[graph.Edge] = []
    outputs = 0
    for edge in skill.edges:
        value = () if edge.at is None else _program(edge.at, Places(places))
        gate = _gate(edge.gate, Places(places)) if edge.gate else None
        output = outputs if edge.at is None else None
        edges.append(graph.Edge(edge.to, targets[edge.to][edge.target], output, value, gate, edge.cuts))
        outputs += edge.at is None
    return tuple(edges)


def _gate(gate: model.Gate, places: Places) -> graph.Gate:
    otherwise = None if gate.otherwise is None else _program(gate.otherwise, places)
    return graph.Gate(condition(gate.when, places), otherwise)


def _task(task: model.Task, readings: Mapping[str, tuple[int, int]], actuators: Mapping[str, int]) -> graph.Task:
    events: dict[Any, int] = {}
    places = Places(readings, actuators, {})
    ends = tuple(dict.fromkeys(_end(end, events, places) for end in task.ends))
    rewards = tuple(_reward(reward, events, places) for reward in task.rewards)
    counts = tuple(dict.fromkeys(_index(event, events) for event in task.counts))
    things = tuple(graph.Thing(thing.name, thing.kind) for thing in task.things)
    return graph.Task(
        task.name, task.scene, things, task.ticks, tuple(places.measures), tuple(events), ends, rewards, counts
    , task.start, task.varies, task.fails)  # fmt: skip


def _end(end: model.End, events: dict[Any, int], places: Places) -> graph.End:
    event = None if end.event is None else _index(end.event, events)
    if end.when is None:
        return graph.End(event, end.times, None, end.succeeds)
    text = spaced(f"ends {end.when.span.text}").removeprefix("ends when ")
    return graph.End(event, end.times, condition(end.when, places), end.succeeds, text)


def _index(value: T, known: dict[T, int]) -> int:
    """The place of a value among the known ones, to which it is added."""
    return known.setdefault(value, len(known))


def _reward(reward: model.Reward, events: dict[Any, int], places: Places) -> graph.Reward:
    return graph.Reward(
        spaced(reward.fact.span.text),
        _program(reward.amount, places),
        None if reward.on is None else _index(reward.on, events),
        None if reward.each is None else places.readings[reward.each],
        None if reward.when is None else condition(reward.when, places),
    )


def condition(when: model.When, places: Places) -> graph.Program:
    """All comparisons of an alternative one after the other, each but the first with `and`; so with `or`."""
    found: list[tuple[str, float | int]] = []
    for number, all_ in enumerate(when.alternatives):
        for place, each in enumerate(all_):
            found += [*_program(each.left, places), *_program(each.right, places), (each.compare, 0)]
            found += [("and", 0)] if place else []
        found += [("or", 0)] if number else []
    return tuple(found)


def _program(expression: model.Expression, places: Places) -> graph.Program:
    def instruction(term: model.Term) -> tuple[str, float | int]:
        match term:
            case model.Number():
                return "number", term.value
            case model.Reading():
                return "reading", places.readings[term.name][0]
            case model.EachReading():
                return "each", 0
            case model.Command():
                return "command", places.actuators[term.name]
            case model.Measured():
                return "measure", _index(term.measure, places.measures)
            case Operator():
                return term.symbol, 0

    return tuple(instruction(term) for term in expression.terms)


def _lesson(lesson: model.Lesson) -> graph.Lesson:
    return graph.Lesson(
        lesson.curriculum,
        lesson.skill,
        lesson.task,
        lesson.master,
        lesson.generations,
        lesson.from_scratch,
        lesson.with_subskills,
        lesson.learner,
        lesson.number,
        lesson.starts_from,
        lesson.needs,
    )
