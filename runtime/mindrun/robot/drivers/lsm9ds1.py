"""A 9-dof sensor, the LSM9DS1 (STMicroelectronics: accelerometer, gyroscope, magnetometer; data sheet DocID025715)."""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from math import atan2, degrees, hypot, sqrt
from statistics import fmean
from struct import unpack
from time import monotonic, sleep
from typing import Annotated

from mindrun.quantity import NUMBER, Quantity, Reference
from mindrun.registry import kind
from mindrun.robot.driver_support import ADDRESS, BUS, DEGREES, I2cDevice

WHO_AM_I, INERTIAL, MAGNETIC = 0x0F, 0x68, 0x3D  # 7.11 and 8.4
GYROSCOPE_ON = ((0x22, 0x44), (0x10, 0x60))  # CTRL_REG8: whole values only; CTRL_REG1_G: 119 Hz, ±245 °/s
ACCELEROMETER_ON = ((0x22, 0x44), (0x20, 0x60))  # CTRL_REG6_XL: 119 Hz, ±2 g
MAGNETOMETER_ON = ((0x20, 0xFC), (0x21, 0x00), (0x23, 0x0C), (0x24, 0x40), (0x22, 0x00))  # 80 Hz, ±4 G, running
STATUS, STATUS_MAGNETIC = 0x17, 0x27  # 7.18 and 8.11
OUT_GYROSCOPE, OUT_ACCELEROMETER, OUT_MAGNETOMETER = 0x18, 0x28, 0xA8  # of the last, bit 7 counts the register up
G = 9.80665
MS2, DEGREES_A_SECOND, MILLIGAUSS = 0.061e-3 * G, 8.75e-3, 0.14  # of one count, table 3
MEASURED_IN = 0.1  # seconds until a new value must be there; they come every 8 to 13 ms
READ_IN = 0.5  # seconds until there must be enough of them
RAIL = 32767
MIN_VALUES = 5  # until a deviation means something
WINDOW = Quantity("a time", {"s": 1.0}, low=0.2, high=10.0)
FACE = Reference("face", ("up", "down"))
MILLIGAUSS_OFFSET = Quantity("a magnetic field in milligauss", {"": 1.0}, low=-4000.0, high=4000.0)
Vector = tuple[float, float, float]


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
        if max(abs(count) for count in counts) >= RAIL:
            raise self.wire.error("measures more than it can")
        return counts

    def identify(self) -> None:
        """DeviceError where something else answers, or a line is stuck: any counts could be an acceleration."""
        found = self.wire.read(WHO_AM_I, 1)[0]
        if found != self.identity:
            raise self.wire.error(f"is no LSM9DS1 (it says 0x{found:02x}, not 0x{self.identity:02x})")

    def prepare(self) -> None:
        """Set it up."""
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
    """A chip, and what is made of its counts."""

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
        """Let go."""
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


@dataclass(slots=True)
class Shaking:
    """How much an acceleration varies: the root of the mean square of its deviation from its mean over a time."""

    error: Callable[[str], Exception]
    window: float
    kept: deque[tuple[float, Vector]] = field(default_factory=deque)

    def __call__(self, counts: tuple[int, int, int]) -> float | None:
        """The variation with this value, m/s²; None until there are enough."""
        now = monotonic()
        x, y, z = (count * MS2 for count in counts)
        if not 0.3 * G < hypot(x, y, z) < 3 * G:
            raise self.error("feels no gravity")
        self.kept.append((now, (x, y, z)))
        while self.kept[0][0] < now - self.window:
            self.kept.popleft()
        if len(self.kept) < MIN_VALUES:
            return None
        axes = [*zip(*(vector for _, vector in self.kept), strict=True)]
        means = [fmean(axis) for axis in axes]
        return sqrt(sum(fmean((value - mean) ** 2 for value in axis) for axis, mean in zip(axes, means, strict=True)))


