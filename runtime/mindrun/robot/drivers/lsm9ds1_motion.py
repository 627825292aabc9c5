"""The motion of the robot, felt by the accelerometer of an LSM9DS1."""

from collections import deque
from dataclasses import dataclass, field
from math import hypot, sqrt
from statistics import pvariance
from time import monotonic
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import Quantity
from mindrun.robot.driver_support import ADDRESS, BUS, answering
from mindrun.robot.i2c import I2cDevice, MeasuringChip
from mindrun.robot.lsm9ds1 import ACCELERATION_PER_COUNT, BUS_SECONDS, STANDARD_GRAVITY, accelerometer

WINDOW = Quantity("a time", {"s": 1.0}, low=0.2, high=10.0)
MIN_VALUES = 5  # until a deviation means something
READ_IN = 0.5  # seconds until there must be enough of them


@dataclass(slots=True)
class MotionDevice:
    """How much an acceleration varies: the root of the mean square of its deviation from its mean over a time."""

    chip: MeasuringChip
    window: float
    kept: deque[tuple[float, tuple[float, ...]]] = field(default_factory=deque)

    def read(self) -> tuple[float]:
        """The variation with the next values, m/s²."""
        begin = monotonic()
        while monotonic() - begin < READ_IN:
            self.keep(tuple(count * ACCELERATION_PER_COUNT for count in self.chip.measure()))
            if len(self.kept) >= MIN_VALUES:
                axes = zip(*(vector for _, vector in self.kept), strict=True)
                return (sqrt(sum(map(pvariance, axes))),)
        raise self.chip.wire.error("measures too slowly")

    def keep(self, vector: tuple[float, ...]) -> None:
        """Take another acceleration into the window, and leave out what is too old for it."""
        if not 0.3 * STANDARD_GRAVITY < hypot(*vector) < 3 * STANDARD_GRAVITY:
            raise self.chip.wire.error("feels no gravity")
        now = monotonic()
        self.kept.append((now, vector))
        while self.kept[0][0] < now - self.window:
            self.kept.popleft()

    def close(self) -> None:
        self.chip.close()


@kind("sensor driver", "lsm9ds1_motion")
@dataclass(frozen=True, slots=True)
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

    def open(self) -> MotionDevice:
        device = MotionDevice(accelerometer(I2cDevice("the accelerometer", self.bus, self.address)), self.window)
        return answering(device, device.read)
