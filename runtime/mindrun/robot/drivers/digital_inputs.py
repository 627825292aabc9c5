"""Sensors on GPIO pins that are high or low: a switch, the switches of a bumper, reflectance sensors above a line."""

from typing import Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.robot.driver_support import PIN, PULL, SWITCH, OpenSensor, Pull, Shares, open_inputs


def digital_inputs(what: str, numbers: tuple[int, ...], **options: Any) -> OpenSensor:
    """The pins of these numbers as inputs, all with these `options` of gpiozero's DigitalInputDevice."""
    parts = ((f"{what} on GPIO {number}", "DigitalInputDevice", {"pin": number, **options}) for number in numbers)
    return open_inputs(what, *parts)


@kind("sensor driver", "switch")
class Switch(Shares):
    """A switch or a bumper: 1 while it is closed, else 0; for a range finder `from: 1` and `to: 0`.

    It connects `pin` (a GPIO number) to ground; with `pull` "down", to 3.3 V.
    """

    pin: Annotated[int, PIN]
    pull: Annotated[Pull, PULL] = "up"

    readings = 1
    near = 1.0

    def open(self) -> OpenSensor:
        return digital_inputs("the switch", (self.pin,), pull_up=self.pull == "up")


@kind("sensor driver", "bumper")
class Bumper(Shares):
    """The switches of a bumper, for a sensor `bumper` or `contact`: of each 1 while it is touched, else 0.

    `pins` lists their GPIO numbers in the order of the sensor's sectors. Each connects its pin to ground when it is
    touched; with `pull` "down", to 3.3 V.
    """

    pins: Annotated[tuple[int, ...], PIN]
    pull: Annotated[Pull, PULL] = "up"

    near = 1.0

    @property
    def readings(self) -> int:
        return len(self.pins)

    def open(self) -> OpenSensor:
        return digital_inputs("the bumper", self.pins, pull_up=self.pull == "up")


@kind("sensor driver", "line_sensor")
class LineSensor(Shares):
    """Digital line sensors (TCRT5000, QRE1113 with a comparator), for a sensor `floor`: 1 above a dark floor, else 0.

    `pins` lists their GPIO numbers in the order of the sensor's points. Most pins are at 3.3 V above a dark
    floor and at 0 V above a bright one; a sensor whose pins are the other way round is `inverted`, and so is one that
    follows a bright line on a dark floor. Those with a 5 V supply put out 5 V: bring it to 3.3 V with two resistors.
    """

    pins: Annotated[tuple[int, ...], PIN]
    inverted: Annotated[bool, SWITCH] = False

    @property
    def readings(self) -> int:
        return len(self.pins)

    def open(self) -> OpenSensor:
        # Sensors drive their pins both ways, so nothing pulls at these.
        return digital_inputs("the line sensor", self.pins, pull_up=None, active_state=not self.inverted)
