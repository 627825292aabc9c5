"""The rows of what can be pushed: boxes and balls."""

from typing import Any

from numpy.typing import NDArray

from mindrun.graph import Task, Thing
from mindrun.sim.codes import LOOSE
from mindrun.sim.records import Row, records
from mindrun.sim.task_rows import things_of


def loose_rows(task: Task, dt: float) -> NDArray[Any]:
    """Rows of LOOSE, in the order of the things that they are rows of."""
    return records([_row(i, thing, dt) for i, thing in enumerate(things_of(task)) if thing.kind.is_loose], LOOSE)


def _row(i: int, thing: Thing, dt: float) -> Row:
    kind: Any = thing.kind
    return {
        "thing": i, "is_round": kind.is_round, "density": kind.density, "friction": kind.friction,
        "slower": 1.0 / (1.0 + dt * kind.damping),
    }  # fmt: skip
