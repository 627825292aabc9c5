"""The rows of what moves by itself, and the places of its ways."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.graph.graph import Task
from mindrun.sim.codes import WALKING
from mindrun.sim.records import Row, records
from mindrun.sim.state import PLACE_ROWS
from mindrun.sim.task_rows import rows_by_name, things_of

Array = NDArray[Any]


def walker_rows(task: Task, dt: float) -> Array:
    """Rows of WALKING, in the order of the things that they are rows of.

    A direction that drifts by up to √(3·dt)·turning either way in each tick has drifted by `turning` in a second, in
    the root of the mean square. The second of several on one way begins at its second place.
    """
    rows: list[Row] = []
    places = rows_by_name(task)
    first = 0
    for i, thing in enumerate(things_of(task)):
        kind: Any = thing.kind
        if kind.walks:
            count, copy = len(kind.along), i - places[thing.name].start
            row = {"thing": i, "step": kind.speed * dt, "turn": kind.turning * np.sqrt(3 * dt)}
            rows.append({**row, "first": first, "places": count, "begins": (copy + 1) % max(1, count)})
            first += count if i + 1 == places[thing.name].stop else 0
    return records(rows, WALKING)


def way_rows(task: Task) -> Array:
    """The places [places, PLACE_ROWS] that walkers go along, way after way."""
    kinds: list[Any] = [thing.kind for thing in task.things if thing.kind.walks]
    return np.array([place for kind in kinds for place in kind.along], np.float64).reshape(-1, PLACE_ROWS)
