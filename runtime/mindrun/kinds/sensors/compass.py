"""Directions of the world and of what turns on the robot."""

from typing import TYPE_CHECKING, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Physical
from mindrun.numbers.quantity import Ratio, ServoName

if TYPE_CHECKING:  # a lane is given these when it is compiled
    import numpy as np

    from mindrun.numbers.arithmetic import *


@kind("sensor", "compass")
class Compass(Physical):
    """Direction of north, where the world's y axis points: 0.5 straight ahead, less on the left, more on the right.

    Within `dead_zone` of straight ahead it reads 0.5. It goes round: noise leads from 0 to 1, which are both behind.
    """

    dead_zone: Ratio = 0.0

    circular = True
    scaled = True
    blank = rest = 0.5

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        out = s.readings[sensor.start]
        for p in range(n):
            v = bearing(F(s.heading[SINE, p]), F(s.heading[COSINE, p]))
            out[p] = HALF if abs(v - HALF) < sensor.dead_zone else v


@kind("sensor", "direction")
class Direction(Physical):
    """Direction in which a servo looks: 0.5 straight ahead, less on the left, more on the right, as a bearing.

    It goes round: noise leads from 0 to 1, which are both behind. It is where the servo is as the tick begins, and not
    where it is sent. On a robot it is reckoned from what the servo was sent, where robot.yaml names no driver for it.
    """

    of: ServoName

    circular = True
    scaled = True
    tells_servo = True
    needs_driver = False
    blank = 0.5

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        out, angles = s.readings[sensor.start], s.swivel[sensor.servo]
        for p in range(n):
            out[p] = F(0.5 - angles[p] / (2.0 * np.pi))
