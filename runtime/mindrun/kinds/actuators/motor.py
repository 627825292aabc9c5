"""The drive of a car."""

from typing import Annotated

from mindrun.kinds.actuators.actuator import THRUST, Pushing
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import RATIO, TICKS


@kind("actuator", "motor")
class Motor(Pushing):
    """The drive of a car: 0 full reverse, 0.5 stopped, 1 full forward; force (2v − 1)·thrust along the heading.

    A command acts `delay` ticks after the tick that computed it, with up to `noise` more or less; up to `slip` of the
    force is lost, anew in every tick.
    """

    neutral: Annotated[float, RATIO]
    thrust: Annotated[float, THRUST] = 160.0
    delay: Annotated[int, TICKS] = 0
    noise: Annotated[float, RATIO] = 0.0
    slip: Annotated[float, RATIO] = 0.0

    drive = "motor"
