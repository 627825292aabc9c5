"""How the robot moves, and where it is."""

from math import pi
from typing import TYPE_CHECKING, Annotated, Any, Literal, get_args

from mindrun.kinds.actuators.actuator import SIDE, ActuatorKind, Side
from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Physical, Row, Scene
from mindrun.numbers.quantity import Positive, Quantity, Ratio, Reference

if TYPE_CHECKING:  # a lane is given these when it is compiled
    import numpy as np

    from mindrun.numbers.arithmetic import *


class Signed(Physical):
    """A measure of two directions: 0.5 is nothing, 1 is `range` or more in one, 0 in the other."""

    __slots__ = ()

    range: float

    scaled = True
    blank = 0.5

    def gain(self, scene: Scene) -> float:
        """0.5 / range."""
        return 0.5 / self.range


@kind("sensor", "speed")
class Speed(Signed):
    """Speed along the heading: 0.5 standing, 1 forward with `range` units a second or more, 0 backward.

    0.5 + 0.5 · speed / range; what the body slides aside does not count. Within `dead_zone` of 0.5 it reads 0.5.
    """

    range: Positive = 10.0
    dead_zone: Ratio = 0.0

    unit = "m/s"
    rest = still = 0.5

    def sees(self, actuator: ActuatorKind) -> bool:
        return actuator.drive == "motor"

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        out, x, y = s.readings[sensor.start], s.body[SPEED_X], s.body[SPEED_Y]
        for p in range(n):
            ahead = x[p] * s.heading[COSINE, p] + y[p] * s.heading[SINE, p]
            v = clamp(HALF + F(ahead * sensor.gain))
            out[p] = HALF if abs(v - HALF) < sensor.dead_zone else v


@kind("sensor", "odometer")
class Odometer(Signed):
    """Speed of a wheel on the body's rim, as its encoder counts it: 0.5 standing, 1 forward with `range` units/s.

    0.5 + 0.5 · (distance a second) / range, 0 backward; the wheel rolls as its side of the body moves along the heading
    and never slips. The driver `encoder` measures it with `measure: speed`.
    """

    side: Annotated[Side, SIDE]
    range: Positive = 10.0

    unit = "m/s"
    rest = still = 0.5

    def sees(self, actuator: ActuatorKind) -> bool:
        return actuator.is_motor and actuator.mounted == self.side

    def row(self, scene: Scene) -> Row:
        return {**Signed.row(self, scene), "part": 1 if self.side == "right" else -1}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        arm = t.world[0].side if sensor.part > 0 else -t.world[0].side
        out, x, y, spin = s.readings[sensor.start], s.body[SPEED_X], s.body[SPEED_Y], s.body[SPIN]
        for p in range(n):
            ahead = x[p] * s.heading[COSINE, p] + y[p] * s.heading[SINE, p] + arm * spin[p]
            out[p] = clamp(HALF + F(ahead * sensor.gain))


TURNING = Quantity("an angle a second", {"deg": pi / 180}, low=pi / 1800, high=2000 * pi)


@kind("sensor", "turn_rate")
class TurnRate(Signed):
    """How fast the robot turns, as a gyroscope says it: 0.5 not at all, 1 to the right with `range` deg/s, 0 left.

    0.5 − 0.5 · turning / range, counterclockwise positive. Within `dead_zone` of 0.5 it reads 0.5.
    """

    range: Annotated[float, TURNING] = pi
    dead_zone: Ratio = 0.0

    rest = still = 0.5

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        out, spin = s.readings[sensor.start], s.body[SPIN]
        for p in range(n):
            v = clamp(HALF - F(spin[p] * sensor.gain))
            out[p] = HALF if abs(v - HALF) < sensor.dead_zone else v


TRAIL_TICKS = 20  # over which the displacement is taken


@kind("sensor", "inertial")
class Inertial(Physical):
    """Movement of the robot: its displacement over the last 20 ticks as a mean speed, 1 from `range` units/s on."""

    range: Positive = 1.0
    dead_zone: Ratio = 0.0

    still = 0.0

    def gain(self, scene: Scene) -> float:
        return 1.0 / (TRAIL_TICKS * scene.tick * self.range)

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        oldest = clock % TRAIL_TICKS
        out, x, y = s.readings[sensor.start], s.trail[2 * oldest], s.trail[2 * oldest + 1]
        for p in range(n):
            dx, dy = s.body[X, p] - x[p], s.body[Y, p] - y[p]
            v = clamp(F(np.sqrt(dx * dx + dy * dy)) * sensor.gain)
            out[p] = ZERO if v < sensor.dead_zone else v


Axis = Literal["x", "y"]


@kind("sensor", "position")
class Position(Signed):
    """Place of the robot's middle along an axis, as beacons tell it: 0.5 the origin, 1 from `range` units on.

    0.5 + 0.5 · x / range, or y, and 0 from −range on; the origin is the middle of an arena, y points north.
    """

    along: Annotated[Axis, Reference("axis", get_args(Axis))]
    range: Positive = 50.0

    unit = "m"

    def row(self, scene: Scene) -> Row:
        return {**Signed.row(self, scene), "part": get_args(Axis).index(self.along)}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        out, place = s.readings[sensor.start], s.body[sensor.part]
        for p in range(n):
            out[p] = clamp(HALF + F(place[p] * sensor.gain))
