"""What drives the body."""

from dataclasses import dataclass
from typing import Annotated, get_args

from mindrun.actuators.actuator import ActuatorKind, Row, Side
from mindrun.quantity import RATIO, TICKS, Quantity, Reference
from mindrun.registry import kind

SIDE = Reference("side", get_args(Side))
THRUST = Quantity("a force", {"": 1.0}, low=-1e6, high=1e6)
STOPPED_COMMAND = 0.5  # command


@kind("actuator", "wheel")
@dataclass(frozen=True, slots=True)
class Wheel(ActuatorKind):
    """A wheel on the body's rim: 0 full reverse, 0.5 stopped, 1 full forward; force (2v − 1)·thrust along the heading.

    A command acts `delay` ticks after the tick that computed it.
    """

    side: Annotated[Side, SIDE]
    neutral: Annotated[float, RATIO]
    thrust: Annotated[float, THRUST] = 80.0
    delay: Annotated[int, TICKS] = 0

    moves_body = True

    @property
    def mounted(self) -> Side:
        """Its side."""
        return self.side

    @property
    def acts_at_rest(self) -> bool:
        """Whether it pushes."""
        return self.neutral != STOPPED_COMMAND and self.thrust != 0.0

    def row(self) -> Row:
        """How strongly it pushes."""
        return {"thrust": self.thrust}
