"""The robot's speed along its heading."""

from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Physical, Row, Scene
from mindrun.numbers.quantity import POSITIVE, RATIO

if TYPE_CHECKING:  # a lane is given these when it is compiled
    from mindrun.numbers.arithmetic import COSINE, HALF, SINE, SPEED_X, SPEED_Y, F, clamp


@kind("sensor", "speed")
class Speed(Physical):
    """Speed along the heading: 0.5 standing, 1 forward with `range` units a second or more, 0 backward.

    0.5 + 0.5 · speed / range; what the body slides aside does not count. Within `dead_zone` of 0.5 it reads 0.5.
    """

    range: Annotated[float, POSITIVE] = 10.0
    dead_zone: Annotated[float, RATIO] = 0.0

    scaled = True
    unit = "m/s"
    blank = rest = still = 0.5

    def row(self, scene: Scene) -> Row:
        """The inherited columns and the gain of a unit a second."""
        return {**Physical.row(self, scene), "gain": 0.5 / self.range}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """0.5 + speed · gain."""
        out, x, y = s.readings[sensor.start], s.body[SPEED_X], s.body[SPEED_Y]
        for p in range(n):
            ahead = x[p] * s.heading[COSINE, p] + y[p] * s.heading[SINE, p]
            v = clamp(HALF + F(ahead * sensor.gain))
            out[p] = HALF if abs(v - HALF) < sensor.dead_zone else v
