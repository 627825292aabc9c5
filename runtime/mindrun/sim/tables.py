"""A graph, a task and a master as plain tables, a row per sensor, skill, reward: a new mind needs no compiling."""

from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray

from mindrun.sim.arrays import Block, Room
from mindrun.sim.codes import (
    ACTUATOR,
    CODE,
    EDGE,
    END,
    EVENT,
    LOOSE,
    MEASURES,
    MEMORY,
    OBSTACLE,
    PARAMETER,
    REWARD,
    SENSOR,
    SKILL,
    THING,
    WALKING,
    WORLD,
)  # fmt: skip

Array = NDArray[Any]
F4, F8, I8, U8 = np.float32, np.float64, np.int64, np.uint64


def table(dtype: Any, dimensions: int = 1) -> Room:
    """An array whose shape follows from the mind and its task."""
    return Room(np.dtype(dtype), dimensions, lambda counts, lanes: (0,) * dimensions)


@dataclass(frozen=True)
class Tables(Block):
    """Everything about the program and its task that is the same in every lane."""

    world: Annotated[Array, table(WORLD)]
    sensors: Annotated[Array, table(SENSOR)]
    rays: Annotated[Array, table(F4, 2)]  # [2, rays]: cosine and sine of each ray's angle
    rims: Annotated[Array, table(F4)]  # [rays]: how far from the robot's middle each ray leaves it
    ray_row: Annotated[Array, table(I8)]  # the row of readings that each ray writes
    passes: Annotated[Array, table(I8, 2)]  # [2, rays]: the first thing that each goes on through, and the last + 1
    numbers: Annotated[Array, table(F8)]  # of the sensors whose kinds say `numbers`
    measured: Annotated[Array, table(bool)]  # [graph.width]: which readings anybody writes
    skills: Annotated[Array, table(SKILL)]
    inputs: Annotated[Array, table(I8)]  # rows of readings, skill after skill
    edges: Annotated[Array, table(EDGE)]
    codes: Annotated[Array, table(CODE)]
    weights: Annotated[Array, table(F4)]  # of the skills that do not learn
    actuators: Annotated[Array, table(ACTUATOR)]
    memories: Annotated[Array, table(MEMORY)]
    parameters: Annotated[Array, table(PARAMETER)]
    things: Annotated[Array, table(THING)]
    loose: Annotated[Array, table(LOOSE)]
    walkers: Annotated[Array, table(WALKING)]
    ways: Annotated[Array, table(F8, 2)]  # [places, 2]: those that walkers go along, way after way
    obstacles: Annotated[Array, table(OBSTACLE)]
    walls: Annotated[Array, table(F8, 2)]  # [walls, BOX_COLUMNS]: the boxes that stand in the same places in every run
    measures: Annotated[Array, table(MEASURES)]
    events: Annotated[Array, table(EVENT)]
    ends: Annotated[Array, table(END)]
    rewards: Annotated[Array, table(REWARD)]
    library: Annotated[Array, table(U8)]  # addresses of Chipmunk's functions
