"""One number of an environment's action."""

from typing import Annotated

from mindrun.kinds.actuators.actuator import ActuatorKind
from mindrun.kinds.environment import Slot
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import INDEX, NUMBER, RATIO, SLOT, TICKS, UNSAID, Span


@kind("actuator", "action")
class Action(ActuatorKind):
    """One number of a Gymnasium environment's action: a command of 0 is the low end of its range, 1 the high end.

    The first number is 0; of an array, one index for each axis; of a `Dict`, the name of the part goes before them,
    of a `Tuple` its number.
    The `range` is what the environment says, unless it is given, and has to be where the environment says none.
    """

    action: Annotated[tuple[int, ...], INDEX]
    neutral: Annotated[float, RATIO]
    range: Annotated[Span, NUMBER] = UNSAID
    part: Annotated[str, SLOT] = ""
    delay: Annotated[int, TICKS] = 0

    @property
    def slot(self) -> Slot:
        """The number of the environment's action that the arguments name."""
        return Slot(self.part, self.action, None if self.range == UNSAID else self.range)
