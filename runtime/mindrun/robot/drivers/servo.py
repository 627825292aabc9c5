"""A servo on a GPIO pin."""

from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.robot.driver_support import MICROSECONDS, PIN, OutputPin, on_pin, open_pins

FRAME_SECONDS = 0.02  # between two pulses


@kind("actuator driver", "servo")
class PinServo:
    """A servo, the steering of a car, or a speed controller that takes servo pulses, on a GPIO `pin`.

    Its supply is one of its own, with the same ground. Command 0 is the pulse `shortest`, 1 `longest`, 50 times a
    second. Where steering turns the wrong way it is `reversed`. The pulses are made by a program, so they tremble by
    some ten microseconds: where that shows, take a servo card (`pca9685`). Without pulses a servo lets go.
    """

    pin: Annotated[int, PIN]
    shortest: Annotated[float, MICROSECONDS] = 1000.0
    longest: Annotated[float, MICROSECONDS] = 2000.0

    @property
    def device(self) -> str:
        return on_pin(self.pin)

    def open(self) -> OutputPin:
        """The servo, which does not move until it is commanded."""
        pulses = {
            "initial_value": None, "frame_width": FRAME_SECONDS,
            "min_pulse_width": self.shortest * 1e-6, "max_pulse_width": self.longest * 1e-6,
        }  # fmt: skip
        [servo] = open_pins((f"the servo on GPIO {self.pin}", "Servo", {"pin": self.pin, **pulses}))
        return OutputPin("the servo", servo, low=-1.0)
