"""A lamp on a GPIO pin."""

from dataclasses import dataclass
from typing import Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.robot.driver_support import PIN, PWM_HERTZ, library, on_pin, pins, share


@dataclass(frozen=True, slots=True)
class LampDevice:
    """A lamp."""

    led: Any

    def write(self, value: float) -> None:
        """Command a brightness: 0 off, 1 all of it."""
        brightness = share(value)
        with pins("the lamp cannot be driven"):
            self.led.value = brightness

    def close(self) -> None:
        """Turn it off, and let go."""
        self.led.close()


@kind("actuator driver", "lamp")
@dataclass(frozen=True, slots=True)
class Lamp:
    """A lamp, an LED or a small fan that a GPIO `pin` switches: 0 is off, 1 on, between them it is dimmed by pulses.

    A pin gives no more than 16 mA: an LED with 330 Ω takes 4 of them, whatever needs more hangs on a transistor.
    """

    pin: Annotated[int, PIN]
    frequency: Annotated[float, PWM_HERTZ] = 200.0

    @property
    def device(self) -> str:
        """What only one process may drive."""
        return on_pin(self.pin)

    def open(self) -> LampDevice:
        """The lamp, off."""
        gpiozero = library("gpiozero")
        with pins(f"the lamp on GPIO {self.pin} cannot be opened"):
            return LampDevice(gpiozero.PWMLED(self.pin, frequency=self.frequency))
