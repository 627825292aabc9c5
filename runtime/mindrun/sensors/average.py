"""The mean of a sensor over some ticks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

from mindrun.quantity import SENSOR, WINDOW
from mindrun.registry import kind
from mindrun.sensors.sensor import Row, Scene, SensorKind

if TYPE_CHECKING:  # a lane is given these when it is compiled
    from mindrun.arithmetic import F
    from mindrun.arrays import Reader, Readings


@kind("sensor", "average")
@dataclass(frozen=True, slots=True)
class Average(SensorKind):
    """The mean of another sensor's readings over the last ticks; in the first ones, over as many as there were.

    Of a bearing it is no direction: halfway between 0.99 and 0.01 is 0.5, which is the other way.
    """

    of: Annotated[str, SENSOR]
    over: Annotated[int, WINDOW]

    @property
    def remembered(self) -> int:  # type: ignore[override]
        """The readings of the last ticks."""
        return self.over

    @property
    def width(self) -> None:
        """As many as its source."""
        return

    @property
    def source(self) -> str:
        """The sensor whose mean it is."""
        return self.of

    def reader(self, scene: Scene) -> Reader:
        """The sum in float64, in the order in which the last readings lie in a ring, over how many they are."""
        import numpy as np

        source = scene.places[self.of]
        ring: list[Readings] = []

        def read(number: int, now: Readings, before: Readings | None) -> Readings:
            ring[number % self.over : number % self.over + 1] = [now[source].astype(np.float64)]
            total = np.zeros(source.stop - source.start)
            for readings in ring:
                total = total + readings
            return (total / len(ring)).astype(np.float32)

        return read

    def row(self, scene: Scene) -> Row:
        """Where its source stands, and over how many ticks."""
        return {"source": scene.starts[self.of], "over": self.over}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """The mean of a ring of readings."""
        total = s.stack[0]
        for k in range(sensor.width):
            first = sensor.before + k * sensor.over
            out, now = s.readings[sensor.start + k], s.readings[sensor.source + k]
            for p in range(n):
                s.before[first + s.tick[p] % sensor.over, p] = now[p]
                total[p] = 0.0
            for i in range(sensor.over):
                for p in range(n):
                    total[p] += s.before[first + i, p] if i <= s.tick[p] else 0.0
            for p in range(n):
                out[p] = F(total[p] / min(s.tick[p] + 1, sensor.over))