@kind("sensor driver", "lsm9ds1_motion")
@dataclass(frozen=True, slots=True)
class Motion:
    """Whether the robot moves, for a sensor `inertial`: how much its acceleration varies, in m/s².

    Wheels that roll shake the body; one at rest reads the sensor's noise alone, under 0.05, whichever way it leans:
    gravity and all that is constant fall out, since only the deviation from the mean over `window` counts. How much is
    full speed depends on wheels and floor: look once, and write it as `to`. An LSM9DS1, fixed to the body: SDA and SCL
    to GPIO 2 and 3, 3.3 V.
    """

    window: Annotated[float, WINDOW] = 0.7
    bus: Annotated[int, BUS] = 1
    address: Annotated[int, ADDRESS] = 0x6B

    unit = "m/s²"
    readings = 1
    usual = (0.05, 1.0)
    possible = (0.0, 60.0)

    def open(self) -> NineDofDevice:
        """The accelerometer."""
        wire = I2cDevice("the accelerometer", self.bus, self.address)
        chip = Chip(wire, INERTIAL, ACCELEROMETER_ON, STATUS, 0x01, 0x80, OUT_ACCELEROMETER)
        return opened(chip, Shaking(wire.error, self.window))


@kind("sensor driver", "lsm9ds1_turn")
@dataclass(frozen=True, slots=True)
class Turn:
    """How fast the robot turns, in degrees a second, to the left (counterclockwise) positive.

    An LSM9DS1 that lies flat, its printed side `face` up or down. `still` is what it reads at rest.
    """

    face: Annotated[str, FACE] = "up"
    still: Annotated[float, NUMBER] = 0.0
    bus: Annotated[int, BUS] = 1
    address: Annotated[int, ADDRESS] = 0x6B

    unit = "deg/s"
    readings = 1
    usual = (180.0, -180.0)
    possible = (-600.0, 600.0)

    def open(self) -> NineDofDevice:
        """The gyroscope."""
        wire = I2cDevice("the gyroscope", self.bus, self.address)
        sign = 1 if self.face == "up" else -1
        chip = Chip(wire, INERTIAL, GYROSCOPE_ON, STATUS, 0x02, 0x80, OUT_GYROSCOPE)
        return opened(chip, lambda counts: sign * (counts[2] * DEGREES_A_SECOND) - self.still)


@kind("sensor driver", "lsm9ds1_compass")
@dataclass(frozen=True, slots=True)
class Compass:
    """Where magnetic north is, seen from the robot, in degrees: 0 straight ahead, to the left positive, −180 to 180.

    So it reads as a bearing: 0.5 facing north, less where north is on the left. An LSM9DS1 that lies flat, far from the
    motors; `turn` is how far its x axis points to the left of straight ahead, `face` down if it goes the wrong way
    round. Iron on the robot is taken off by `x` and `y`: turn it once round, each is half way between the most and the
    least milligauss that its axis measured.
    """

    turn: Annotated[float, DEGREES] = 0.0
    face: Annotated[str, FACE] = "up"
    x: Annotated[float, MILLIGAUSS_OFFSET] = 0.0
    y: Annotated[float, MILLIGAUSS_OFFSET] = 0.0
    bus: Annotated[int, BUS] = 1
    address: Annotated[int, ADDRESS] = 0x1E

    unit = "deg"
    readings = 1
    usual = (180.0, -180.0)
    possible = (-180.0, 180.0)

    def open(self) -> NineDofDevice:
        """The magnetometer."""
        wire = I2cDevice("the compass", self.bus, self.address)
        chip = Chip(wire, MAGNETIC, MAGNETOMETER_ON, STATUS_MAGNETIC, 0x08, 0x00, OUT_MAGNETOMETER)

        def bearing(counts: tuple[int, int, int]) -> float:
            x, y, z = (count * MILLIGAUSS for count in counts)
            if hypot(x, y, z) < 50:  # the earth's is 250 to 650
                raise wire.error("feels no magnetic field")
            y = y - self.y if self.face == "up" else self.y - y
            angle = degrees(atan2(y, x - self.x)) + self.turn
            return (angle + 180) % 360 - 180

        return opened(chip, bearing)
