"""Chips on I2C buses, as drivers have them: every transfer ends, in an answer or an error."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from struct import calcsize, unpack
from threading import RLock
from time import monotonic, sleep
from typing import Any

from mindrun.driver import DeviceError
from mindrun.robot.driver_support import OpenSensor, library, measuring

MAX_TRIES = 3
RETRY_SECONDS = 0.002  # between two tries, and between two questions to a chip whether it is done
TRANSFER_SECONDS = 0.1  # seconds after which a transfer that failed is not tried again
I2C_BYTE_SECONDS = 9 / 100_000  # seconds of a byte with its acknowledgement, at the usual 100 kHz
I2C_TIMEOUT, KERNEL_TICKS = 0x0702, 5  # <linux/i2c-dev.h>; in units of 10 ms: for how long a part may hold the clock


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


_locks: dict[tuple[int, int], RLock] = {}  # by bus and address


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
    def lock(self) -> RLock:
        """The lock of a chip, held from a question until it has answered: other devices ask the same chip."""
        return _locks.setdefault((self.number, self.address), RLock())

    def write(self, *out: int) -> None:
        """Write bytes, of which the first is a register or a command; returns when all are acknowledged."""
        self.transfer(bytes(out))

    def read(self, register: int, count: int) -> bytes:
        """Read `count` bytes from a register on."""
        return self.transfer(bytes((register,)), count)

    def byte(self, register: int) -> int:
        """The byte in one register."""
        return self.read(register, 1)[0]

    def transfer(self, out: bytes, count: int = 0) -> bytes:
        """Write `out`, then read `count` bytes; DeviceError where the part does not answer."""
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
        """A register of `count` bytes, read until one of these bits is set; DeviceError of the problem if late."""
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
class WiredDevice:
    """A device that is one part on an I2C bus."""

    wire: I2cDevice

    def close(self) -> None:
        self.wire.close()


@dataclass(frozen=True, slots=True)
class ChipModel:
    """A model of chips that measure: the registers that say who it is, set it up, and have what it measured."""

    name: str
    identity: tuple[int, int]  # a register, and what it holds in this model
    settings: tuple[tuple[int, int], ...]  # registers, and what makes it measure
    status: tuple[int, int, int]  # a register, its bit for a new value, and those that are never set
    out: int
    layout: str  # of what is at `out`, as struct has it
    seconds: float  # until a new value must be there
    limit: int = 32767  # counts from which on it measures more than it can


@dataclass(slots=True)
class MeasuringChip:
    """A chip that measures again and again."""

    wire: I2cDevice
    model: ChipModel
    ready: bool = False

    def measure(self) -> tuple[int, ...]:
        """The next value that was not read before, in counts."""
        try:
            register, expected = self.model.identity
            if (found := self.wire.byte(register)) != expected:  # any counts could be a measurement
                raise self.wire.error(f"is no {self.model.name} (it says 0x{found:02x}, not 0x{expected:02x})")
            if not self.ready:
                self.prepare()
                self.ready = True
            self.wait()
            counts = self.read_counts()
        except Exception:
            self.ready = False  # after a brown-out it has to be set up again
            raise
        if max(map(abs, counts)) >= self.model.limit:
            raise self.wire.error("measures more than it can")
        return counts

    def prepare(self) -> None:
        """Write the registers that make it measure."""
        for register, value in self.model.settings:
            self.wire.write(register, value)

    def wait(self) -> None:
        """Return when there is a new value: a chip that has stopped must not look like a robot that has."""
        register, fresh, never = self.model.status
        found = self.wire.wait(register, fresh, self.model.seconds, "does not measure anything new")
        if found & never:
            raise self.wire.error(f"has an impossible status (0x{found:02x})")

    def read_counts(self) -> tuple[int, ...]:
        return unpack(self.model.layout, self.wire.read(self.model.out, calcsize(self.model.layout)))


def open_chip(wire: I2cDevice, model: ChipModel, value: Callable[[tuple[int, ...]], float]) -> OpenSensor:
    """A chip as a sensor of one reading, once it has measured: `value` converts its counts."""
    chip = MeasuringChip(wire, model)
    return measuring(lambda: (value(chip.measure()),), wire.close)
