"""Whether the robot moves, felt by the accelerometer of an LSM9DS1."""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from math import hypot, sqrt
from statistics import fmean
from time import monotonic
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import Quantity
from mindrun.robot.driver_support import ADDRESS, BUS, I2cDevice
from mindrun.robot.lsm9ds1 import (
    ACCELERATION_PER_COUNT,
    ACCELEROMETER_ON,
    BUS_SECONDS,
    INERTIAL_CHIP_ID,
    OUT_ACCELEROMETER,
    STANDARD_GRAVITY,
    STATUS_INERTIAL,
    Chip,
    NineDofDevice,
    opened,
)

WINDOW = Quantity("a time", {"s": 1.0}, low=0.2, high=10.0)
MIN_VALUES = 5  # until a deviation means something
Vector = tuple[float, float, float]


@dataclass(slots=True)
class Shaking:
    """How much an acceleration varies: the root of the mean square of its deviation from its mean over a time."""

    error: Callable[[str], Exception]
    window: float
    kept: deque[tuple[float, Vector]] = field(default_factory=deque)

    def __call__(self, counts: tuple[int, int, int]) -> float | None:
        """The variation with this value, m/s²; None until there are enough."""
        now = monotonic()
        x, y, z = (count * ACCELERATION_PER_COUNT for count in counts)
        if not 0.3 * STANDARD_GRAVITY < hypot(x, y, z) < 3 * STANDARD_GRAVITY:
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
    seconds = 1 / 119
    bus_seconds = BUS_SECONDS

    def open(self) -> NineDofDevice:
        """The accelerometer."""
        wire = I2cDevice("the accelerometer", self.bus, self.address)
        chip = Chip(wire, INERTIAL_CHIP_ID, ACCELEROMETER_ON, STATUS_INERTIAL, 0x01, 0x80, OUT_ACCELEROMETER)
        return opened(chip, Shaking(wire.error, self.window))
