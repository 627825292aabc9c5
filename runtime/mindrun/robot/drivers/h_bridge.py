"""A motor on an H-bridge (L298N, TB6612, DRV8833): two pins for the direction, and pulses for the speed."""

from dataclasses import dataclass
from typing import Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.robot.driver_support import PIN, PWM_HERTZ, close_all, on_pin, open_pins, pins, share


@dataclass(frozen=True, slots=True)
class HBridgeDevice:
    """One motor; without `enable` the speed is in the pulses of the direction's pin."""

    forward: Any
    backward: Any
    enable: Any = None

    def write(self, value: float) -> None:
        """Command a speed: 0 full reverse, 0.5 stopped, 1 full forward."""
        speed = 2 * share(value) - 1
        on, off = (self.forward, self.backward) if speed > 0 else (self.backward, self.forward)
        with pins("the H-bridge cannot be driven"):
            if self.enable is None:
                off.value = 0
                on.value = abs(speed)
                return
            if off.value or not speed:  # never the other way round at the speed that was meant this way
                self.enable.value = 0
            off.value = 0
            on.value = speed != 0
            self.enable.value = abs(speed)

    def close(self) -> None:
        close_all(pin for pin in (self.enable, self.forward, self.backward) if pin is not None)


@kind("actuator driver", "h_bridge")
class HBridge:
    """A motor on half of an H-bridge: a `wheel`, a `thruster`, whatever turns both ways.

    `forward` and `backward` are the GPIO numbers of its inputs: IN1 and IN2 of an L298N, AIN1 and AIN2 of a TB6612 or
    DRV8833. `enable` is that of ENA, PWMA: the speed is in its pulses. A DRV8833 has none, there the pulses are those
    of the direction. STBY and SLEEP belong to 3.3 V. 0 is full reverse, 0.5 stopped, 1 full forward; a wheel that turns
    the wrong way is `reversed`. Pins go low when the process ends; a resistor of 10 kΩ from each to ground holds them
    there while the Raspberry Pi starts.
    """

    forward: Annotated[int, PIN]
    backward: Annotated[int, PIN]
    enable: Annotated[int | None, PIN] = None
    frequency: Annotated[float, PWM_HERTZ] = 1000.0

    @property
    def device(self) -> str:
        return on_pin(self.forward)

    def open(self) -> HBridgeDevice:
        """The motor, stopped."""
        parts = {}
        for name in ("enable", "forward", "backward"):
            if (number := getattr(self, name)) is not None:
                has_pulses = name == "enable" or self.enable is None
                pulses = {"frequency": self.frequency} if has_pulses else {}
                kind = "PWMOutputDevice" if has_pulses else "OutputDevice"
                parts[name] = f"the H-bridge's {name} pin, GPIO {number},", kind, {"pin": number, **pulses}
        return HBridgeDevice(**dict(zip(parts, open_pins(*parts.values()), strict=True)))
