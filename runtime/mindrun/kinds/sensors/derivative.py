"""The change of another sensor."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Row, Scene, SensorKind
from mindrun.kinds.things.thing import WorldFacts
from mindrun.numbers.quantity import POSITIVE, RATIO, SENSOR

if TYPE_CHECKING:  # a lane is given these when it is compiled
    import numpy as np

    from mindrun.numbers.arithmetic import HALF, NAN, clamp, finite, short_way
    from mindrun.numbers.arrays import Reader, Readings


@kind("sensor", "derivative")
class Derivative(SensorKind):
    """Change of another sensor's readings: 0.5 none, 1 rising by `range` a second. A direction turns the short way."""

    of: Annotated[str, SENSOR]
    range: Annotated[float, POSITIVE] = 1.0
    dead_zone: Annotated[float, RATIO] = 0.0

    shape = None
    remembered = 1
    rest = still = 0.5

    @property
    def remedy(self) -> str:  # type: ignore[override]
        """A hint for one that never changes: a smaller dead zone, or another source."""
        if self.dead_zone > 0.5:
            return SensorKind.remedy
        return f"Derive it from another sensor than {self.of}, which never changes"

    def constant(self, world: WorldFacts) -> float | None:
        """0.5 where the source never changes or the dead zone has every change, else None."""
        return 0.5 if world.is_constant(self.of) else SensorKind.constant(self, world)

    def reader(self, scene: Scene) -> Reader:
        """0.5 + change · gain; 0.5 in the first tick, NaN where the source is not finite now or was not before."""
        import numpy as np

        from mindrun.numbers.arithmetic import HALF, NAN, ONE, short_way

        gain, dead_zone = np.float32(0.5 / (scene.tick * self.range)), np.float32(self.dead_zone)
        source, turns = scene.places[self.of], self.of in scene.directions

        def read(number: int, now: Readings, before: Readings | None) -> Readings | np.float32:
            if before is None:
                return HALF
            change = now[source] - before[source]
            is_finite = np.isfinite(now[source]) & np.isfinite(before[source])
            if turns:
                change = short_way(change)
            value = np.fmin(np.fmax(HALF + change * gain, np.float32(0.0)), ONE)
            value = np.where(np.abs(value - HALF) < dead_zone, HALF, value)
            return np.where(is_finite, value, NAN)

        return read

    def row(self, scene: Scene) -> Row:
        """The inherited columns and `gain`: 0.5 / (range · tick)."""
        return {**SensorKind.row(self, scene), "gain": 0.5 / (scene.tick * self.range)}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """0.5 + change · gain, the short way round a circle; 0.5 in the first tick."""
        for k in range(sensor.width):
            out, now, before = s.readings[sensor.start + k], s.readings[sensor.source + k], s.before[sensor.before + k]
            for p in range(n):
                d = now[p] - before[p]
                d = short_way(d) if sensor.turns else d
                v = clamp(HALF + d * sensor.gain)
                v = HALF if abs(v - HALF) < sensor.dead_zone else v
                v = v if finite(d) else NAN  # of what is no number
                out[p] = v if s.tick[p] > 0 else HALF
            for p in range(n):
                before[p] = now[p]
