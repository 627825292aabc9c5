"""GPIO pins that are read as on or off, a reading of each."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from mindrun.driver import DeviceError
from mindrun.robot.driver_support import library, pins


@dataclass(frozen=True, slots=True)
class DigitalInputsDevice:
    """Some pins; `what` is wired to them."""

    what: str
    inputs: tuple[Any, ...]

    def read(self) -> tuple[float, ...]:
        """1 for each that is active, else 0."""
        with pins(f"{self.what} cannot be read"):
            return tuple(1.0 if each.is_active else 0.0 for each in self.inputs)

    def close(self) -> None:
        """Let go of all of them."""
        for each in self.inputs:
            each.close()


def open_inputs(what: str, numbers: Sequence[int], **options: Any) -> DigitalInputsDevice:
    """The pins of these numbers, all with these `options` of gpiozero's DigitalInputDevice."""
    gpiozero, inputs = library("gpiozero"), list[Any]()
    try:
        for number in numbers:
            with pins(f"{what} on GPIO {number} cannot be opened"):
                inputs.append(gpiozero.DigitalInputDevice(number, **options))
    except DeviceError:
        DigitalInputsDevice(what, tuple(inputs)).close()
        raise
    return DigitalInputsDevice(what, tuple(inputs))
