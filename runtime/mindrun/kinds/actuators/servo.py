"""A servo, which moves nothing in the simulated world."""

from typing import Annotated

from mindrun.kinds.actuators.actuator import ActuatorKind
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import RATIO, TICKS


@kind("actuator", "servo")
class Servo(ActuatorKind):
    """A servo: its position as a share of its travel. It moves nothing in the simulated world."""

    neutral: Annotated[float, RATIO]
    delay: Annotated[int, TICKS] = 0
