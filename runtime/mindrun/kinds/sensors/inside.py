"""The robot's being inside of a thing on the floor."""

from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Begin, Bounds, Physical
from mindrun.numbers.quantity import THING

if TYPE_CHECKING:  # a lane is given these when it is compiled
    from mindrun.numbers.arithmetic import ONE, ZERO, X, Y, inside


@kind("sensor", "inside")
class Inside(Physical):
    """1 while the robot's centre is inside the thing, or one of its name, else 0."""

    of: Annotated[str, THING]

    is_about = staticmethod(lambda kind: kind.is_area)  # what lies on the floor

    def first(self, begin: Begin) -> Bounds | None:
        """1 where the robot begins inside of the thing, 0 where not; None where noise hides that, or it is drawn."""
        there = None if self.noise else begin.is_within(self.of)
        return None if there is None else (float(there), float(there))

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """1 where the robot's centre is in the square of the thing."""
        out = s.readings[sensor.start]
        for p in range(n):
            out[p] = ZERO
        for i in range(sensor.thing, sensor.thing + sensor.things):
            for p in range(n):
                there = inside(s.things, i, s.body[X, p], s.body[Y, p], p)
                out[p] = ONE if there else out[p]
