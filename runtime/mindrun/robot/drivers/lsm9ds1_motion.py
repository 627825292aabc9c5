"""The motion of the robot, felt by the accelerometer of an LSM9DS1."""

from collections import deque
from math import hypot, sqrt
from statistics import pvariance
from time import monotonic
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import Quantity
from mindrun.robot.driver_support import ADDRESS, BUS, OpenSensor, measuring
from mindrun.robot.i2c import I2cDevice, MeasuringChip
from mindrun.robot.lsm9ds1 import ACCELERATION_PER_COUNT, ACCELEROMETER, BUS_SECONDS, STANDARD_GRAVITY

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
