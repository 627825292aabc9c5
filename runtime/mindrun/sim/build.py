"""A graph, a task and a master as tables."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.graph.graph import Graph, Task
from mindrun.graph.measured import rows_of, used_sensors
from mindrun.graph.weights import genes, reachable
from mindrun.sim import task_rows
from mindrun.sim.codes import CODE
from mindrun.sim.mind_rows import Programs, actuator_rows, memory_rows, skill_rows
from mindrun.sim.parameter_rows import Parameters
from mindrun.sim.sensor_rows import sensor_rows
from mindrun.sim.tables import Tables

Array = NDArray[Any]
Floats = NDArray[np.float32]
Sizes = Mapping[str, int]  # the room that a lane needs, by what it is for


def build(
    graph: Graph,
    weights: Mapping[str, Floats],
    task: Task,
    master: str,
    learners: Sequence[str],
    addresses: Mapping[str, int],
    library: Array,
) -> tuple[Tables, Sizes]:
    """The tables of a task under a master; `addresses` are those of the compiled procedures, by skill."""
    programs, parameters = Programs(), Parameters(graph, task)
    reached = reachable(graph, master)
    skills, most = skill_rows(graph, reached, weights, learners, addresses, programs)
    rewards, ends = task_rows.reward_rows(task, programs), task_rows.end_rows(task, programs)
    used, aside = used_sensors(graph, reached, task)
    sensors, remembered = sensor_rows(graph, used, aside, task, programs, parameters)
    driven, delays = actuator_rows(graph, parameters)
    measures, changes = task_rows.measure_rows(task)
    events, patches, arrivals = task_rows.event_rows(task)
    tables = Tables(
        **sensors, **skills, **task_rows.walker_rows(task, graph.tick),
        world=task_rows.world_row(graph, task, parameters, len(sensors["ray_row"]), used + aside, master),
        codes=np.array(programs.rows, CODE), actuators=driven, memories=memory_rows(graph),
        things=task_rows.thing_rows(graph, task), loose=task_rows.loose_rows(task, graph.tick, parameters),
        obstacles=task_rows.obstacle_rows(task), walls=task_rows.wall_rows(task),
        measures=measures, events=events, ends=ends, rewards=rewards,
        measured=rows_of(graph, used + aside), library=library,
        parameters=parameters.table(),  # last: all others add to them
    )  # fmt: skip
    return tables, {
        **remembered, **most, "readings": max(1, graph.width), "genome": genome_length(graph, learners),
        "skills": len(graph.skills), "depth": programs.depth, "delays": delays, "changes": changes,
        "patches": patches, "arrivals": arrivals, "boxes": sum(each.kind.obstacles(task.scene) for each in task.things),
    }  # fmt: skip


def genome_length(graph: Graph, learners: Sequence[str]) -> int:
    """The number of weights of all learners together."""
    learning = {*learners}
    return sum(genes(skill) for skill in graph.skills if skill.name in learning)
