"""The mind's rows of the tables: skills and their edges, sensors, actuators, memories."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.graph import Graph, Sensor, Skill, Task
from mindrun.memory import Cell
from mindrun.registry import names
from mindrun.sensors import Physical
from mindrun.sim.codes import ACTUATOR_CODES, SENSOR, SKILL, function_codes, sensor_codes
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
) -> "Skills":
    """What the tables say of the skills that a master reaches.

    A learner's weights begin at a place in the genome, the others' at one in what is shared.
    """
    lengths = {skill.name: genes(skill) for skill in reached}
    starts = dict(zip(learners, np.cumsum([0, *(lengths.get(name, 0) for name in learners)]), strict=False))
    numbers = function_codes()
    rows: list[Mapping[str, float]] = []
    inputs: list[int] = []
    edges: list[Any] = []
    shared: list[Floats] = []
    state = 0
    for skill in reached:
        function, count, outputs = skill.function, len(skill.inputs), skill.outputs
        own = skill.name in starts
        rows.append({
            "kind": numbers[names()[type(function)]], "index": graph.skills.index(skill),
            "input": len(inputs), "inputs": count, "outputs": outputs,
            "weights": int(starts[skill.name]) if own else sum(len(part) for part in shared), "own": own,
            "edge": len(edges), "edges": len(skill.edges), "address": addresses.get(skill.name, 0), "state": state,
            **function.row(count, outputs),
        })  # fmt: skip
        inputs.extend(skill.inputs)
        for edge in skill.edges:
            target = edge.target + (len(graph.actuators) if edge.to == "memory" else 0)
            output = -1 if edge.output is None else edge.output
            edges.append((edge.to == "skill", target, output, *codes.add(edge.value)))
        if genes(skill) and not own:
            shared.append(weights_of(skill, weights))
        state += function.state_length(count, outputs)
    return Skills(records(rows, SKILL), inputs, edges, shared, state)


@dataclass(frozen=True, slots=True)
class Skills:
    """Rows of SKILL, the inputs one after the other, rows of EDGE, the weights of the skills that do not learn.

    `state` is how many numbers all of them remember.
    """

    rows: Array
    inputs: list[int]
    edges: list[Any]
    weights: list[Floats]
    state: int


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
class Scene:
    """What the row of a sensor can depend on beside its own arguments."""

    tick: float
    starts: Mapping[str, int]


@dataclass(frozen=True, slots=True)
class Sensed:
    """Rows of SENSOR, the directions [2, rays] of all rays and the reading that each writes, and how many readings.

    Those are: derived ones, rough ones, and what waits in their rings.
    """

    rows: Array
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
    codes, scene = sensor_codes(), Scene(graph.tick, starts)
    rows: list[Mapping[str, float]] = []
    angles: list[float] = []
    ray_row: list[int] = []
    before = held = ring = 0
    for is_aside, sensor in [(False, s) for s in used.skills] + [(True, s) for s in used.aside]:
        kind = sensor.kind
        row: dict[str, float] = {
            "kind": codes[names()[type(kind)]], "start": sensor.start, "width": sensor.width,
            "thing": things.get(kind.thing, -1), "turns": kind.source in circular,
            "ray": len(angles), "before": before, "held": held, "ring": ring, "is_aside": is_aside, "every": 1,
        }  # fmt: skip
        if isinstance(kind, Physical):
            row |= _roughness(kind)
            held += sensor.width
            ring += sensor.width * kind.delay
        rows.append({**row, **kind.row(scene)})
        angles.extend(kind.rays)
        ray_row.extend(range(sensor.start, sensor.start + len(kind.rays)))
        before += sensor.width if kind.remembers else 0
    turn = np.array(angles, np.float64)
    directions = np.array([np.cos(turn), np.sin(turn)], np.float32)
    return Sensed(records(rows, SENSOR), directions, np.array(ray_row, np.int64), before, held, ring)


def _roughness(kind: Physical) -> dict[str, float]:
    """What is not perfect about it; `blank` is what is read where one is lost, −1 for the same as before."""
    is_rough = kind.noise > 0 or kind.lost > 0 or kind.every > 1 or kind.delay > 0
    blank = -1.0 if kind.keeps_lost else kind.blank
    return {
        "is_rough": is_rough, "noise": kind.noise, "lost": kind.lost, "blank": blank,
        "every": max(1, kind.every), "delay": kind.delay,
    }  # fmt: skip


def records(rows: Sequence[Mapping[str, float]], columns: Any) -> Array:
    """Rows of a table by the names of its columns; what a row does not say is 0."""
    table = np.zeros(len(rows), columns)
    for record, row in zip(table, rows, strict=True):
        for column, value in row.items():
            record[column] = value
    return table


def actuator_rows(graph: Graph) -> tuple[list[Any], int]:
    """Rows of ACTUATOR, and how many commands wait at any time."""
    rows: list[Any] = []
    ring = 0
    for actuator in graph.actuators:
        kind, row = actuator.kind, actuator.kind.row()
        code = ACTUATOR_CODES[names()[type(kind)], kind.mounted]
        rows.append((code, row.get("thrust", 0.0), kind.neutral, row.get("reach", 0.0), kind.delay, ring))
        ring += kind.delay
    return rows, ring


def memory_row(start: int, cell: Cell) -> tuple[int, float, float, float]:
    """A row of MEMORY."""
    return start, cell.decay, 1.0 - cell.decay, cell.start
