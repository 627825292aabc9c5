"""A bumper: switches around a body, each of which closes where it is touched."""

from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.robot.driver_support import PIN, PULL, OpenSensor, Pull, digital_inputs


@kind("sensor driver", "bumper")
class Bumper:
    """The switches of a bumper, for a sensor `bumper` or `contact`: of each 1 while it is touched, else 0.

    `pins` lists their GPIO numbers in the order of the sensor's sectors. Each connects its pin to ground when it is
    touched; with `pull` "down", to 3.3 V.
    """

    pins: Annotated[tuple[int, ...], PIN]
    pull: Annotated[Pull, PULL] = "up"

    unit = ""
    usual = (0.0, 1.0)
    possible = (0.0, 1.0)
    near = 1.0

    @property
    def readings(self) -> int:
        return len(self.pins)

    def open(self) -> OpenSensor:
        return digital_inputs("the bumper", self.pins, pull_up=self.pull == "up")
