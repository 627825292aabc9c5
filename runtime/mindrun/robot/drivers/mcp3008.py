"""Analogue sensors on an MCP3008 (Microchip, 8 inputs of 10 bits on SPI; data sheet DS21295)."""

from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import Quantity
from mindrun.robot.driver_support import CHIP, OpenSensor, Shares, open_inputs

INPUT = Quantity("an input", {"": 1.0}, low=0, high=7, whole=True)


@kind("sensor driver", "mcp3008")
class Mcp3008(Shares):
    """Analogue sensors (of `light`, of the `floor`) on an MCP3008: voltages as shares of its reference, 3.3 V.

    `inputs` lists them in the order of the sensor's readings. A light sensor is an LDR from 3.3 V to the input and
    10 kΩ from there to ground: the brighter, the more. What it reads in the dark and in the light are `from` and `to`:
    `mindrun calibrate` says them. It hangs on SPI bus 0, GPIO 9 to 11, chip select `chip` is GPIO 8 or 7; turn SPI on
    with `sudo raspi-config nonint do_spi 0`. Nothing can tell that an input is not connected: it reads anything.
    """

    inputs: Annotated[tuple[int, ...], INPUT]
    chip: Annotated[int, CHIP] = 0

    @property
    def readings(self) -> int:
        return len(self.inputs)

    def open(self) -> OpenSensor:
        what, where = "the analogue converter", {"port": 0, "device": self.chip}
        inputs = ((f"input {number} of {what}", "MCP3008", {"channel": number, **where}) for number in self.inputs)
        return open_inputs(what, *inputs)
