"""How fast the robot turns, by the gyroscope of an LSM9DS1."""

from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import NUMBER
from mindrun.robot.driver_support import ADDRESS, BUS, FACE, Face, OpenSensor
from mindrun.robot.i2c import I2cDevice, open_chip
from mindrun.robot.lsm9ds1 import BUS_SECONDS, DEGREES_PER_SECOND_PER_COUNT, GYROSCOPE


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
