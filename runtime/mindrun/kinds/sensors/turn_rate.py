"""The robot's rate of turn."""

from math import pi
from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Physical, Row, Scene
from mindrun.numbers.quantity import RATIO, Quantity

if TYPE_CHECKING:  # a lane is given these when it is compiled
    from mindrun.numbers.arithmetic import HALF, SPIN, F, clamp

TURNING = Quantity("an angle a second", {"deg": pi / 180}, low=pi / 1800, high=2000 * pi)


@kind("sensor", "turn_rate")
class TurnRate(Physical):
    """How fast the robot turns, as a gyroscope says it: 0.5 not at all, 1 to the right with `range` deg/s, 0 left.

    0.5 − 0.5 · turning / range, counterclockwise positive. Within `dead_zone` of 0.5 it reads 0.5.
    """

    range: Annotated[float, TURNING] = pi
    dead_zone: Annotated[float, RATIO] = 0.0

    scaled = True
    blank = rest = still = 0.5

    def row(self, scene: Scene) -> Row:
        """The inherited columns and the gain of a radian a second."""
        return {**Physical.row(self, scene), "gain": 0.5 / self.range}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """0.5 − spin · gain."""
        out, spin = s.readings[sensor.start], s.body[SPIN]
        for p in range(n):
            v = clamp(HALF - F(spin[p] * sensor.gain))
            out[p] = HALF if abs(v - HALF) < sensor.dead_zone else v
