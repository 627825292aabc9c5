"""A battery's voltage by an ADS1115 (Texas Instruments, 4 inputs of 16 bits; data sheet SBAS444)."""

from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import Quantity
from mindrun.robot.driver_support import ADDRESS, BUS, OpenSensor, measuring
from mindrun.robot.i2c import I2C_BYTE_SECONDS, I2cDevice, on_bus

INPUT = Quantity("an input", {"": 1.0}, low=0, high=3, whole=True)
RATIO_OF_DIVIDER = Quantity("how many times more than the input gets", {"": 1.0}, low=1.0, high=100.0)
CONVERSION, CONFIG = 0x00, 0x01  # table 8-1
START, FROM_GROUND, RANGE_4V, ONCE, RATE_128, NO_COMPARATOR = 0x8000, 0x4000, 0x0200, 0x0100, 0x0080, 0x0003  # 8-3
VOLTS_PER_COUNT = 4.096 / 0x8000
TOO_MUCH = 0x7FFF
DONE_IN = 0.05  # seconds; at 128 a second it takes 8 ms


@kind("sensor driver", "ads1115")
class Ads1115:
    """A battery's voltage, in volts, on one input of an ADS1115.

    Two resistors bring it under 3.3 V: 100 kΩ from the battery to the input and 47 kΩ from there to ground make a
    `divider` of 3.13, for up to 10 V. Usually empty at 6.4 V and full at 8.4 V, as two lithium cells are.
    """

    channel: Annotated[int, INPUT] = 0
    divider: Annotated[float, RATIO_OF_DIVIDER] = 3.13
    bus: Annotated[int, BUS] = 1
    address: Annotated[int, ADDRESS] = 0x48

    unit = "V"
    readings = 1
    usual = (6.4, 8.4)
    possible = (0.0, 500.0)
    seconds = 0.008
    bus_seconds = 29 * I2C_BYTE_SECONDS  # setting, four questions whether it is done, and the count

    @property
    def queue(self) -> str:
        """The converter: its inputs are measured one after the other."""
        return on_bus(self.bus, self.address)

    def open(self) -> OpenSensor:
        wire = I2cDevice("the voltage converter", self.bus, self.address)
        return measuring(lambda: (self.volts(wire),), wire.close)

    def volts(self, wire: I2cDevice) -> float:
        """The battery's voltage, measured now."""
        config = FROM_GROUND | self.channel << 12 | RANGE_4V | ONCE | RATE_128 | NO_COMPARATOR
        with wire.lock:
            wire.write(CONFIG, (config | START) >> 8, config & 0xFF)
            found = wire.wait(CONFIG, START, DONE_IN, "does not finish measuring", count=2)
            if found & ~START != config:
                raise wire.error(f"has settings nobody gave it (0x{found:04x})")
            count = int.from_bytes(wire.read(CONVERSION, 2), "big", signed=True)
        if count >= TOO_MUCH:
            raise wire.error("has more than 4.096 V on its input; the divider is wrong or open")
        return max(count, 0) * VOLTS_PER_COUNT * self.divider
