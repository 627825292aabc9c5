"""The direction of north, by the magnetometer of an LSM9DS1."""

from math import atan2, degrees, hypot
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import Quantity
from mindrun.robot.driver_support import ADDRESS, BUS, DEGREES, FACE, Face, OpenSensor
from mindrun.robot.i2c import I2cDevice, open_chip
from mindrun.robot.lsm9ds1 import BUS_SECONDS, MAGNETOMETER, MILLIGAUSS_PER_COUNT

MILLIGAUSS_OFFSET = Quantity("a magnetic field in milligauss", {"": 1.0}, low=-4000.0, high=4000.0)


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
