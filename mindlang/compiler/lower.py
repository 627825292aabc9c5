"""Mind → Graph: names become indices, expressions programs, skills stand in the order of influence."""

from collections.abc import Mapping
from typing import Any, TypeVar

from mindrun import graph

from mindlang.compiler import model
from mindlang.compiler.format import spaced
from mindlang.compiler.hierarchy import in_order
from mindlang.compiler.syntax import Operator

T = TypeVar("T")


def lower(mind: model.Mind) -> graph.Graph:
    """The compiled graph of a mind."""
    sensors = _sensors(mind)
    start = sum(sensor.width for sensor in sensors)
    memories = tuple(
        graph.Memory(memory.name, memory.kind, start + index) for index, memory in enumerate(mind.memories)
    )
    places = {sensor.name: (sensor.start, sensor.width) for sensor in sensors}
    places |= {memory.name: (memory.start, 1) for memory in memories}
    return graph.Graph(
        mind.tick,
        mind.body.kind,
        mind.master,
        sensors,
        memories,
        tuple(graph.Actuator(actuator.name, actuator.kind) for actuator in mind.actuators),
        _skills(mind, places),
        tuple(_task(task, places) for task in mind.tasks),
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
    order = in_order(mind.skills)
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
        target = targets[edge.to][edge.target]
        if edge.at is None:
            edges.append(graph.Edge(edge.to, target, outputs))
            outputs += 1
        else:
            edges.append(graph.Edge(edge.to, target, None, _program(edge.at, places, {})))
    return tuple(edges)


def _task(task: model.Task, places: Mapping[str, tuple[int, int]]) -> graph.Task:
    events: dict[Any, int] = {}
    measures: dict[Any, int] = {}
    ends = tuple(dict.fromkeys(_index(event, events) for event in task.ends))
    rewards = tuple(_reward(reward, events, measures, places) for reward in task.rewards)
    counts = tuple(dict.fromkeys(_index(event, events) for event in task.counts))
    things = tuple(graph.Thing(thing.name, thing.kind) for thing in task.things)
    return graph.Task(
        task.name, task.scene, things, task.ticks, tuple(measures), tuple(events), ends, rewards, counts
    , task.start)  # fmt: skip


def _index(value: T, known: dict[T, int]) -> int:
    """The place of a value among the known ones, to which it is added."""
    return known.setdefault(value, len(known))


def _reward(
    reward: model.Reward, events: dict[Any, int], measures: dict[Any, int], places: Mapping[str, tuple[int, int]]
) -> graph.Reward:
    return graph.Reward(
        spaced(reward.fact.span.text),
        _program(reward.amount, places, measures),
        None if reward.on is None else _index(reward.on, events),
        None if reward.each is None else places[reward.each],
        None if reward.when is None else _condition(reward.when, places, measures),
    )


def _condition(
    when: model.Condition, places: Mapping[str, tuple[int, int]], measures: dict[Any, int]
) -> graph.Condition:
    return graph.Condition(_program(when.left, places, measures), when.compare, _program(when.right, places, measures))


def _program(
    expression: model.Expression, places: Mapping[str, tuple[int, int]], measures: dict[Any, int]
) -> graph.Program:
    def instruction(term: model.Term) -> tuple[str, float | int]:
        match term:
            case model.Number():
                return "number", term.value
            case model.Reading():
                return "reading", places[term.name][0]
            case model.EachReading():
                return "each", 0
            case model.Measured():
                return "measure", _index(term.measure, measures)
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
    )
