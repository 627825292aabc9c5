"""The rows of what moves by itself, and the places of its ways."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.graph import Task
from mindrun.sim.codes import WALKING
from mindrun.sim.records import Row, records
from mindrun.sim.state import PLACE_ROWS
from mindrun.sim.task_rows import things_of

Array = NDArray[Any]


def walker_rows(task: Task, dt: float) -> tuple[Array, Array]:
    """Rows of WALKING in the order of the things that they are rows of, and the places [places, PLACE_ROWS].

    A direction that drifts by up to √(3·dt)·turning either way in each tick has drifted by `turning` in a second, in
    the root of the mean square. The second of several on one way begins at its second place.
    """
    rows: list[Row] = []
    ways: list[tuple[float, float]] = []
    first, before = 0, ""
    for i, thing in enumerate(things_of(task)):
        kind: Any = thing.kind
        if not kind.walks:
            continue
        if thing.name != before:
            first, before, copy = len(ways), thing.name, 0
            ways += kind.along
        copy += 1
        places = len(kind.along)
        rows.append({
            "thing": i, "step": kind.speed * dt, "turn": kind.turning * np.sqrt(3 * dt),
            "first": first, "places": places, "begins": copy % max(1, places),
        })  # fmt: skip
    return records(rows, WALKING), np.array(ways, np.float64).reshape(-1, PLACE_ROWS)
