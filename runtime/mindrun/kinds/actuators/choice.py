"""One of the few actions of an environment that takes one of them."""

from typing import Annotated

from mindrun.kinds.actuators.actuator import ActuatorKind
from mindrun.kinds.environment import Slot
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import INDEX, RATIO, SLOT, TICKS


@kind("actuator", "choice")
class Choice(ActuatorKind):
    """One of the actions of a Gymnasium environment that takes one of a few, by its number; the first is 0.

    In each tick that whose command is the largest is taken; of equal ones, the first that is declared. Where the
    environment takes several at once (`MultiDiscrete`), the place stands before the number.
    """

    choice: Annotated[tuple[int, ...], INDEX]
    neutral: Annotated[float, RATIO]
    part: Annotated[str, SLOT] = ""
    delay: Annotated[int, TICKS] = 0

    @property
    def slot(self) -> Slot:
        """The place at which it is chosen: the only one, where none is said."""
        return Slot(self.part, self.choice[:-1] or (0,), chosen=self.choice[-1])
