"""The mean of a sensor over some ticks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Scene, SensorKind
from mindrun.numbers.quantity import SENSOR, WINDOW

if TYPE_CHECKING:  # a lane is given these when it is compiled
    import numpy as np
    from numpy.typing import NDArray

    from mindrun.numbers.arithmetic import F, short_way, wrapped
    from mindrun.numbers.arrays import Reader, Readings


@kind("sensor", "average")
class Average(SensorKind):
    """The mean of another sensor's readings over the last ticks; in the first ones, over as many as there were.

    Of a direction it is one: the last reading, turned by the mean of the short ways from it to each. Of 0.98 and 0.01
    that is 0.995; as numbers it would be 0.495, the other way.
    """

    of: Annotated[str, SENSOR]
    over: Annotated[int, WINDOW]

    circular = shape = None

    @property
    def remembered(self) -> int:  # type: ignore[override]
        """One number for each tick of the window."""
        return self.over

    def reader(self, scene: Scene) -> Reader:
        """The mean in float64 of a ring of the last readings, summed in the order in which they lie there."""
        import numpy as np

        from mindrun.numbers.arithmetic import short_way

        source, turns = scene.places[self.of], self.of in scene.directions
        ring: list[NDArray[np.float64]] = []

        def read(number: int, now: Readings, before: Readings | None) -> Readings:
            last = now[source].astype(np.float64)
            ring[number % self.over : number % self.over + 1] = [last]
            total = np.zeros(source.stop - source.start)
            for readings in ring:
                total = total + (short_way(readings - last) if turns else readings)
            mean = total / len(ring)
            if turns:
                mean = last + mean
                mean = np.where(mean < 0, mean + 1, np.where(mean > 1, mean - 1, mean))
            return mean.astype(np.float32)

        return read

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """Put each reading into its ring, and average the ring in float64, in the order of `reader`."""
        total = s.stack[0]
        for k in range(sensor.width):
            first = sensor.before + k * sensor.over
            out, now = s.readings[sensor.start + k], s.readings[sensor.source + k]
            for p in range(n):
                s.before[first + s.tick[p] % sensor.over, p] = now[p]
                total[p] = 0.0
            for i in range(sensor.over):
                for p in range(n):
                    v = np.float64(s.before[first + i, p])
                    v = short_way(v - now[p]) if sensor.turns else v
                    total[p] += v if i <= s.tick[p] else 0.0
            for p in range(n):
                mean = total[p] / min(s.tick[p] + 1, sensor.over)
                out[p] = F(wrapped(now[p] + mean) if sensor.turns else mean)
