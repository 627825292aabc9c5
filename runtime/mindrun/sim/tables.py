"""A graph, a task and a master as plain tables: one row per sensor, skill, reward, so that no program compiles."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mindrun.graph import Graph, Task
from mindrun.sim.codes import (
    ACTUATOR,
    CODE,
    EDGE,
    EVENT,
    MEASURES,
    MEMORY,
    OBSTACLE,
    REWARD,
    THING,
)  # fmt: skip
from mindrun.sim.mind_rows import actuator_rows, memory_row, sensor_rows, skill_rows, used_sensors
from mindrun.sim.programs import Programs
from mindrun.sim.task_rows import (
    box_count,
    event_rows,
    measure_rows,
    obstacle_rows,
    reward_row,
    thing_rows,
    world_row,
)  # fmt: skip
from mindrun.weights import genes, reachable

Array = NDArray[Any]
Floats = NDArray[np.float32]


class Tables(NamedTuple):
    """What the lanes run: everything about the program and its task that is the same in every lane."""

    world: Array
    sensors: Array
    rays: Array  # [2, rays] float32: cosine and sine of each ray's angle
    ray_row: Array  # the row of readings that each ray writes
    skills: Array
    inputs: Array  # rows of readings, skill after skill
    edges: Array
    codes: Array
    weights: Array  # float32, of the skills that do not learn
    actuators: Array
    memories: Array
    things: Array
    obstacles: Array
    measures: Array
    events: Array
    rewards: Array
    library: Array  # addresses of Chipmunk's functions


@dataclass(frozen=True, slots=True)
class Sizes:
    """How much room a lane needs."""

    readings: int
    skills: int
    before: int
    rough: int
    rings: int
    inputs: int
    width: int
    genome: int
    recurrent: int
    delays: int
    changes: int
    patches: int
    boxes: int
    depth: int


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
    codes = Programs()
    reached = reachable(graph, master)
    skills = skill_rows(graph, reached, weights, learners, addresses, codes)
    rewards = [reward_row(reward, codes) for reward in task.rewards]
    used = used_sensors(graph, reached, task)
    sensed = sensor_rows(graph, used, task)
    measured, changes = measure_rows(task)
    noticed, patches = event_rows(task)
    driven, delays = actuator_rows(graph)
    tables = Tables(
        world=world_row(
            graph, task, len(sensed.ray_row), [*used.skills, *used.aside], [s.name for s in graph.skills].index(master)
        ),
        sensors=sensed.rows,
        rays=sensed.rays,
        ray_row=sensed.ray_row,
        skills=skills.rows,
        inputs=np.array(skills.inputs, np.int64),
        edges=np.array(skills.edges, EDGE),
        codes=np.array(codes.rows, CODE),
        weights=np.concatenate([np.zeros(0, np.float32), *skills.weights]).astype(np.float32),
        actuators=np.array(driven, ACTUATOR),
        memories=np.array([memory_row(m.start, m.kind) for m in graph.memories], MEMORY),
        things=np.array(thing_rows(graph, task), THING),
        obstacles=np.array(obstacle_rows(task), OBSTACLE),
        measures=np.array(measured, MEASURES),
        events=np.array(noticed, EVENT),
        rewards=np.array(rewards, REWARD),
        library=library,
    )
    states = np.diff(skills.rows["state"], append=skills.state)
    sizes = Sizes(
        readings=max(1, graph.width),
        skills=len(graph.skills),
        before=sensed.derived,
        rough=sensed.rough,
        rings=sensed.rings,
        inputs=max(1, *skills.rows["inputs"] + states),
        width=max(1, *skills.rows["width"], *skills.rows["outputs"], *states),
        genome=genome_length(graph, learners),
        recurrent=skills.state,
        delays=delays,
        changes=changes,
        patches=patches,
        boxes=box_count(task),
        depth=codes.depth,
    )
    return tables, sizes


def genome_length(graph: Graph, learners: Sequence[str]) -> int:
    """How many weights the learners have together."""
    return sum(genes(skill) for skill in graph.skills if skill.name in learners)
