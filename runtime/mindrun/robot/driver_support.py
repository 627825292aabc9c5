"""Parts that drivers share: quantities of their options, packages imported when needed, and GPIO pins."""

import os
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from importlib import import_module
from threading import Lock
from typing import Any, Generic, Literal, Protocol, TypeVar, get_args

from mindrun.driver import DeviceError
from mindrun.numbers.quantity import Quantity, Reference

PIN = Quantity("a GPIO number", {"": 1.0}, low=0, high=27, whole=True)  # as Broadcom counts, not as the header does
BUS = Quantity("the number of an I2C bus", {"": 1.0}, low=0, high=99, whole=True)
ADDRESS = Quantity("an I2C address", {"": 1.0}, low=0x03, high=0x77, whole=True)
CHIP = Quantity("a chip select of SPI bus 0", {"": 1.0}, low=0, high=1, whole=True)
CHANNEL = Quantity("a channel", {"": 1.0}, low=0, high=15, whole=True)
METRES = Quantity("a distance", {"m": 1.0, "cm": 0.01}, low=0.0)
MICROSECONDS = Quantity("a pulse width", {"us": 1.0}, low=100.0, high=4000.0)
PWM_HERTZ = Quantity("a rate of pulses", {"Hz": 1.0, "kHz": 1000.0}, low=10.0, high=10_000.0)
DEGREES = Quantity("an angle", {"deg": 1.0}, low=-360.0, high=360.0)
PATH = Reference("path")
TEXT = Reference("text")
SWITCH = Reference("switch", ("true", "false"))
Face = Literal["up", "down"]
FACE = Reference("face", get_args(Face))
Pull = Literal["up", "down"]
PULL = Reference("pull", get_args(Pull))

INSTALL = "pip install 'mindrun[robot]'"
INSTALL_PINS = "sudo apt install python3-lgpio, or in a virtual environment: pip install lgpio"


def library(module: str, install: str = INSTALL) -> Any:
    """A module that only this driver needs; DeviceError with the line that installs it."""
    # What OpenCV and gpiozero would warn of, a driver says in a sentence where it matters.
    os.environ.setdefault("OPENCV_LOG_LEVEL", "ERROR")
    warnings.filterwarnings("ignore", message="Falling back from")
    try:
        return import_module(module)
    except ImportError as error:
        raise DeviceError(f"the package {module} is not installed ({error})", install) from error


def share(value: float) -> float:
    """A command as it was given; DeviceError, before anything is sent, unless it is in 0..1 (NaN is not)."""
    if not 0.0 <= value <= 1.0:
        raise DeviceError(f"a command of {value} is not between 0 and 1, and was not sent")
    return float(value)


class Closes(Protocol):
    def close(self) -> None: ...


Opened = TypeVar("Opened", bound=Closes)
Key = TypeVar("Key")


def answering(device: Opened, ask: Callable[[], object]) -> Opened:
    """A device that was just opened, once it has answered; where it does not, it is closed again."""
    try:
        ask()
    except Exception:
        device.close()
        raise
    return device


@dataclass(frozen=True, slots=True)
class OpenSensor:
    """A sensor that is open: the function that measures, and the one that lets go of the hardware."""

    read: Callable[[], Sequence[float | None]]
    close: Callable[[], None]


def measuring(read: Callable[[], Sequence[float | None]], close: Callable[[], None]) -> OpenSensor:
    """A sensor that was just opened, once it has measured; where it does not, it is closed again."""
    return answering(OpenSensor(read, close), read)


def close_all(parts: Iterable[Closes]) -> None:
    """Close one part after the other."""
    for part in parts:
        part.close()


class SharedParts(Generic[Key, Opened]):
    """Parts that several devices use together: opened for the first of them, closed with the last."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._parts: dict[Key, tuple[Opened, int]] = {}  # and how many use it

    def acquire(self, key: Key, opened: Callable[[], Opened]) -> Opened:
        """The part of this key, which is `opened` for the first device that acquires it."""
        with self._lock:
            part, users = self._parts.get(key) or (opened(), 0)
            self._parts[key] = part, users + 1
            return part

    def release(self, key: Key) -> None:
        """Use the part of this key no longer; it is closed when nobody does."""
        with self._lock:
            part, users = self._parts.pop(key)
            if users > 1:
                self._parts[key] = part, users - 1
            else:
                part.close()

    def close(self) -> None:
        close_all(part for part, _ in self._parts.values())


class Ranging:
    """The common part of range finders' drivers: metres, from touching to clear within the `range`."""

    __slots__ = ()
    range: float
    unit = "m"

    @property
    def usual(self) -> tuple[float, float]:
        return 0.0, self.range

    possible = usual


class Shares:
    """The common part of drivers of sensors whose values are shares already, from 0 to 1."""

    __slots__ = ()
    unit = ""
    usual = possible = (0.0, 1.0)


Part = tuple[str, str, Mapping[str, Any]]  # an object of gpiozero: its name in messages, its class, its arguments


@contextmanager
def pins(what: str) -> Iterator[None]:
    """A context in which every error of GPIO pins becomes a DeviceError."""
    try:
        yield
    except DeviceError:
        raise
    except Exception as error:  # gpiozero's, lgpio's and RPi.GPIO's errors have nothing else in common
        raise DeviceError(f"{what}: {error}", INSTALL_PINS) from error


def open_pins(*parts: Part) -> list[Any]:
    """An object of gpiozero for each part; where one fails, no pin."""
    gpiozero = library("gpiozero")
    with ExitStack() as opened:
        made = []
        for what, name, arguments in parts:
            with pins(f"{what} cannot be opened"):
                made.append(opened.enter_context(getattr(gpiozero, name)(**arguments)))
        opened.pop_all()
    return made


def open_inputs(what: str, *parts: Part) -> OpenSensor:
    """Inputs of gpiozero: each reads 1 while it is active, else 0; an analogue one a share of its reference."""
    inputs = open_pins(*parts)

    def read() -> tuple[float, ...]:
        with pins(f"{what} cannot be read"):
            return tuple(float(each.value) for each in inputs)

    return OpenSensor(read, lambda: close_all(inputs))


@dataclass(frozen=True, slots=True)
class OutputPin:
    """An actuator that is one output of gpiozero, whose value for a command 0 is `low`, and 1 for 1."""

    what: str
    output: Any
    low: float = 0.0

    def write(self, value: float) -> None:
        command = share(value)
        with pins(f"{self.what} cannot be driven"):
            self.output.value = self.low + command * (1 - self.low)

    def close(self) -> None:
        self.output.close()


def on_pin(number: int) -> str:
    """The name of a GPIO pin that only one process may drive, `GPIO 12`."""
    return f"GPIO {number}"
