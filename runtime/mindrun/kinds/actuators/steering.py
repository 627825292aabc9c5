"""The front wheels of a car, which steer it."""

from math import pi
from typing import Annotated

from mindrun.kinds.actuators.actuator import STOPPED_COMMAND, ActuatorKind, Row
from mindrun.kinds.bodies.body import BodyKind
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import RATIO, TICKS, Quantity

DEGREE = pi / 180
TURN = Quantity("an angle between 0 and 80 degrees", {"deg": DEGREE}, low=0.0, high=80 * DEGREE)


@kind("actuator", "steering")
class Steering(ActuatorKind):
    """The front wheels of a car: 0 is `range` to the left, 0.5 straight ahead, 1 `range` to the right, as a bearing.

    A command acts `delay` ticks after the tick that computed it, with up to `noise` more or less.
    """

    neutral: Annotated[float, RATIO]
    range: Annotated[float, TURN] = 30 * DEGREE
    delay: Annotated[int, TICKS] = 0
    noise: Annotated[float, RATIO] = 0.0

    varying = ("range", "delay", "noise")
    drive = "steering"

    @property
    def acts_at_rest(self) -> bool:
        """True if it turns at its neutral command, or may with its noise."""
        return (self.neutral != STOPPED_COMMAND or self.noise > 0) and self.range != 0.0

    def row(self, body: BodyKind) -> Row:
        """The largest angle, in radians, and its noise."""
        return {"turn": self.range, "noise": self.noise}
