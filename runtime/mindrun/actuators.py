"""Kinds of actuators. `neutral` is sent when nothing influences the actuator and whenever something fails."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.quantity import LENGTH, RATIO, TICKS, Quantity, Reference
from mindrun.registry import kind

SIDE = Reference("side", ("left", "right"))
THRUST = Quantity("a force", {"": 1.0}, low=-1e6, high=1e6)


@kind("actuator", "wheel")
@dataclass(frozen=True, slots=True)
class Wheel:
    """A wheel on the body's rim: 0 full reverse, 0.5 stopped, 1 full forward; force (2v − 1)·thrust along the heading.

    A command acts `delay` ticks after the tick that computed it.
    """

    side: Annotated[str, SIDE]
    neutral: Annotated[float, RATIO]
    thrust: Annotated[float, THRUST] = 80.0
    delay: Annotated[int, TICKS] = 0


@kind("actuator", "gripper")
@dataclass(frozen=True, slots=True)
class Gripper:
    """A claw at the front of the body: closed above 0.5. It takes an item ahead of it whose rim is within `reach`."""

    neutral: Annotated[float, RATIO]
    reach: Annotated[float, LENGTH] = 1.5
    delay: Annotated[int, TICKS] = 0


@kind("actuator", "servo")
@dataclass(frozen=True, slots=True)
class Servo:
    """A servo: its position as a share of its travel. It moves nothing in the simulated world."""

    neutral: Annotated[float, RATIO]
    delay: Annotated[int, TICKS] = 0
