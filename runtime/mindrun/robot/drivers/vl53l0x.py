"""How far the nearest thing in front is, by a VL53L0X, which measures with light."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.robot.driver_support import ADDRESS, BUS, I2C_BYTE_SECONDS, METRES, I2cDevice
from mindrun.robot.vl53l0x import RangeChip


@dataclass(slots=True)
class LightRangeDevice:
    """A chip, and how far it is believed."""

    chip: RangeChip
    range: float

    def read(self) -> tuple[float | None]:
        """Metres, None where there is nothing within the range."""
        metres = self.chip.measure()
        return (metres if metres is not None and metres <= self.range else None,)

    def close(self) -> None:
        """Let go; it goes on measuring, for nobody."""
        self.chip.wire.close()


@kind("sensor driver", "vl53l0x")
@dataclass(frozen=True, slots=True)
class Vl53l0x:
    """A range finder of light: metres to what is within 12 degrees of its axis, for one ray of a `range_finder`.

    A VL53L0X: SDA and SCL to GPIO 2 and 3, 3.3 V. It sees up to 1.2 m in a room, less in the sun or on what is black;
    what is farther away than `range`, or sends nothing back, is none. It takes 33 ms. All of them have one address, so
    there is one on a bus.
    """

    range: Annotated[float, METRES] = 1.2
    bus: Annotated[int, BUS] = 1
    address: Annotated[int, ADDRESS] = 0x29

    unit = "m"
    readings = 1
    seconds = 0.033
    bus_seconds = 16 * I2C_BYTE_SECONDS  # whether it has measured, what, and that this has been read

    @property
    def usual(self) -> tuple[float, float]:
        """Touching, and clear within the range."""
        return 0.0, self.range

    @property
    def possible(self) -> tuple[float, float]:
        """What is not nonsense."""
        return self.usual

    def open(self) -> LightRangeDevice:
        """The chip, which measures."""
        chip = RangeChip(I2cDevice("the range finder", self.bus, self.address))
        try:
            chip.measure()
        except Exception:
            chip.wire.close()
            raise
        return LightRangeDevice(chip, self.range)
