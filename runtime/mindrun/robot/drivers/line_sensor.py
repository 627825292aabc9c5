"""Reflectance sensors that say whether the floor below them is dark."""

from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.robot.driver_support import PIN, SWITCH, OpenSensor, digital_inputs


@kind("sensor driver", "line_sensor")
class LineSensor:
    """Digital line sensors (TCRT5000, QRE1113 with a comparator), for a sensor `floor`: 1 above a dark floor, else 0.

    `pins` lists their GPIO numbers in the order of the sensor's points. Most pins are at 3.3 V above a dark
    floor and at 0 V above a bright one; a sensor whose pins are the other way round is `inverted`, and so is one that
    follows a bright line on a dark floor. Those with a 5 V supply put out 5 V: bring it to 3.3 V with two resistors.
    """

    pins: Annotated[tuple[int, ...], PIN]
    inverted: Annotated[bool, SWITCH] = False

    unit = ""
    usual = (0.0, 1.0)
    possible = (0.0, 1.0)

    @property
    def readings(self) -> int:
        return len(self.pins)

    def open(self) -> OpenSensor:
        # Sensors drive their pins both ways, so nothing pulls at these.
        return digital_inputs("the line sensor", self.pins, pull_up=None, active_state=not self.inverted)
