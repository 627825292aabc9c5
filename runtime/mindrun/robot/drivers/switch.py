"""A switch between a GPIO pin and ground, or 3.3 V."""

from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.robot.driver_support import PIN, PULL, OpenSensor, Pull, digital_inputs


@kind("sensor driver", "switch")
class Switch:
    """A switch or a bumper: 1 while it is closed, else 0; for a range finder `from: 1` and `to: 0`.

    It connects `pin` (a GPIO number) to ground; with `pull` "down", to 3.3 V.
    """

    pin: Annotated[int, PIN]
    pull: Annotated[Pull, PULL] = "up"

    unit = ""
    readings = 1
    usual = (0.0, 1.0)
    possible = (0.0, 1.0)
    near = 1.0

    def open(self) -> OpenSensor:
        return digital_inputs("the switch", (self.pin,), pull_up=self.pull == "up")
