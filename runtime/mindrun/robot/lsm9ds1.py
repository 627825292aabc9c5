"""The two chips of an LSM9DS1, a 9-dof sensor (STMicroelectronics; data sheet DocID025715)."""

from mindrun.robot.i2c import I2C_BYTE_SECONDS, ChipModel

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
