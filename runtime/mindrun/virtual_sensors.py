"""Virtual sensors: the readings that the engine computes from other readings and from the time."""

from dataclasses import dataclass
from math import floor, pi

import numpy as np
from numpy.typing import NDArray

from mindrun.graph import Graph
from mindrun.sensors import Bearing, Derivative, Sine
from mindrun.trigonometry import sine
from mindrun.validate import depths

_HALF, _ONE, _NAN = np.float32(0.5), np.float32(1.0), np.float32(np.nan)


@dataclass(frozen=True, slots=True)
class Wave:
    """A sine of `period` ticks, read at index `place`."""

    place: slice
    period: float

    def read(self, tick: int, now: NDArray[np.float32], before: NDArray[np.float32] | None) -> np.float32:
        """The reading at a tick, counted from 0."""
        turns = tick / self.period
        return np.float32(0.5 + 0.5 * sine(2 * pi * (turns - floor(turns))))


@dataclass(frozen=True, slots=True)
class Change:
    """The change of the readings at `source` since the tick before, read at `place`; on a circle it `turns`."""

    place: slice
    source: slice
    gain: np.float32
    dead_zone: np.float32
    turns: bool

    def read(
        self, tick: int, now: NDArray[np.float32], before: NDArray[np.float32] | None
    ) -> NDArray[np.float32] | np.float32:
        """The readings: 0.5 in the first tick, NaN where a reading of the source is not finite now or was not."""
        if before is None:
            return _HALF
        change = now[self.source] - before[self.source]
        sound = np.isfinite(now[self.source]) & np.isfinite(before[self.source])
        if self.turns:
            change = np.where(change > _HALF, change - _ONE, np.where(change < -_HALF, change + _ONE, change))
        value = np.fmin(np.fmax(_HALF + change * self.gain, np.float32(0.0)), _ONE)
        value = np.where(np.abs(value - _HALF) < self.dead_zone, _HALF, value)
        return np.where(sound, value, _NAN)


def virtual_sensors(graph: Graph) -> tuple[Wave | Change, ...]:
    """The virtual sensors of a mind, each after the one that it is the derivative of."""
    places = {memory.name: slice(memory.start, memory.start + 1) for memory in graph.memories}
    places |= {sensor.name: slice(sensor.start, sensor.start + sensor.width) for sensor in graph.sensors}
    sensors = {sensor.name: sensor for sensor in graph.sensors}
    found_at = depths(graph)
    ordered = sorted(graph.sensors, key=lambda sensor: found_at[sensor.name])
    found: list[Wave | Change] = []
    for sensor in ordered:
        match sensor.kind:
            case Sine(period):
                found.append(Wave(places[sensor.name], period / graph.tick))
            case Derivative(of, spread, dead_zone):
                gain = np.float32(0.5 / (graph.tick * spread))
                turns = of in sensors and isinstance(sensors[of].kind, Bearing)
                found.append(Change(places[sensor.name], places[of], gain, np.float32(dead_zone), turns))
    return tuple(found)
