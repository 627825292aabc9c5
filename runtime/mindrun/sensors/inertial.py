"""Whether the robot moves."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.quantity import POSITIVE, RATIO
from mindrun.registry import kind
from mindrun.sensors.sensor import Physical


@kind("sensor", "inertial")
@dataclass(frozen=True, slots=True)
class Inertial(Physical):
    """Whether the robot moves: its displacement over the last 20 ticks as a mean speed, 1 from `range` units/s on."""

    range: Annotated[float, POSITIVE] = 1.0
    dead_zone: Annotated[float, RATIO] = 0.0
