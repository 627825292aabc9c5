"""The chip VL53L0X (STMicroelectronics), which measures how long light needs to and fro; data sheet DocID029104.

The data sheet names few registers: those of its programming interface (UM2039) are named here as there.
"""

from dataclasses import dataclass
from time import monotonic, sleep

from mindrun.robot.driver_support import I2cDevice

IDENTITY, CHIP_ID = 0xC0, 0xEE  # table 4 of the data sheet
RESET = 0xBF  # 0 holds the chip in reset, 1 lets it go
START, SINGLE, REFERENCE, CONTINUOUS = 0x00, 0x01, 0x40, 0x02
STEPS = 0x01  # which of its steps a measurement has
VOLTAGE_STEP, PHASE_STEP, ALL_STEPS = 0x01, 0x02, 0xE8
INTERRUPT, WHEN_MEASURED, INTERRUPT_PIN, ACTIVE_HIGH, CLEAR_INTERRUPT = 0x0A, 0x04, 0x84, 0x10, 0x0B
LIMIT_CHECKS, NO_EARLY_CHECKS, LEAST_SIGNAL = 0x60, 0x12, 0x44
PAD_VOLTAGE, PADS_AT_2V8, MODE = 0x89, 0x01, 0x88
STATUS, MEASURED, RESULT, RESULT_BYTES = 0x13, 0x07, 0x14, 12
LEAST_MEGACOUNTS = 0x0020  # a quarter of a million photons a second, with 7 bits behind the point
TO_PAGE_BEHIND = ((0x80, 1), (0xFF, 1), (0x00, 0))
OWN_BYTE = 0x91
TO_FIRST_PAGE = ((0x00, 1), (0xFF, 0), (0x80, 0))
VALID, DEFECTS = 11, (1, 2, 3)  # of the result's status: the laser or its supply does not work
MEASURED_IN = 0.25  # seconds until a measurement must be there; one takes 33 ms
RESET_IN = 0.1  # seconds until it must be there again; it takes 1.2 ms


@dataclass(slots=True)
class RangeChip:
    """One chip, set up to measure again and again."""

    wire: I2cDevice
    ready: bool = False

    def measure(self) -> float | None:
        """Metres, measured since the last one was read; None where nothing sends enough light back."""
        try:
            self.identify()
            if not self.ready:
                self.prepare()
            self.wait()
            result = self.wire.read(RESULT, RESULT_BYTES)
            self.wire.write(CLEAR_INTERRUPT, 1)
        except Exception:
            self.ready = False  # after a brown-out it has to be set up again
            raise
        status = (result[0] & 0x78) >> 3
        if status in DEFECTS:
            self.ready = False
            raise self.wire.error(f"says that its laser does not work ({status})")
        return int.from_bytes(result[10:12], "big") / 1000 if status == VALID else None

    def identify(self) -> None:
        """DeviceError where something else answers."""
        found = self.wire.read(IDENTITY, 1)[0]
        if found != CHIP_ID:
            raise self.wire.error(f"is no VL53L0X (it says 0x{found:02x}, not 0x{CHIP_ID:02x})")

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
        write(INTERRUPT_PIN, self.wire.read(INTERRUPT_PIN, 1)[0] & ~ACTIVE_HIGH)
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
        self.ready = True

    def starting(self) -> tuple[tuple[int, int], ...]:
        """What has to be written before it starts: a byte of each chip's own, on the page behind the first."""
        for register, value in TO_PAGE_BEHIND:
            self.wire.write(register, value)
        own = self.wire.read(OWN_BYTE, 1)[0]
        for register, value in TO_FIRST_PAGE:
            self.wire.write(register, value)
        return *TO_PAGE_BEHIND, (OWN_BYTE, own), *TO_FIRST_PAGE

    def reset(self) -> None:
        """Bring it to the state after power on, whatever another program left it in."""
        self.wire.write(RESET, 0)
        sleep(0.001)
        self.wire.write(RESET, 1)
        begin = monotonic()
        while self.wire.read(IDENTITY, 1)[0] != CHIP_ID:
            if monotonic() - begin > RESET_IN:
                raise self.wire.error("does not come back from a reset")
            sleep(0.002)

    def add_bits(self, register: int, bits: int) -> None:
        """Set some bits of a register."""
        self.wire.write(register, self.wire.read(register, 1)[0] | bits)

    def wait(self) -> None:
        """Return when it has measured."""
        begin = monotonic()
        while not (status := self.wire.read(STATUS, 1)[0]) & MEASURED:
            if monotonic() - begin > MEASURED_IN:
                raise self.wire.error("does not measure anything new")
            sleep(0.002)
        if status & ~0x1F:
            raise self.wire.error(f"has an impossible status (0x{status:02x})")
