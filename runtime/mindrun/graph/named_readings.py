"""Readings by name: what each is called, and what people and other programs write as the engine's vector."""

from __future__ import annotations

from collections.abc import Container, Mapping
from typing import TYPE_CHECKING, Any

from mindrun.errors import ReadingsError, nearest
from mindrun.graph.graph import Graph, Sensor
from mindrun.kinds.sensors.sensor import SensorKind

if TYPE_CHECKING:
    from mindrun.numbers.arrays import Singles


def physical(graph: Graph) -> dict[str, Sensor]:
    """The sensors that someone has to read; the engine computes the others."""
    return {sensor.name: sensor for sensor in graph.sensors if sensor.kind.is_given}


def reading_names(graph: Graph) -> list[str]:
    """The name of every reading: its sensor's or memory's, with a number from 1 where there are several."""
    several = {name for name, number in graph.readings if number}
    return [f"{name} {number + 1}" if name in several else name for name, number in graph.readings]


def named_places(graph: Graph) -> dict[str, range]:
    """The rows of the readings of each sensor and each memory."""
    found = {sensor.name: range(sensor.start, sensor.start + sensor.width) for sensor in graph.sensors}
    return found | {each.name: range(each.start, each.start + each.kind.width) for each in graph.memories}


def kept_rows(graph: Graph) -> dict[str, int]:
    """The place of each number that memories keep in the vector of readings, by the name of that reading."""
    sensed = graph.width - sum(memory.kind.kept for memory in graph.memories)
    return {name: row for row, name in enumerate(reading_names(graph)) if row >= sensed}


def vector(
    graph: Graph, given: Mapping[str, Any], fill: float | None = None, needed: Container[str] | None = None
) -> Singles:
    """Readings [graph.width] from `{"proximity": [1, 0.5], "battery": 0.4}`; a missing sensor reads `fill`.

    One that is not `needed`, since nobody reads it, may be missing anyway: it is NaN, as a reading that failed. So may
    an order: it is neutral. ReadingsError for anything else that is not a number in 0..1.
    """
    import numpy as np

    sensors = physical(graph)
    for name in given:
        if name not in sensors:
            raise ReadingsError(_unknown(graph, name))
    readings = np.zeros(graph.width, np.float32)
    for name, sensor in sensors.items():
        kind: Any = sensor.kind
        if name in given or (fill is not None and (needed is None or name in needed)):
            readings[sensor.place] = _checked(sensor, given.get(name, [fill] * sensor.width))
        elif needed is not None and name not in needed:
            readings[sensor.place] = np.nan
        elif kind.is_order:
            readings[sensor.place] = kind.readings(kind.neutral)
        else:
            raise ReadingsError(f"there is no reading of sensor {name} (--fill 0.5 would set it)")
    return readings


def _checked(sensor: Sensor, given: Any) -> list[float]:
    values: list[Any] = given if isinstance(given, list) else [given]
    if len(values) != sensor.width:
        many = f"{sensor.width} reading{'s' * (sensor.width > 1)}"
        raise ReadingsError(f"sensor {sensor.name} has {many}, not {len(values)}")
    for value in values:
        if type(value) not in (int, float) or value < 0 or value > 1:
            raise ReadingsError(f"sensor {sensor.name} cannot read {value!r}: a reading is a number from 0 to 1")
    return values


def _unknown(graph: Graph, name: str) -> str:
    if name in {s.name for s in graph.sensors} | {m.name for m in graph.memories}:
        return f"{name} is computed by the mind itself, leave it out"
    near = nearest(name, physical(graph))
    return f"there is no sensor {name}" + (f"; did you mean {near}?" if near else "")


def servo_reading(graph: Graph, kind: SensorKind) -> int | None:
    """The reading that says where the servo of a kind of sensor looks; None where nothing does, or it is on none."""
    told = (each.start for each in graph.sensors if each.kind.tells_servo and each.kind.servo == kind.servo)
    return next(told, None) if kind.servo else None
