"""The mind's rows of the tables: skills and their edges, sensors, actuators, memories."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun import actuators, sensors
from mindrun.functions import Mlp, Procedure
from mindrun.graph import Actuator, Graph, Sensor, Skill, Task
from mindrun.memory import Cell
from mindrun.sim.codes import (
    BATTERY,
    BEARING,
    CONTACT,
    DERIVATIVE,
    GRIPPER,
    HELD,
    INERTIAL,
    INERTIAL_TICKS,
    INSIDE,
    MLP,
    PROCEDURE,
    RANGE,
    RULE,
    SERVO,
    SINE,
    WHEEL_LEFT,
    WHEEL_RIGHT,
)  # fmt: skip
from mindrun.sim.programs import Programs
from mindrun.sim.task_rows import things_of
from mindrun.weights import genes, weights_of

Array = NDArray[Any]
Floats = NDArray[np.float32]


def skill_rows(
    graph: Graph,
    reached: Sequence[Skill],
    weights: Mapping[str, Floats],
    learners: Sequence[str],
    addresses: Mapping[str, int],
    codes: Programs,
) -> tuple[list[Any], list[int], list[Any], list[Floats]]:
    """Rows of SKILL, the inputs one after the other, rows of EDGE, and the weights of the skills that do not learn.

    A learner's weights begin at a place in the genome, the others' at one in what is shared.
    """
    lengths = {skill.name: genes(skill) for skill in reached}
    starts = dict(zip(learners, np.cumsum([0, *(lengths.get(name, 0) for name in learners)]), strict=False))
    rows: list[Any] = []
    inputs: list[int] = []
    edges: list[Any] = []
    shared: list[Floats] = []
    for skill in reached:
        kind, hidden, width = _function(skill)
        own = skill.name in starts
        place = int(starts[skill.name]) if own else sum(len(part) for part in shared)
        rows.append((
            kind, graph.skills.index(skill), len(inputs), len(skill.inputs), skill.outputs, hidden, width, place,
            own, len(edges), len(skill.edges), addresses.get(skill.name, 0),
        ))  # fmt: skip
        inputs.extend(skill.inputs)
        for edge in skill.edges:
            target = edge.target + (len(graph.actuators) if edge.to == "memory" else 0)
            output = -1 if edge.output is None else edge.output
            edges.append((edge.to == "skill", target, output, *codes.add(edge.value)))
        if kind == MLP and not own:
            shared.append(weights_of(skill, weights))
    return rows, inputs, edges, shared


def _function(skill: Skill) -> tuple[int, int, int]:
    match skill.function:
        case Mlp(hidden=hidden) as mlp:
            shape = mlp.layers(len(skill.inputs), skill.outputs)
            return MLP, hidden if shape else 0, shape[0][1] if hidden and shape else 0
        case Procedure():
            return PROCEDURE, 0, 0
    return RULE, 0, 0


@dataclass(frozen=True, slots=True)
class Used:
    """The sensors that are measured: those that `skills` depend on, and those `aside` that only rewards do.

    Sources stand before what derives from them.
    """

    skills: list[Sensor]
    aside: list[Sensor]


def used_sensors(graph: Graph, reached: Sequence[Skill], task: Task) -> Used:
    """The sensors that a reached skill or a reward reads."""
    skills = _measured(graph, {row for skill in reached for row in skill.inputs})
    rewards = _measured(graph, _rewarded(task))
    return Used(skills, [sensor for sensor in rewards if sensor not in skills])


def _rewarded(task: Task) -> set[int]:
    """The readings that rewards depend on."""
    rows: set[int] = set()
    for reward in task.rewards:
        programs = [reward.amount] + ([reward.when.left, reward.when.right] if reward.when else [])
        rows |= {int(value) for program in programs for name, value in program if name == "reading"}
        rows |= set(range(reward.each[0], sum(reward.each))) if reward.each else set()
    return rows


def _measured(graph: Graph, rows: set[int]) -> list[Sensor]:
    """The sensors that have these readings, and what those derive from; sources first."""
    by_name = {sensor.name: sensor for sensor in graph.sensors}
    ordered: dict[str, Sensor] = {}
    for sensor in graph.sensors:
        if rows.intersection(range(sensor.start, sensor.start + sensor.width)):
            chain = [sensor]
            while chain[-1].kind.source in by_name:
                chain.append(by_name[chain[-1].kind.source])
            for link in reversed(chain):
                ordered.setdefault(link.name, link)
    return list(ordered.values())


@dataclass(frozen=True, slots=True)
class Sensed:
    """Rows of SENSOR, the directions [2, rays] of all rays and the reading that each writes, and how many readings.

    Those are: derived ones, rough ones, and what waits in their rings.
    """

    rows: list[Any]
    rays: Array
    ray_row: Array
    derived: int
    rough: int
    rings: int


def sensor_rows(graph: Graph, used: Used, task: Task) -> Sensed:
    """What the table of sensors says of those that are used.

    What is measured aside draws its noise from a generator of its own: a reward changes nothing in the world.
    """
    things = {thing.name: i for i, thing in enumerate(things_of(task))}
    starts = {m.name: m.start for m in graph.memories} | {s.name: s.start for s in graph.sensors}
    circular = {s.name for s in graph.sensors if s.kind.circular}
    rows: list[Any] = []
    angles: list[float] = []
    ray_row: list[int] = []
    before = held = ring = 0
    for is_aside, sensor in [(False, s) for s in used.skills] + [(True, s) for s in used.aside]:
        code, thing, source, reach, dead_zone, gain, period = _sensor(sensor, graph, things, starts)
        turns = sensor.kind.source in circular
        rows.append((
            code, sensor.start, sensor.width, thing, source, len(angles), before, turns, reach, dead_zone, gain, period,
            *_roughness(sensor, is_aside), held, ring,
        ))  # fmt: skip
        if isinstance(sensor.kind, sensors.Physical):
            held += sensor.width
            ring += sensor.width * sensor.kind.delay
        angles.extend(sensor.kind.rays)
        ray_row.extend(range(sensor.start, sensor.start + len(sensor.kind.rays)))
        before += sensor.width if code == DERIVATIVE else 0
    turn = np.array(angles, np.float64)
    directions = np.array([np.cos(turn), np.sin(turn)], np.float32)
    return Sensed(rows, directions, np.array(ray_row, np.int64), before, held, ring)


def _roughness(sensor: Sensor, is_aside: bool) -> tuple[bool, bool, float, float, float, int, int]:
    """(whether there is any, is_aside, noise, lost, what is read then or −1 for the same as before, every, delay)."""
    kind = sensor.kind
    if not isinstance(kind, sensors.Physical):
        return False, is_aside, 0.0, 0.0, 0.0, 1, 0
    blank = -1.0 if isinstance(kind, sensors.Battery) else kind.blank
    is_rough = kind.noise > 0 or kind.lost > 0 or kind.every > 1 or kind.delay > 0
    return is_rough, is_aside, kind.noise, kind.lost, blank, max(1, kind.every), kind.delay


def _sensor(
    sensor: Sensor, graph: Graph, things: Mapping[str, int], starts: Mapping[str, int]
) -> tuple[int, int, int, float, float, float, float]:
    """(code, thing or −1, source row, range, dead zone, gain, period in ticks)."""
    match sensor.kind:
        case sensors.RangeFinder(range=reach, dead_zone=zone):
            return RANGE, -1, 0, reach, zone, 0.0, 1.0
        case sensors.Bearing(of=of, range=reach, dead_zone=zone):
            return BEARING, things.get(of, -1), 0, reach or inf, zone, 0.0, 1.0
        case sensors.Contact(of=of):
            return CONTACT, things.get(of, -1), 0, 0.0, 0.0, 0.0, 1.0
        case sensors.Held(of=of):
            return HELD, things.get(of, -1), 0, 0.0, 0.0, 0.0, 1.0
        case sensors.Inside(of=of):
            return INSIDE, things.get(of, -1), 0, 0.0, 0.0, 0.0, 1.0
        case sensors.Inertial(range=reach, dead_zone=zone):
            return INERTIAL, -1, 0, 0.0, zone, 1.0 / (INERTIAL_TICKS * graph.tick * reach), 1.0
        case sensors.Battery():
            return BATTERY, -1, 0, 0.0, 0.0, 0.0, 1.0
        case sensors.Derivative(of=of, range=spread, dead_zone=zone):
            return DERIVATIVE, -1, starts[of], 0.0, zone, 0.5 / (graph.tick * spread), 1.0
        case sensors.Sine(period=period):
            return SINE, -1, 0, 0.0, 0.0, 0.0, period / graph.tick
    raise TypeError(f"the lanes have no {sensor.kind}")


def actuator_rows(graph: Graph) -> tuple[list[Any], int]:
    """Rows of ACTUATOR, and how many commands wait at any time."""
    rows: list[Any] = []
    ring = 0
    for actuator in graph.actuators:
        code, thrust, reach = _actuator(actuator)
        delay = actuator.kind.delay
        rows.append((code, thrust, actuator.kind.neutral, reach, delay, ring))
        ring += delay
    return rows, ring


def _actuator(actuator: Actuator) -> tuple[int, float, float]:
    match actuator.kind:
        case actuators.Wheel(side=side, thrust=thrust):
            return WHEEL_LEFT if side == "left" else WHEEL_RIGHT, thrust, 0.0
        case actuators.Gripper(reach=reach):
            return GRIPPER, 0.0, reach
        case actuators.Servo():
            return SERVO, 0.0, 0.0


def memory_row(start: int, cell: Cell) -> tuple[int, float, float, float]:
    """A row of MEMORY."""
    return start, cell.decay, 1.0 - cell.decay, cell.start
