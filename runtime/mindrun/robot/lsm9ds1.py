"""The two chips of an LSM9DS1, a 9-dof sensor (STMicroelectronics; data sheet DocID025715)."""

from mindrun.robot.i2c import I2C_BYTE_SECONDS, I2cDevice, MeasuringChip

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
BUS_SECONDS = 17 * I2C_BYTE_SECONDS  # who it is, whether there is a value, and the value


def gyroscope(wire: I2cDevice) -> MeasuringChip:
    """The inertial chip, which measures how fast it turns about its axes."""
    return _chip(wire, INERTIAL_CHIP_ID, GYROSCOPE_ON, (STATUS_INERTIAL, 0x02, 0x80), OUT_GYROSCOPE)


def accelerometer(wire: I2cDevice) -> MeasuringChip:
    """The inertial chip, which measures its acceleration along its axes."""
    return _chip(wire, INERTIAL_CHIP_ID, ACCELEROMETER_ON, (STATUS_INERTIAL, 0x01, 0x80), OUT_ACCELEROMETER)


def magnetometer(wire: I2cDevice) -> MeasuringChip:
    """The magnetic chip, which measures the field along its axes."""
    return _chip(wire, MAGNETIC_CHIP_ID, MAGNETOMETER_ON, (STATUS_MAGNETIC, 0x08, 0x00), OUT_MAGNETOMETER)


def _chip(
    wire: I2cDevice, identity: int, settings: tuple[tuple[int, int], ...], status: tuple[int, int, int], out: int
) -> MeasuringChip:
    return MeasuringChip(wire, "LSM9DS1", (WHO_AM_I, identity), settings, status, out, "<hhh", MEASURED_IN)
