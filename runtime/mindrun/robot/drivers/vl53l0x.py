"""The distance of the nearest thing in front, by a VL53L0X, which measures how long light needs to and fro.

By STMicroelectronics; data sheet DocID029104. That names few registers: those of its programming interface (UM2039) are
named here as there.
"""

from time import monotonic, sleep
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.robot.driver_support import ADDRESS, BUS, METRES, OpenSensor, Ranging, measuring
from mindrun.robot.i2c import I2C_BYTE_SECONDS, ChipModel, I2cDevice, MeasuringChip

IDENTITY, CHIP_ID = 0xC0, 0xEE  # table 4 of the data sheet
RESET = 0xBF  # 0 holds the chip in reset, 1 lets it go
START, SINGLE, REFERENCE, CONTINUOUS = 0x00, 0x01, 0x40, 0x02
STEPS = 0x01  # which of its steps a measurement has
VOLTAGE_STEP, PHASE_STEP, ALL_STEPS = 0x01, 0x02, 0xE8
INTERRUPT, WHEN_MEASURED, INTERRUPT_PIN, ACTIVE_HIGH, CLEAR_INTERRUPT = 0x0A, 0x04, 0x84, 0x10, 0x0B
LIMIT_CHECKS, NO_EARLY_CHECKS, LEAST_SIGNAL = 0x60, 0x12, 0x44
PAD_VOLTAGE, PADS_AT_2V8, MODE = 0x89, 0x01, 0x88
STATUS, MEASURED, NEVER_SET, RESULT = 0x13, 0x07, 0xE0, 0x14
LEAST_MEGACOUNTS = 0x0020  # a quarter of a million photons a second, with 7 bits behind the point
TO_PAGE_BEHIND = ((0x80, 1), (0xFF, 1), (0x00, 0))
OWN_BYTE = 0x91
TO_FIRST_PAGE = ((0x00, 1), (0xFF, 0), (0x80, 0))
VALID, DEFECTS = 11, (1, 2, 3)  # of the result's status: the laser or its supply does not work
MEASURED_IN = 0.25  # seconds until a measurement must be there; one takes 33 ms
NO_LIMIT = 1 << 16  # of millimetres
RESET_IN = 0.1  # seconds until it must be there again; it takes 1.2 ms
MODEL = ChipModel(
    "VL53L0X", (IDENTITY, CHIP_ID), (), (STATUS, MEASURED, NEVER_SET), RESULT, ">B9xH", MEASURED_IN, NO_LIMIT
)


class RangeChip(MeasuringChip):
    """One chip, set up to measure again and again; a measurement is a status and millimetres."""

    def prepare(self) -> None:
        """Reset it, write the registers that make it measure, let it calibrate itself, and start it."""
        write = self.wire.write
        self.reset()
        self.add_bits(PAD_VOLTAGE, PADS_AT_2V8)
        write(MODE, 0)
        starting = self.starting()
        self.add_bits(LIMIT_CHECKS, NO_EARLY_CHECKS)
        write(LEAST_SIGNAL, *LEAST_MEGACOUNTS.to_bytes(2, "big"))
        write(INTERRUPT, WHEN_MEASURED)
        write(INTERRUPT_PIN, self.wire.byte(INTERRUPT_PIN) & ~ACTIVE_HIGH)
        write(CLEAR_INTERRUPT, 1)
        for step, start in ((VOLTAGE_STEP, SINGLE | REFERENCE), (PHASE_STEP, SINGLE)):
            write(STEPS, step)
            write(START, start)
            self.wait()
            write(CLEAR_INTERRUPT, 1)
            write(START, 0)
        write(STEPS, ALL_STEPS)
        for register, value in starting:
            write(register, value)
        write(START, CONTINUOUS)

    def starting(self) -> tuple[tuple[int, int], ...]:
        """The (register, value) writes before a start, among them a byte of each chip's own, behind the first page."""
        for register, value in TO_PAGE_BEHIND:
            self.wire.write(register, value)
        own = self.wire.byte(OWN_BYTE)
        for register, value in TO_FIRST_PAGE:
            self.wire.write(register, value)
        return *TO_PAGE_BEHIND, (OWN_BYTE, own), *TO_FIRST_PAGE

    def reset(self) -> None:
        """Bring it to the state after power on, whatever another program left it in."""
        self.wire.write(RESET, 0)
        sleep(0.001)
        self.wire.write(RESET, 1)
        begin = monotonic()
        while self.wire.byte(IDENTITY) != CHIP_ID:
            if monotonic() - begin > RESET_IN:
                raise self.wire.error("does not come back from a reset")
            sleep(0.002)

    def add_bits(self, register: int, bits: int) -> None:
        """Set some bits of a register."""
        self.wire.write(register, self.wire.byte(register) | bits)

    def read_counts(self) -> tuple[int, ...]:
        """Read the newest measurement, and let the chip say when there is another."""
        counts = super().read_counts()
        self.wire.write(CLEAR_INTERRUPT, 1)
        return counts


@kind("sensor driver", "vl53l0x")
class Vl53l0x(Ranging):
    """A range finder of light: metres to what is within 12 degrees of its axis, for one ray of a `range_finder`.

    A VL53L0X: SDA and SCL to GPIO 2 and 3, 3.3 V. It sees up to 1.2 m in a room, less in the sun or on what is black;
    what is farther away than `range`, or sends nothing back, is none. It takes 33 ms. All of them have one address, so
    there is one on a bus.
    """

    range: Annotated[float, METRES] = 1.2
    bus: Annotated[int, BUS] = 1
    address: Annotated[int, ADDRESS] = 0x29

    readings = 1
    seconds = 0.033
    bus_seconds = 16 * I2C_BYTE_SECONDS  # whether it has measured, what, and that this has been read

    def open(self) -> OpenSensor:
        """The chip, which measures; once it is closed, for nobody."""
        wire = I2cDevice("the range finder", self.bus, self.address)
        chip = RangeChip(wire, MODEL)
        return measuring(lambda: (self.metres(chip),), wire.close)

    def metres(self, chip: RangeChip) -> float | None:
        """Metres, measured since the last one was read; None where nothing within the range sends light back."""
        found, millimetres = chip.measure()
        status = (found & 0x78) >> 3
        if status in DEFECTS:
            chip.ready = False
            raise chip.wire.error(f"says that its laser does not work ({status})")
        metres = millimetres / 1000
        return metres if status == VALID and metres <= self.range else None
