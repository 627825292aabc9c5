"""A claw, which takes items."""

from typing import Annotated

from mindrun.kinds.actuators.actuator import ActuatorKind, Row
from mindrun.kinds.bodies.body import BodyKind
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import LENGTH, RATIO, TICKS

REACH_UNITS = 1.5
CLOSED_COMMAND = 0.5  # command, above which it closes


@kind("actuator", "gripper")
class Gripper(ActuatorKind):
    """A claw at the front of the body: closed above 0.5. It takes an item ahead of it whose rim is within `reach`.

    It takes none through a wall, and none for which a wall leaves no room in front of it.
    A command acts `delay` ticks after the tick that computed it, with up to `noise` more or less.
    """

    neutral: Annotated[float, RATIO]
    reach: Annotated[float, LENGTH] = REACH_UNITS
    delay: Annotated[int, TICKS] = 0
    noise: Annotated[float, RATIO] = 0.0

    varying = ("delay", "noise")
    zero = 0.0

    @property
    def acts_at_rest(self) -> bool:
        """True if it is closed at its neutral command, or may be with its noise."""
        return self.neutral + self.noise > CLOSED_COMMAND

    def row(self, body: BodyKind) -> Row:
        """The columns of a gripper: reach in world units, and noise."""
        return {"reach": self.reach, "noise": self.noise}
