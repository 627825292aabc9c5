"""An LSM9DS1, a 9-dof sensor of two chips (STMicroelectronics; data sheet DocID025715): motion, turns and north."""

from collections import deque
from math import atan2, degrees, hypot, sqrt
from statistics import pvariance
from time import monotonic
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import NUMBER, Quantity
from mindrun.robot.driver_support import ADDRESS, BUS, DEGREES, FACE, Face, OpenSensor, measuring
from mindrun.robot.i2c import I2C_BYTE_SECONDS, ChipModel, I2cDevice, MeasuringChip, open_chip

INERTIAL_CHIP, MAGNETIC_CHIP = (0x0F, 0x68), (0x0F, 0x3D)  # WHO_AM_I, 7.11 and 8.4
MEASURED_IN = 0.1  # seconds until a new value must be there; they come every 8 to 13 ms
GYROSCOPE = ChipModel(
    "LSM9DS1", INERTIAL_CHIP,
    ((0x22, 0x44), (0x10, 0x60)),  # CTRL_REG8: whole values only; CTRL_REG1_G: 119 Hz, ±245 °/s
    (0x17, 0x02, 0x80), 0x18, "<hhh", MEASURED_IN,  # 7.18
)  # fmt: skip
ACCELEROMETER = ChipModel(
    "LSM9DS1", INERTIAL_CHIP,
    ((0x22, 0x44), (0x20, 0x60)),  # CTRL_REG6_XL: 119 Hz, ±2 g
    (0x17, 0x01, 0x80), 0x28, "<hhh", MEASURED_IN,
)  # fmt: skip
MAGNETOMETER = ChipModel(
    "LSM9DS1", MAGNETIC_CHIP,
    ((0x20, 0xFC), (0x21, 0x00), (0x23, 0x0C), (0x24, 0x40), (0x22, 0x00)),  # 80 Hz, ±4 G, running
    (0x27, 0x08, 0x00), 0xA8, "<hhh", MEASURED_IN,  # 8.11; bit 7 of the output counts the register up
)  # fmt: skip
STANDARD_GRAVITY = 9.80665
ACCELERATION_PER_COUNT = 0.061e-3 * STANDARD_GRAVITY  # m/s², table 3
DEGREES_PER_SECOND_PER_COUNT = 8.75e-3
MILLIGAUSS_PER_COUNT = 0.14
BUS_SECONDS = 17 * I2C_BYTE_SECONDS  # who it is, whether there is a value, and the value
MILLIGAUSS_OFFSET = Quantity("a magnetic field in milligauss", {"": 1.0}, low=-4000.0, high=4000.0)
WINDOW = Quantity("a time", {"s": 1.0}, low=0.2, high=10.0)
MIN_VALUES = 5  # until a deviation means something
READ_IN = 0.5  # seconds until there must be enough of them
Accelerations = deque[tuple[float, tuple[float, ...]]]  # with the time of each


@kind("sensor driver", "lsm9ds1_motion")
class Motion:
    """The motion of the robot, for a sensor `inertial`: how much its acceleration varies, in m/s².

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
    seconds = 1 / 119
    bus_seconds = BUS_SECONDS

    def open(self) -> OpenSensor:
        wire, kept = I2cDevice("the accelerometer", self.bus, self.address), Accelerations()
        chip = MeasuringChip(wire, ACCELEROMETER)
        return measuring(lambda: (self.variation(chip, kept),), wire.close)

    def variation(self, chip: MeasuringChip, kept: Accelerations) -> float:
        """The root of the mean square of the deviation from the mean, with the next values, m/s²."""
        begin = monotonic()
        while monotonic() - begin < READ_IN:
            vector = tuple(count * ACCELERATION_PER_COUNT for count in chip.measure())
            if not 0.3 * STANDARD_GRAVITY < hypot(*vector) < 3 * STANDARD_GRAVITY:
                raise chip.wire.error("feels no gravity")
            now = monotonic()
            kept.append((now, vector))
            while kept[0][0] < now - self.window:
                kept.popleft()
            if len(kept) >= MIN_VALUES:
                axes = zip(*(vector for _, vector in kept), strict=True)
                return sqrt(sum(map(pvariance, axes)))
        raise chip.wire.error("measures too slowly")


@kind("sensor driver", "lsm9ds1_turn")
class Turn:
    """How fast the robot turns, in degrees a second, to the left (counterclockwise) positive.

    An LSM9DS1 that lies flat, its printed side `face` up or down. `still` is what it reads at rest.
    """

    face: Annotated[Face, FACE] = "up"
    still: Annotated[float, NUMBER] = 0.0
    bus: Annotated[int, BUS] = 1
    address: Annotated[int, ADDRESS] = 0x6B

    unit = "deg/s"
    readings = 1
    usual = (180.0, -180.0)
    possible = (-600.0, 600.0)
    seconds = 1 / 119
    bus_seconds = BUS_SECONDS

    def open(self) -> OpenSensor:
        wire, sign = I2cDevice("the gyroscope", self.bus, self.address), 1 if self.face == "up" else -1
        return open_chip(wire, GYROSCOPE, lambda counts: sign * (counts[2] * DEGREES_PER_SECOND_PER_COUNT) - self.still)


@kind("sensor driver", "lsm9ds1_compass")
class MagneticCompass:
    """Where magnetic north is, seen from the robot, in degrees: 0 straight ahead, to the left positive, −180 to 180.

    So it reads as a bearing: 0.5 facing north, less where north is on the left. An LSM9DS1 that lies flat, far from the
    motors; `turn` is how far its x axis points to the left of straight ahead, `face` down if it goes the wrong way
    round. Iron on the robot is taken off by `x` and `y`: turn it once round, each is half way between the most and the
    least milligauss that its axis measured.
    """

    turn: Annotated[float, DEGREES] = 0.0
    face: Annotated[Face, FACE] = "up"
    x: Annotated[float, MILLIGAUSS_OFFSET] = 0.0
    y: Annotated[float, MILLIGAUSS_OFFSET] = 0.0
    bus: Annotated[int, BUS] = 1
    address: Annotated[int, ADDRESS] = 0x1E

    unit = "deg"
    readings = 1
    usual = (180.0, -180.0)
    possible = (-180.0, 180.0)
    seconds = 1 / 80
    bus_seconds = BUS_SECONDS

    def open(self) -> OpenSensor:
        wire = I2cDevice("the compass", self.bus, self.address)

        def bearing(counts: tuple[int, ...]) -> float:
            x, y, z = (count * MILLIGAUSS_PER_COUNT for count in counts)
            if hypot(x, y, z) < 50:  # the earth's is 250 to 650
                raise wire.error("feels no magnetic field")
            y = y - self.y if self.face == "up" else self.y - y
            angle = degrees(atan2(y, x - self.x)) + self.turn
            return (angle + 180) % 360 - 180

        return open_chip(wire, MAGNETOMETER, bearing)
