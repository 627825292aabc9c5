"""What drivers share: quantities of their options, packages imported when needed, GPIO pins, and chips on I2C buses.

Every I2C transfer ends, in an answer or an error.
"""

import os
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, field
from importlib import import_module
from struct import calcsize, unpack
from threading import Lock, RLock
from time import monotonic, sleep
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
SWITCH = Reference("switch", ("true", "false"))
Face = Literal["up", "down"]
FACE = Reference("face", get_args(Face))
Pull = Literal["up", "down"]
PULL = Reference("pull", get_args(Pull))

INSTALL = "pip install 'mindrun[robot]'"
INSTALL_PINS = "sudo apt install python3-lgpio, or in a virtual environment: pip install lgpio"
MAX_TRIES = 3
RETRY_SECONDS = 0.002  # between two tries, and between two questions to a chip whether it is done
TRANSFER_SECONDS = 0.1  # seconds after which a transfer that failed is not tried again
I2C_BYTE_SECONDS = 9 / 100_000  # seconds of a byte with its acknowledgement, at the usual 100 kHz
I2C_TIMEOUT, KERNEL_TICKS = 0x0702, 5  # <linux/i2c-dev.h>; in units of 10 ms: for how long a part may hold the clock


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


class SharedParts(Generic[Key, Opened]):
    """Parts that several devices use together: opened for the first of them, closed with the last."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._parts: dict[Key, tuple[Opened, int]] = {}  # and how many use it

    def take(self, key: Key, opened: Callable[[], Opened]) -> Opened:
        """The part of this key, which was `opened` when it was taken first."""
        with self._lock:
            part, users = self._parts.get(key) or (opened(), 0)
            self._parts[key] = part, users + 1
            return part

    def give_back(self, key: Key) -> None:
        """Use it no longer."""
        with self._lock:
            part, users = self._parts.pop(key)
            if users > 1:
                self._parts[key] = part, users - 1
            else:
                part.close()

    def close(self) -> None:
        for part, _ in self._parts.values():
            part.close()


class Ranging:
    """What the drivers of range finders have in common: metres, from touching to clear within the `range`."""

    __slots__ = ()
    range: float
    unit = "m"

    @property
    def usual(self) -> tuple[float, float]:
        return 0.0, self.range

    possible = usual


@contextmanager
def pins(what: str) -> Iterator[None]:
    """A context in which every error of GPIO pins becomes a DeviceError."""
    try:
        yield
    except DeviceError:
        raise
    except Exception as error:  # gpiozero's, lgpio's and RPi.GPIO's errors have nothing else in common
        raise DeviceError(f"{what}: {error}", INSTALL_PINS) from error


def open_pins(*parts: tuple[str, str, Mapping[str, Any]]) -> list[Any]:
    """For each part, which is what messages call it, a class of gpiozero, and its arguments, the object; or no pin."""
    gpiozero = library("gpiozero")
    with ExitStack() as opened:
        made = []
        for what, name, arguments in parts:
            with pins(f"{what} cannot be opened"):
                made.append(opened.enter_context(getattr(gpiozero, name)(**arguments)))
        opened.pop_all()
    return made


@dataclass(frozen=True, slots=True)
class InputPins:
    """A sensor of inputs of gpiozero, a reading of each; `what` is wired to them."""

    what: str
    inputs: list[Any]

    def read(self) -> tuple[float, ...]:
        """The value of each: 1 for one that is active, else 0; of analogue ones a share of the reference."""
        with pins(f"{self.what} cannot be read"):
            return tuple(float(each.value) for each in self.inputs)

    def close(self) -> None:
        for each in self.inputs:
            each.close()


def digital_inputs(what: str, numbers: tuple[int, ...], **options: Any) -> InputPins:
    """The pins of these numbers as inputs, all with these `options` of gpiozero's DigitalInputDevice."""
    parts = ((f"{what} on GPIO {number}", "DigitalInputDevice", {"pin": number, **options}) for number in numbers)
    return InputPins(what, open_pins(*parts))


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


@dataclass(frozen=True, slots=True)
class Bus:
    """An I2C bus of Linux that is open."""

    smbus: Any
    message: Any

    def transfer(self, address: int, out: bytes, count: int) -> bytes:
        """Write `out`, then read `count` bytes, with a repeated start; OSError where the part does not acknowledge."""
        writing = [self.message.write(address, out)] if out else []
        reading = [self.message.read(address, count)] if count else []
        self.smbus.i2c_rdwr(*writing, *reading)
        return b"".join(bytes(message) for message in reading)

    def close(self) -> None:
        self.smbus.close()


def open_bus(number: int) -> Bus:
    """The I2C bus of that number; tests put a bus of their own here."""
    smbus2, fcntl = library("smbus2"), library("fcntl", "robots run Linux")
    try:
        smbus = smbus2.SMBus(number)
    except OSError as error:
        hint = "turn it on with: sudo raspi-config nonint do_i2c 0"
        raise DeviceError(f"I2C bus {number} cannot be opened: {error}", hint) from error
    with suppress(OSError):  # not every adapter can be told how long to wait
        fcntl.ioctl(smbus.fd, I2C_TIMEOUT, KERNEL_TICKS)
    return Bus(smbus, smbus2.i2c_msg)


