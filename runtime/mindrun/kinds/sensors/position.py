"""The place of the robot along an axis of its world."""

from typing import TYPE_CHECKING, Annotated, Any, Literal, get_args

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Physical, Row, Scene
from mindrun.numbers.quantity import POSITIVE, Reference

if TYPE_CHECKING:  # a lane is given these when it is compiled
    from mindrun.numbers.arithmetic import HALF, F, clamp

Axis = Literal["x", "y"]


@kind("sensor", "position")
class Position(Physical):
    """Place of the robot's middle along an axis, as beacons tell it: 0.5 the origin, 1 from `range` units on.

    0.5 + 0.5 · x / range, or y, and 0 from −range on; the origin is the middle of an arena, y points north.
    """

    along: Annotated[Axis, Reference("axis", get_args(Axis))]
    range: Annotated[float, POSITIVE] = 50.0

    scaled = True
    unit = "m"
    blank = 0.5

    def row(self, scene: Scene) -> Row:
        """The gain of a unit, and the axis as `part`, a row of the body."""
        from mindrun.numbers.arithmetic import X, Y

        return {"gain": 0.5 / self.range, "part": X if self.along == "x" else Y}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """0.5 + place · gain."""
        out, place = s.readings[sensor.start], s.body[sensor.part]
        for p in range(n):
            out[p] = clamp(HALF + F(place[p] * sensor.gain))
