"""What turns something on the robot."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.actuators.actuator import ActuatorKind
from mindrun.quantity import RATIO, TICKS
from mindrun.registry import kind


@kind("actuator", "servo")
@dataclass(frozen=True, slots=True)
class Servo(ActuatorKind):
    """A servo: its position as a share of its travel. It moves nothing in the simulated world."""

    neutral: Annotated[float, RATIO]
    delay: Annotated[int, TICKS] = 0
