"""Drivers of a user: one that is whole, and some that are not."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.robot.driver_support import METRES, PIN


@dataclass(frozen=True)
class Sonar:
    """A range finder that refuses some ranges."""

    pin: Annotated[int, PIN] = 13
    range: Annotated[float, METRES] = 1.0

    unit = "m"
    readings = 1
    usual = (0.0, 1.0)

    def __post_init__(self) -> None:
        if self.range == 9.0:
            raise ValueError("no sound comes back from 9 m")
        if self.range == 8.0:
            raise KeyError("range")

    def open(self) -> None:
        """No device."""


@dataclass
class Thawed:
    """A class whose options could change."""

    def open(self) -> None:
        """No device."""


@dataclass(frozen=True)
class Shut:
    """A class without a device."""


@dataclass(frozen=True)
class Tail:
    """A driver of an actuator."""

    def open(self) -> None:
        """No device."""
