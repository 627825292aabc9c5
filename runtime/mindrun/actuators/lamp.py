"""What shines."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.actuators.actuator import ActuatorKind
from mindrun.quantity import RATIO, TICKS
from mindrun.registry import kind


@kind("actuator", "lamp")
@dataclass(frozen=True, slots=True)
class Lamp(ActuatorKind):
    """A lamp: 0 dark, 1 bright. It changes nothing in the simulated world, and pictures show it."""

    neutral: Annotated[float, RATIO]
    delay: Annotated[int, TICKS] = 0

    zero = 0.0
    is_light = True
