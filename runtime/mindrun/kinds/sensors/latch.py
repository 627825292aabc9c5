"""A threshold with two sides."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Begin, Bounds, Flaw, Row, Scene, SensorKind
from mindrun.numbers.quantity import RATIO, SENSOR

if TYPE_CHECKING:  # a lane is given these when it is compiled
    from mindrun.numbers.arithmetic import NAN, ONE, ZERO, finite
    from mindrun.numbers.arrays import Reader, Readings


@kind("sensor", "latch")
class Latch(SensorKind):
    """1 from when another sensor reads less than `below` until it reads more than `above`, else 0: hysteresis.

    It begins with 0, or with 1 where the first reading is below. A reading that failed leaves it as it is, and is none
    of its own.
    """

    of: Annotated[str, SENSOR]
    below: Annotated[float, RATIO]
    above: Annotated[float, RATIO]

    compares = True
    shape = None
    remembered = 1

    def flaw(self, widths: Mapping[str, int]) -> Flaw | None:
        """A flaw where `above` is less than `below`."""
        if self.below <= self.above:
            return None
        hint = "Write the smaller one after below: latch of battery below 20% above 80%."
        return Flaw("latch-backwards", "above", "This latch lets go before it closes.", hint)

    def first(self, begin: Begin) -> Bounds:
        """The bounds of its first reading: 1 where its source is `below`, else 0."""
        low, high = begin.first(self.of)
        return 0.0 if high >= self.below else 1.0, 1.0 if low < self.below else 0.0

    def reader(self, scene: Scene) -> Reader:
        """1 below, 0 above, between them what it was."""
        import numpy as np

        source, below, above = scene.places[self.of], np.float32(self.below), np.float32(self.above)
        held = np.zeros(source.stop - source.start, np.float32)

        def read(number: int, now: Readings, before: Readings | None) -> Readings:
            found = now[source]
            held[found < below] = 1
            held[found > above] = 0
            return np.where(np.isfinite(found), held, np.float32(np.nan))

        return read

    def row(self, scene: Scene) -> Row:
        """The inherited columns and the two thresholds, `low` and `high`."""
        return {**SensorKind.row(self, scene), "low": self.below, "high": self.above}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """1 below, 0 above, between them what it was."""
        for k in range(sensor.width):
            out, now, held = s.readings[sensor.start + k], s.readings[sensor.source + k], s.before[sensor.before + k]
            for p in range(n):
                was = held[p] if s.tick[p] > 0 else ZERO
                was = ONE if now[p] < sensor.low else was
                held[p] = ZERO if now[p] > sensor.high else was
                out[p] = held[p] if finite(now[p]) else NAN
