"""The rows of the sensors that somebody reads, and their rays."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.engine.engine import scene_of
from mindrun.graph.graph import Graph, Sensor, Task
from mindrun.graph.measured import Used
from mindrun.kinds.registry import names
from mindrun.kinds.sensors.sensor import Physical
from mindrun.numbers.expression import placed
from mindrun.sim.codes import SENSOR, sensor_codes
from mindrun.sim.parameter_rows import Parameters
from mindrun.sim.programs import Programs
from mindrun.sim.records import Row, records
from mindrun.sim.task_rows import NOWHERE, boxes_by_name, rows_by_name

Array = NDArray[Any]


@dataclass(frozen=True, slots=True)
class Sensed:
    """Rows of SENSOR, the directions [2, rays] of all rays, where they leave the body, the readings they write,
    the things through which they go on.

    Then the numbers of kinds, and how many readings are derived, rough, and wait in their rings.
    """

    rows: Array
    rays: Array
    rims: Array
    ray_row: Array
    passes: Array
    numbers: Array
    derived: int
    rough: int
    rings: int


def sensor_rows(graph: Graph, used: Used, task: Task, programs: Programs, parameters: Parameters) -> Sensed:
    """What the table of sensors says of those that are used.

    What is measured aside draws its noise from a generator of its own: a reward changes nothing in the world.
    """
    things, boxes = rows_by_name(task), boxes_by_name(task)
    scene, room = scene_of(graph), _Room()
    rows: list[Row] = []
    for is_aside, sensor in [(False, s) for s in used.skills] + [(True, s) for s in used.aside]:
        kind = sensor.kind
        about, solid = things.get(kind.thing, NOWHERE), boxes.get(kind.thing, NOWHERE)
        row: dict[str, float] = {
            "kind": sensor_codes()[names()[type(kind)]], "start": sensor.start, "width": sensor.width,
            "thing": about.start, "things": len(about), "box": solid.start, "boxes": len(solid),
            "turns": not scene.directions.isdisjoint({sensor.name, kind.source}),
            "is_aside": is_aside, "every": 1,
        }  # fmt: skip
        row["code"], row["length"] = programs.add(placed(kind.formula, scene.starts))
        taken, roughness = room.take(sensor, about, parameters), _roughness(sensor, parameters)
        rows.append({**row, **taken, **roughness, **kind.row(scene)})
    turn = np.array(room.rays, np.float64)
    return Sensed(
        rows=records(rows, SENSOR),
        rays=np.array([np.cos(turn), np.sin(turn)], np.float32),
        rims=np.array([graph.body.rim(angle) for angle in room.rays], np.float32),
        ray_row=np.array(room.ray_row, np.int64),
        passes=np.array(room.passes, np.int64).reshape(-1, 2).T.copy(),
        numbers=np.array(room.numbers, np.float64),
        derived=room.before,
        rough=room.held,
        rings=room.ring,
    )


@dataclass(slots=True)
class _Room:
    """What the sensors before have taken of what all share."""

    rays: list[float] = field(default_factory=list)
    ray_row: list[int] = field(default_factory=list)
    passes: list[tuple[int, int]] = field(default_factory=list)
    numbers: list[float] = field(default_factory=list)
    before: int = 0
    held: int = 0
    ring: int = 0

    def take(self, sensor: Sensor, about: range, parameters: Parameters) -> Row:
        """Where what a sensor needs begins."""
        kind = sensor.kind
        row = {
            "ray": len(self.rays), "number": len(self.numbers), "before": self.before, "held": self.held,
            "ring": self.ring,
        }  # fmt: skip
        self.rays.extend(kind.rays)
        self.ray_row.extend(range(sensor.start, sensor.start + len(kind.rays)))
        self.passes.extend((about.start, about.stop) for _ in kind.rays)
        self.numbers.extend(kind.numbers)
        self.before += sensor.width * kind.remembered
        if isinstance(kind, Physical):
            self.held += sensor.width
            self.ring += sensor.width * parameters.greatest("sensor", sensor.name, kind).delay
        return row


def _roughness(sensor: Sensor, parameters: Parameters) -> Row:
    """What is not perfect about it; `blank` is what is read where one is lost, −1 for the same as before."""
    kind, name = sensor.kind, sensor.name
    if not isinstance(kind, Physical):
        return {}
    varying = {
        "noise": parameters.row("sensor", name, "noise", kind.noise),
        "lost": parameters.row("sensor", name, "lost", kind.lost),
        "wait": parameters.row("sensor", name, "delay", kind.delay),
    }
    kind = parameters.greatest("sensor", name, kind)
    is_rough = kind.noise > 0 or kind.lost > 0 or kind.every > 1 or kind.delay > 0
    blank = -1.0 if kind.keeps_lost else kind.blank
    return {
        "is_rough": is_rough, "blank": blank, "every": max(1, kind.every), "delay": kind.delay, **varying,
    }  # fmt: skip
