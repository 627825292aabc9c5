"""A graph, a task and a master as plain tables: one row per sensor, skill, reward, so that no program compiles."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mindrun.graph.graph import Graph, Task
from mindrun.graph.measured import rows_of, used_sensors
from mindrun.graph.weights import genes, reachable
from mindrun.sim.codes import (
    CODE,
    END,
    EVENT,
    MEASURES,
    OBSTACLE,
    REWARD,
    THING,
)  # fmt: skip
from mindrun.sim.loose_rows import loose_rows
from mindrun.sim.mind_rows import actuator_rows, memory_rows, skill_rows
from mindrun.sim.parameter_rows import Parameters
from mindrun.sim.programs import Programs
from mindrun.sim.sensor_rows import sensor_rows
from mindrun.sim.task_rows import (
    box_count,
    end_row,
    event_rows,
    measure_rows,
    obstacle_rows,
    reward_row,
    thing_rows,
    wall_rows,
    world_row,
)  # fmt: skip
from mindrun.sim.walker_rows import walker_rows, way_rows

Array = NDArray[Any]
Floats = NDArray[np.float32]


class Tables(NamedTuple):
    """What the lanes run: everything about the program and its task that is the same in every lane."""

    world: Array
    sensors: Array
    rays: Array  # [2, rays] float32: cosine and sine of each ray's angle
    rims: Array  # [rays] float32: how far from the robot's middle each ray leaves it
    ray_row: Array  # the row of readings that each ray writes
    passes: Array  # [2, rays]: the first thing that each ray goes on through, and the one after the last
    numbers: Array  # float64, of the sensors whose kinds say `numbers`
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


@dataclass(frozen=True, slots=True)
class Sizes:
    """How much room a lane needs; `measured` [graph.width] says which readings anybody writes."""

    readings: int
    skills: int
    before: int
    rough: int
    rings: int
    inputs: int
    scratch: int
    genome: int
    recurrent: int
    delays: int
    changes: int
    patches: int
    arrivals: int
    boxes: int
    depth: int
    measured: NDArray[np.bool_]


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
    codes, parameters = Programs(), Parameters(graph, task)
    reached = reachable(graph, master)
    skills = skill_rows(graph, reached, weights, learners, addresses, codes)
    rewards = [reward_row(reward, codes) for reward in task.rewards]
    ends = [end_row(end, codes) for end in task.ends]
    used = used_sensors(graph, reached, task)
    sensed = sensor_rows(graph, used, task, codes, parameters)
    driven, delays = actuator_rows(graph, parameters)
    measured, changes = measure_rows(task)
    noticed, patches, arrivals = event_rows(task)
    tables = Tables(
        world=world_row(graph, task, parameters, len(sensed.ray_row), used.all, master),
        sensors=sensed.rows, rays=sensed.rays, rims=sensed.rims, ray_row=sensed.ray_row,
        passes=sensed.passes, numbers=sensed.numbers,
        skills=skills.rows, inputs=skills.inputs, edges=skills.edges, weights=skills.weights,
        codes=np.array(codes.rows, CODE), actuators=driven, memories=memory_rows(graph),
        things=np.array(thing_rows(graph, task), THING), loose=loose_rows(task, graph.tick, parameters),
        walkers=walker_rows(task, graph.tick), ways=way_rows(task),
        obstacles=np.array(obstacle_rows(task), OBSTACLE), walls=wall_rows(task),
        measures=np.array(measured, MEASURES), events=np.array(noticed, EVENT),
        ends=np.array(ends, END), rewards=np.array(rewards, REWARD),
        library=library, parameters=parameters.table(),  # last: all others add to them
    )  # fmt: skip
    return tables, Sizes(
        readings=max(1, graph.width), before=sensed.derived, rough=sensed.rough, rings=sensed.rings,
        skills=len(graph.skills), inputs=skills.most_inputs, scratch=skills.scratch, recurrent=skills.state,
        genome=genome_length(graph, learners), depth=codes.depth, delays=delays,
        changes=changes, patches=patches, arrivals=arrivals, boxes=box_count(task), measured=rows_of(graph, used.all),
    )  # fmt: skip


def genome_length(graph: Graph, learners: Sequence[str]) -> int:
    """How many weights the learners have together."""
    learning = {*learners}
    return sum(genes(skill) for skill in graph.skills if skill.name in learning)
