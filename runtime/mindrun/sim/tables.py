"""A graph, a task and a master as plain tables, a row per sensor, skill, reward: a new mind needs no compiling."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

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

Array = NDArray[Any]
Floats = NDArray[np.float32]
Sizes = Mapping[str, int]  # the room that a lane needs, by what it is for


class Tables(NamedTuple):
    """Everything about the program and its task that is the same in every lane."""

    world: Array
    sensors: Array
    rays: Array  # [2, rays] float32: cosine and sine of each ray's angle
    rims: Array  # [rays] float32: how far from the robot's middle each ray leaves it
    ray_row: Array  # the row of readings that each ray writes
    passes: Array  # [2, rays]: the first thing that each ray goes on through, and the one after the last
    numbers: Array  # float64, of the sensors whose kinds say `numbers`
    measured: Array  # [graph.width] bool: which readings anybody writes
    skills: Array
    inputs: Array  # rows of readings, skill after skill
    edges: Array
    codes: Array
    weights: Array  # float32, of the skills that do not learn
    actuators: Array
    memories: Array
    parameters: Array
    things: Array
    loose: Array
    walkers: Array
    ways: Array  # [places, 2] float64: those that walkers go along, way after way
    obstacles: Array
    walls: Array  # [walls, BOX_COLUMNS]: the boxes that stand in the same places in every run
    measures: Array
    events: Array
    ends: Array
    rewards: Array
    library: Array  # addresses of Chipmunk's functions


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
