"""The rows of what can be pushed: boxes and balls."""

from typing import Any

from numpy.typing import NDArray

from mindrun.graph.graph import Task, Thing
from mindrun.sim.codes import DAMPING, LOOSE
from mindrun.sim.parameter_rows import Parameters
from mindrun.sim.records import Row, records
from mindrun.sim.task_rows import things_of


def loose_rows(task: Task, dt: float, parameters: Parameters) -> NDArray[Any]:
    """Rows of LOOSE, in the order of the things that they are rows of."""
    loose = ((i, thing) for i, thing in enumerate(things_of(task)) if thing.kind.is_loose)
    return records([_row(i, thing, dt, parameters) for i, thing in loose], LOOSE)


def _row(i: int, thing: Thing, dt: float, parameters: Parameters) -> Row:
    kind: Any = thing.kind
    return {
        "thing": i,
        "is_round": kind.is_round,
        "density": parameters.row("thing", thing.name, "density", kind.density),
        "friction": parameters.row("thing", thing.name, "friction", kind.friction),
        "slower": parameters.row("thing", thing.name, "damping", kind.damping, (DAMPING, dt)),
    }
