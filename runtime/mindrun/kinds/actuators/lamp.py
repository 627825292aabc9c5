"""A lamp, which pictures show."""

from typing import Annotated

from mindrun.kinds.actuators.actuator import ActuatorKind
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import RATIO, TICKS


@kind("actuator", "lamp")
class Lamp(ActuatorKind):
    """A lamp: 0 dark, 1 bright. It changes nothing in the simulated world, and pictures show it."""

    neutral: Annotated[float, RATIO]
    delay: Annotated[int, TICKS] = 0

    zero = 0.0
    is_light = True
