"""A switch between a GPIO pin and ground, or 3.3 V."""

from dataclasses import dataclass
from typing import Annotated, Any, Literal, get_args

from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import Reference
from mindrun.robot.driver_support import PIN, library, pins

Pull = Literal["up", "down"]
PULL = Reference("pull", get_args(Pull))


@dataclass(frozen=True, slots=True)
class SwitchDevice:
    """A switch."""

    button: Any

    def read(self) -> tuple[float]:
        """1 while it is closed, else 0."""
        with pins("the switch cannot be read"):
            return (1.0 if self.button.is_pressed else 0.0,)

    def close(self) -> None:
        """Let go."""
        self.button.close()


@kind("sensor driver", "switch")
@dataclass(frozen=True, slots=True)
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

    def open(self) -> SwitchDevice:
        """The switch."""
        gpiozero = library("gpiozero")
        with pins(f"the switch on GPIO {self.pin} cannot be opened"):
            return SwitchDevice(gpiozero.Button(self.pin, pull_up=self.pull == "up"))
