"""Movement of the robot, whatever its direction."""

from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Physical, Row, Scene
from mindrun.numbers.quantity import POSITIVE, RATIO

if TYPE_CHECKING:  # a lane is given these when it is compiled
    import numpy as np

    from mindrun.numbers.arithmetic import ZERO, F, X, Y, clamp

TRAIL_TICKS = 20  # over which the displacement is taken


@kind("sensor", "inertial")
class Inertial(Physical):
    """Movement of the robot: its displacement over the last 20 ticks as a mean speed, 1 from `range` units/s on."""

    range: Annotated[float, POSITIVE] = 1.0
    dead_zone: Annotated[float, RATIO] = 0.0

    still = 0.0

    def row(self, scene: Scene) -> Row:
        """The speed that reads 1 as a gain of the displacement."""
        return {**Physical.row(self, scene), "gain": 1.0 / (TRAIL_TICKS * scene.tick * self.range)}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """The displacement since the oldest place of the trail, as a share of `range`."""
        oldest = clock % TRAIL_TICKS
        out, x, y = s.readings[sensor.start], s.trail[2 * oldest], s.trail[2 * oldest + 1]
        for p in range(n):
            dx, dy = s.body[X, p] - x[p], s.body[Y, p] - y[p]
            v = clamp(F(np.sqrt(dx * dx + dy * dy)) * sensor.gain)
            out[p] = ZERO if v < sensor.dead_zone else v
