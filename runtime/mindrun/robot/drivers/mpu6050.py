"""How fast the robot turns, by the gyroscope of an MPU-6050 (InvenSense; register map RM-MPU-6000A)."""

from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import NUMBER
from mindrun.robot.driver_support import ADDRESS, BUS, FACE, Face, OpenSensor
from mindrun.robot.i2c import I2C_BYTE_SECONDS, ChipModel, I2cDevice, open_chip

WHO_AM_I, CHIP_ID = 0x75, 0x68  # 4.32
STATUS, DATA_READY, NEVER_SET = 0x3A, 0x01, 0xE6  # 4.16; free fall and the like, which are off
OUT_Z = 0x47  # 4.19
SETTINGS = (
    (0x6B, 0x01),  # PWR_MGMT_1: awake, with the clock of the gyroscope
    (0x1A, 0x03),  # CONFIG: a low-pass of 42 Hz, 1 kHz inside
    (0x19, 0x09),  # SMPLRT_DIV: 100 values a second
    (0x1B, 0x08),  # GYRO_CONFIG: ±500 °/s
    (0x38, 0x01),  # INT_ENABLE: the status says that there is a new value
)
COUNTS_PER_DEGREE_PER_SECOND = 65.5  # at ±500 °/s, 4.19
MEASURED_IN = 0.2  # seconds until a new value must be there; they come every 10 ms, the first after 30
MODEL = ChipModel("MPU-6050", (WHO_AM_I, CHIP_ID), SETTINGS, (STATUS, DATA_READY, NEVER_SET), OUT_Z, ">h", MEASURED_IN)


@kind("sensor driver", "mpu6050")
class Mpu6050:
    """How fast the robot turns, in degrees a second, to the left (counterclockwise) positive: for a `turn_rate`.

    An MPU-6050 (GY-521) that lies flat, its printed side `face` up or down: SDA and SCL to GPIO 2 and 3, 3.3 V. `still`
    is what it reads at rest.
    """

    face: Annotated[Face, FACE] = "up"
    still: Annotated[float, NUMBER] = 0.0
    bus: Annotated[int, BUS] = 1
    address: Annotated[int, ADDRESS] = 0x68

    unit = "deg/s"
    readings = 1
    usual = (180.0, -180.0)
    possible = (-1000.0, 1000.0)
    seconds = 0.01
    bus_seconds = 13 * I2C_BYTE_SECONDS  # who it is, whether there is a value, and the value

    def open(self) -> OpenSensor:
        """The gyroscope, awake."""
        wire, sign = I2cDevice("the gyroscope", self.bus, self.address), 1 if self.face == "up" else -1
        return open_chip(wire, MODEL, lambda counts: sign * counts[0] / COUNTS_PER_DEGREE_PER_SECOND - self.still)
