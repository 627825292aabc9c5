"""A servo on a GPIO pin."""

from dataclasses import dataclass
from typing import Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.robot.driver_support import MICROSECONDS, PIN, library, on_pin, pins, share

FRAME_SECONDS = 0.02  # between two pulses


@dataclass(frozen=True, slots=True)
class PinServoDevice:
    """One servo."""

    servo: Any

    def write(self, value: float) -> None:
        """Command the pulse for a share of the travel."""
        travelled = share(value)
        with pins("the servo cannot be driven"):
            self.servo.value = 2 * travelled - 1

    def close(self) -> None:
        """End the pulses, and let go."""
        self.servo.close()


@kind("actuator driver", "servo")
@dataclass(frozen=True, slots=True)
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
        """What only one process may drive."""
        return on_pin(self.pin)

    def open(self) -> PinServoDevice:
        """The servo, which does not move until it is commanded."""
        gpiozero = library("gpiozero")
        with pins(f"the servo on GPIO {self.pin} cannot be opened"):
            widths = {"min_pulse_width": self.shortest * 1e-6, "max_pulse_width": self.longest * 1e-6}
            return PinServoDevice(gpiozero.Servo(self.pin, initial_value=None, frame_width=FRAME_SECONDS, **widths))
