"""What differs from run to run of a task: arguments that vary, actuators that fail."""

from dataclasses import dataclass
from typing import Annotated, Any, Literal

from mindrun.kinds.registry import arguments
from mindrun.numbers.quantity import RATIO, Quantity

Varying = Literal["actuator", "sensor", "body", "thing"]  # what an argument can be of that varies
VARIED_NOUNS: tuple[Varying, ...] = ("actuator", "sensor", "body")  # those of the robot


@dataclass(frozen=True, slots=True)
class Variation:
    """An argument that is drawn anew for each run, between `low` and `high`.

    It is of the body, or of the actuator, sensor or thing called `of`; whole numbers are drawn of what is whole.
    """

    noun: Varying
    of: str
    argument: str
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Failure:
    """An actuator that fails in each tick with the probability `rate`, and is neutral from then on."""

    actuator: str
    rate: Annotated[float, RATIO]


def varied_quantity(kind: Any, argument: str) -> Quantity | None:
    """What an argument of a kind is that can differ from run to run; None where it cannot."""
    found = (each.type for each in arguments(type(kind)) if each.field == argument and argument in kind.varying)
    return next((quantity for quantity in found if isinstance(quantity, Quantity)), None)
