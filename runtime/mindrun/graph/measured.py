"""The readings that are measured, in a simulated world and on a robot; all others are NaN, for nobody knows them."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import TYPE_CHECKING

from mindrun.graph.graph import Graph, Sensor, Skill, Task
from mindrun.graph.named_readings import physical
from mindrun.graph.skill_sets import acting
from mindrun.numbers.expression import leaves

if TYPE_CHECKING:
    from mindrun.numbers.arrays import Bools


def used_sensors(graph: Graph, reached: Iterable[Skill], task: Task) -> tuple[list[Sensor], list[Sensor]]:
    """The sensors on which reached skills depend, and those beside on which only rewards and ends do; sources first.

    Those by which memories change are among the first: a memory is known in each world.
    """
    kept = {memory.start for memory in graph.memories}
    skills = with_sources(graph, kept | {row for skill in reached for row in skill.inputs})
    rows = {index for program in task.programs for index in leaves(program, "reading")}
    rows |= {row for reward in task.rewards if reward.each for row in range(reward.each[0], sum(reward.each))}
    return skills, [sensor for sensor in with_sources(graph, rows) if sensor not in skills]


def measured_in_world(graph: Graph, master: str, task: Task) -> list[Sensor]:
    """The sensors that a simulated run measures: what skills below the master, rewards and promises depend on."""
    reached = acting(graph, task, master)
    skills, aside = used_sensors(graph, reached, task)
    return skills + aside + promised_sensors(graph, reached, skills + aside)


def promised_sensors(graph: Graph, reached: Iterable[Skill], known: Collection[Sensor]) -> list[Sensor]:
    """The sensors beside the known ones on which only what skills promise depends; sources first."""
    promises = (promise for skill in reached for promise in skill.promises)
    rows = {index for promise in promises for index in leaves(promise.when, "reading")}
    return [sensor for sensor in with_sources(graph, rows) if sensor not in known]


def measured_on_robot(graph: Graph, wired: Collection[str]) -> list[Sensor]:
    """These physical sensors, and those that are computed of nothing else."""
    missing = physical(graph).keys() - {*wired}
    sources = ((sensor, with_sources(graph, {sensor.start})) for sensor in graph.sensors)
    return [sensor for sensor, each in sources if missing.isdisjoint(source.name for source in each)]


def rows_of(graph: Graph, sensors: Iterable[Sensor]) -> Bools:
    """A mask [graph.width] of the readings of these sensors, and of the memories that change by no other sensors."""
    import numpy as np

    known = {sensor.name: sensor for sensor in sensors}
    found = np.zeros(graph.width, bool)
    for sensor in known.values():
        found[sensor.place] = True
    for memory in graph.memories:
        found[memory.place] = known.keys() >= {*memory.kind.sources}
    return found


def with_sources(graph: Graph, rows: set[int]) -> list[Sensor]:
    """The sensors that have these readings, what those derive from and what memories do; sources first."""
    by_name = {sensor.name: sensor for sensor in graph.sensors}
    behind = {memory.name: memory.kind.sources for memory in graph.memories}
    read = {name for row, (name, _) in enumerate(graph.readings) if row in rows}
    read |= {source for name in read for source in behind.get(name, ())}
    ordered: dict[str, Sensor] = {}
    for sensor in graph.sensors:
        if sensor.name in read:
            waiting = [sensor]
            while waiting:
                last = waiting[-1]
                sources = [each for name in last.kind.sources for each in behind.get(name, (name,))]
                missing = [name for name in sources if name in by_name and name not in ordered]
                if missing:
                    waiting.append(by_name[missing[0]])
                else:
                    ordered.setdefault(last.name, waiting.pop())
    return list(ordered.values())
