"""A wheel beside the body, which drives it."""

from typing import Annotated, get_args

from mindrun.kinds.actuators.actuator import THRUST, Pushing, Side
from mindrun.kinds.bodies.body import BodyKind, Point
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import RATIO, TICKS, Reference

SIDE = Reference("side", get_args(Side))


@kind("actuator", "wheel")
class Wheel(Pushing):
    """A wheel on the body's rim: 0 full reverse, 0.5 stopped, 1 full forward; force (2v − 1)·thrust along the heading.

    A command acts `delay` ticks after the tick that computed it, with up to `noise` more or less; up to `slip` of the
    force is lost, anew in every tick.
    """

    side: Annotated[Side, SIDE]
    neutral: Annotated[float, RATIO]
    thrust: Annotated[float, THRUST] = 80.0
    delay: Annotated[int, TICKS] = 0
    noise: Annotated[float, RATIO] = 0.0
    slip: Annotated[float, RATIO] = 0.0

    drive = "wheel"

    @property
    def mounted(self) -> Side:
        """The side of the body that it is on."""
        return self.side

    def place(self, body: BodyKind) -> Point:
        """A point beside the body's middle, on the wheel's side."""
        return 0.0, body.side if self.side == "left" else -body.side