def on_bus(number: int, address: int) -> str:
    """The name of an I2C device that only one process may drive, `/dev/i2c-1 0x40`."""
    return f"/dev/i2c-{number} {address:#04x}"


def on_pin(number: int) -> str:
    """The name of a GPIO pin that only one process may drive, `GPIO 12`."""
    return f"GPIO {number}"


_turns: dict[tuple[int, int], RLock] = {}  # by bus and address


@dataclass(slots=True)
class I2cDevice:
    """One part on an I2C bus. Every transfer ends, after up to `MAX_TRIES` tries, in an answer or a DeviceError."""

    name: str
    number: int
    address: int
    bus: Bus = field(init=False)
    closed: bool = False

    def __post_init__(self) -> None:
        self.bus = open_bus(self.number)

    @property
    def turn(self) -> RLock:
        """What a device holds while it asks its chip for something and waits for that: others ask the same chip."""
        return _turns.setdefault((self.number, self.address), RLock())

    def write(self, *out: int) -> None:
        """Write bytes, of which the first is a register or a command; returns when all are acknowledged."""
        self.transfer(bytes(out))

    def read(self, register: int, count: int) -> bytes:
        """Read from a register on."""
        return self.transfer(bytes((register,)), count)

    def byte(self, register: int) -> int:
        """What one register holds."""
        return self.read(register, 1)[0]

    def transfer(self, out: bytes, count: int = 0) -> bytes:
        """Write, then read."""
        if self.closed:
            raise self.error("is closed")
        begin, failure = monotonic(), "no answer"
        for _ in range(MAX_TRIES):
            try:
                answer = self.bus.transfer(self.address, out, count)
                if len(answer) == count:
                    return answer
                failure = f"it gave {len(answer)} bytes, not {count}"
            except OSError as error:
                failure = str(error)
            if monotonic() - begin > TRANSFER_SECONDS:
                break
            sleep(RETRY_SECONDS)
        raise self.error(f"does not answer: {failure}")

    def wait(self, register: int, bits: int, seconds: float, problem: str, count: int = 1) -> int:
        """What a register of `count` bytes holds once one of these bits is set; DeviceError of the problem if late."""
        begin = monotonic()
        while not (found := int.from_bytes(self.read(register, count), "big")) & bits:
            if monotonic() - begin > seconds:
                raise self.error(problem)
            sleep(RETRY_SECONDS)
        return found

    def error(self, what: str) -> DeviceError:
        """An error that says which part it is about, and how to look for it."""
        return DeviceError(
            f"{self.name} at 0x{self.address:02x} on I2C bus {self.number} {what}",
            f"look whether it is there with: i2cdetect -y {self.number}",
        )

    def close(self) -> None:
        """Let go of the bus; never raises, and again does nothing."""
        if not self.closed:
            self.closed = True
            with suppress(OSError):
                self.bus.close()


@dataclass(slots=True)
class MeasuringChip:
    """A chip that measures again and again: the registers that say who it is, set it up, and have what it measured."""

    wire: I2cDevice
    model: str
    identity: tuple[int, int]  # a register, and what it holds in this model
    settings: tuple[tuple[int, int], ...]  # registers, and what makes it measure
    status: tuple[int, int, int]  # a register, its bit for a new value, and those that are never set
    out: int
    layout: str  # of what is at `out`, as struct has it
    seconds: float  # until a new value must be there
    limit: int = 32767  # counts from which on it measures more than it can
    ready: bool = False

    def measure(self) -> tuple[int, ...]:
        """The next value that was not read before, in counts."""
        try:
            self.identify()
            if not self.ready:
                self.prepare()
                self.ready = True
            self.wait()
            counts = self.taken()
        except Exception:
            self.ready = False  # after a brown-out it has to be set up again
            raise
        if max(map(abs, counts)) >= self.limit:
            raise self.wire.error("measures more than it can")
        return counts

    def identify(self) -> None:
        """DeviceError where something else answers, or a line is stuck: any counts could be a measurement."""
        register, expected = self.identity
        if (found := self.wire.byte(register)) != expected:
            raise self.wire.error(f"is no {self.model} (it says 0x{found:02x}, not 0x{expected:02x})")

    def prepare(self) -> None:
        """Write the registers that make it measure."""
        for register, value in self.settings:
            self.wire.write(register, value)

    def wait(self) -> None:
        """Return when there is a new value: a chip that has stopped must not look like a robot that has."""
        register, fresh, never = self.status
        found = self.wire.wait(register, fresh, self.seconds, "does not measure anything new")
        if found & never:
            raise self.wire.error(f"has an impossible status (0x{found:02x})")

    def taken(self) -> tuple[int, ...]:
        """Read what has been measured."""
        return unpack(self.layout, self.wire.read(self.out, calcsize(self.layout)))


@dataclass(frozen=True, slots=True)
class ChipDevice:
    """A measuring chip as a sensor of one reading: `value` converts its counts."""

    chip: MeasuringChip
    value: Callable[[tuple[int, ...]], float]

    def read(self) -> tuple[float]:
        return (self.value(self.chip.measure()),)

    def close(self) -> None:
        self.chip.wire.close()


def open_chip(chip: MeasuringChip, value: Callable[[tuple[int, ...]], float]) -> ChipDevice:
    """A chip as a device, once it has measured."""
    device = ChipDevice(chip, value)
    return answering(device, device.read)
