"""A lamp on a GPIO pin."""

from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.robot.driver_support import PIN, PWM_HERTZ, OutputPin, on_pin, open_pins


@kind("actuator driver", "lamp")
class Lamp:
    """A lamp, an LED or a small fan that a GPIO `pin` switches: 0 is off, 1 on, between them it is dimmed by pulses.

    A pin gives no more than 16 mA: an LED with 330 Ω takes 4 of them, whatever needs more hangs on a transistor.
    """

    pin: Annotated[int, PIN]
    frequency: Annotated[float, PWM_HERTZ] = 200.0

    @property
    def device(self) -> str:
        return on_pin(self.pin)

    def open(self) -> OutputPin:
        """The lamp, off."""
        [led] = open_pins((f"the lamp on GPIO {self.pin}", "PWMLED", {"pin": self.pin, "frequency": self.frequency}))
        return OutputPin("the lamp", led)
