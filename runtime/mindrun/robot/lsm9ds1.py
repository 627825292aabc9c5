"""The two chips of an LSM9DS1, a 9-dof sensor (STMicroelectronics; data sheet DocID025715)."""

from collections.abc import Callable
from dataclasses import dataclass
from struct import unpack
from time import monotonic, sleep
from typing import Literal, get_args

from mindrun.numbers.quantity import Reference
from mindrun.robot.driver_support import I2C_BYTE_SECONDS, I2cDevice

WHO_AM_I, INERTIAL_CHIP_ID, MAGNETIC_CHIP_ID = 0x0F, 0x68, 0x3D  # 7.11 and 8.4
GYROSCOPE_ON = ((0x22, 0x44), (0x10, 0x60))  # CTRL_REG8: whole values only; CTRL_REG1_G: 119 Hz, ±245 °/s
ACCELEROMETER_ON = ((0x22, 0x44), (0x20, 0x60))  # CTRL_REG6_XL: 119 Hz, ±2 g
MAGNETOMETER_ON = ((0x20, 0xFC), (0x21, 0x00), (0x23, 0x0C), (0x24, 0x40), (0x22, 0x00))  # 80 Hz, ±4 G, running
STATUS_INERTIAL, STATUS_MAGNETIC = 0x17, 0x27  # 7.18 and 8.11
OUT_GYROSCOPE, OUT_ACCELEROMETER, OUT_MAGNETOMETER = 0x18, 0x28, 0xA8  # of the last, bit 7 counts the register up
STANDARD_GRAVITY = 9.80665
ACCELERATION_PER_COUNT = 0.061e-3 * STANDARD_GRAVITY  # m/s², table 3
DEGREES_PER_SECOND_PER_COUNT = 8.75e-3
MILLIGAUSS_PER_COUNT = 0.14
MEASURED_IN = 0.1  # seconds until a new value must be there; they come every 8 to 13 ms
READ_IN = 0.5  # seconds until there must be enough of them
SATURATED_COUNT = 32767
BUS_SECONDS = 17 * I2C_BYTE_SECONDS  # who it is, whether there is a value, and the value
Face = Literal["up", "down"]
FACE = Reference("face", get_args(Face))


@dataclass(slots=True)
class Chip:
    """One of the two chips in the LSM9DS1, set up to measure one thing."""

    wire: I2cDevice
    identity: int
    settings: tuple[tuple[int, int], ...]
    status: int
    fresh: int  # the bit of the status that says that there is a new value
    never: int  # bits of the status that are never set
    out: int
    ready: bool = False

    def measure(self) -> tuple[int, int, int]:
        """The next value that was not read before, in counts."""
        try:
            self.identify()
            if not self.ready:
                self.prepare()
            self.wait()
            counts: tuple[int, int, int] = unpack("<hhh", self.wire.read(self.out, 6))
        except Exception:
            self.ready = False  # after a brown-out it has to be set up again
            raise
        if max(abs(count) for count in counts) >= SATURATED_COUNT:
            raise self.wire.error("measures more than it can")
        return counts

    def identify(self) -> None:
        """DeviceError where something else answers, or a line is stuck: any counts could be an acceleration."""
        found = self.wire.read(WHO_AM_I, 1)[0]
        if found != self.identity:
            raise self.wire.error(f"is no LSM9DS1 (it says 0x{found:02x}, not 0x{self.identity:02x})")

    def prepare(self) -> None:
        """Write the registers that make it measure."""
        for register, value in self.settings:
            self.wire.write(register, value)
        self.ready = True

    def wait(self) -> None:
        """Return when there is a new value: a chip that has stopped must not look like a robot that has."""
        begin = monotonic()
        while not (status := self.wire.read(self.status, 1)[0]) & self.fresh:
            if monotonic() - begin > MEASURED_IN:
                raise self.wire.error("does not measure anything new")
            sleep(0.002)
        if status & self.never:
            raise self.wire.error(f"has an impossible status (0x{status:02x})")


@dataclass(frozen=True, slots=True)
class NineDofDevice:
    """A chip as a sensor device: `value` converts its counts."""

    chip: Chip
    value: Callable[[tuple[int, int, int]], float | None]

    def read(self) -> tuple[float]:
        """One value, measured now."""
        begin = monotonic()
        while monotonic() - begin < READ_IN:
            if (found := self.value(self.chip.measure())) is not None:
                return (found,)
        raise self.chip.wire.error("measures too slowly")

    def close(self) -> None:
        """Close the bus."""
        self.chip.wire.close()


def opened(chip: Chip, value: Callable[[tuple[int, int, int]], float | None]) -> NineDofDevice:
    """The device, when the chip has answered."""
    device = NineDofDevice(chip, value)
    try:
        device.read()
    except Exception:
        device.close()
        raise
    return device
