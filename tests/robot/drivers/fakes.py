"""A fake I2C bus and the parts on it, which behave as their data sheets say; it can fail, hang and talk nonsense."""

import random
from dataclasses import dataclass, field
from time import monotonic, sleep


class Registers:
    """A part with registers: the first byte written is where, those after it go there and on."""

    def __init__(self) -> None:
        self.values: dict[int, int] = {}
        self.pointer = 0

    def write(self, out: bytes) -> None:
        self.pointer = out[0]
        for offset, value in enumerate(out[1:]):
            self.set(out[0] + offset, value)

    def set(self, register: int, value: int) -> None:
        self.values[register] = value

    def get(self, register: int) -> int:
        return self.values.get(register, 0)

    def read(self, count: int) -> bytes:
        return bytes(self.get(self.pointer + offset) for offset in range(count))


class FakePca9685(Registers):
    """After power on it sleeps at 200 Hz, its outputs off. The rate changes only while it sleeps (7.3.5)."""

    def __init__(self) -> None:
        super().__init__()
        self.power_on()

    def power_on(self) -> None:
        self.values = {0x00: 0x11, 0x01: 0x04, 0xFE: 0x1E} | {0x09 + 4 * channel: 0x10 for channel in range(16)}

    def write(self, out: bytes) -> None:
        if self.values[0x00] & 0x20:
            super().write(out)
            return
        self.pointer = out[0]  # without the bit AI the register stays the same
        for value in out[1:]:
            self.set(out[0], value)

    def set(self, register: int, value: int) -> None:
        match register:
            case 0xFE if not self.values[0x00] & 0x10:
                return
            case 0xFD:
                for channel in range(16):
                    self.values[0x09 + 4 * channel] = value
        super().set(register, value)

    def pulse(self, channel: int) -> float | None:
        """Microseconds of the pulses of a channel, None where there are none."""
        _, _, low, high = (self.values.get(0x06 + 4 * channel + byte, 0) for byte in range(4))
        if self.values[0x00] & 0x10 or high & 0x10:
            return None
        assert self.values[0x00] & 0x20
        return (low | high << 8) * (self.values[0xFE] + 1) / 25


@dataclass
class FakeGroveMotor:
    """Commands have three bytes and need some ms, in which the next is lost. Two bits of direction for each motor."""

    speeds: list[int] = field(default_factory=lambda: [0, 0])
    directions: int = 0
    commands: list[bytes] = field(default_factory=list)
    busy_until: float = 0.0

    def write(self, out: bytes) -> None:
        assert len(out) == 3
        assert monotonic() >= self.busy_until, "too soon after the command before"
        self.busy_until = monotonic() + 0.003
        self.commands.append(out)
        match out[0]:
            case 0x82:
                self.speeds = [*out[1:]]
            case 0xAA:
                self.directions = out[1]
            case other:
                assert other == 0x84

    def turning(self, motor: int) -> int:
        """The speed of a motor, backwards below 0."""
        polarity = self.directions >> 2 * motor & 0b11
        return {0b10: 1, 0b01: -1}.get(polarity, 0) * self.speeds[motor]


@dataclass
class FakeGrovePi:
    """Takes 4 bytes, is busy for a while, then repeats the command and answers: centimetres of the ranger on a port."""

    centimetres: dict[int, int]
    takes: float = 0.006
    command: bytes = b"\0\0\0\0"
    done_at: float = 0.0

    def write(self, out: bytes) -> None:
        assert len(out) == 4
        self.command, self.done_at = out, monotonic() + self.takes

    def read(self, count: int) -> bytes:
        if monotonic() < self.done_at:
            return bytes([23, *[255] * (count - 1)])
        match self.command[0]:
            case 8:
                return bytes([8, 1, 4, 0])
            case 7:
                found = self.centimetres.get(self.command[1], 0)
                return bytes([7, found >> 8, found & 0xFF])
        raise AssertionError(self.command)


class FakeAds1115(Registers):
    """Registers of two bytes; a conversion takes 8 ms, while bit 15 of the settings reads 0."""

    def __init__(self, volts: float) -> None:
        super().__init__()
        self.volts, self.config, self.done_at = volts, 0x8583, 0.0

    def write(self, out: bytes) -> None:
        self.pointer = out[0]
        if len(out) == 3:
            assert out[0] == 1
            self.config = int.from_bytes(out[1:], "big")
            assert self.config & 0x0E00 == 0x0200, "±4.096 V"
            self.done_at = monotonic() + 0.008

    def read(self, count: int) -> bytes:
        assert count == 2
        if self.pointer == 1:
            return (self.config & 0x7FFF | (monotonic() >= self.done_at) << 15).to_bytes(2, "big")
        assert monotonic() >= self.done_at
        return max(-0x8000, min(0x7FFF, round(self.volts / 4.096 * 0x8000))).to_bytes(2, "big", signed=True)


class FakeLsm9ds1(Registers):
    """One of the two chips. Off until the register `on` has been given, it has a new vector every 9 ms from then on."""

    def __init__(self, identity: int, on: int, status: int, fresh: int, out: int) -> None:
        super().__init__()
        self.identity, self.on, self.status, self.fresh, self.out = identity, on, status, fresh, out
        self.vector = (0.0, 0.0, 0.0)  # in counts
        self.shaken = 0.0  # counts, by how much each value is off
        self.taken = 0.0
        self.rng = random.Random(1)

    def read(self, count: int) -> bytes:
        if self.pointer == 0x0F:
            return bytes([self.identity])
        if self.pointer == self.status:
            return bytes([self.fresh if self.on in self.values and monotonic() - self.taken > 0.009 else 0])
        assert (self.pointer, count) == (self.out, 6)
        self.taken = monotonic()
        shaken = (value + self.rng.gauss(0, 8) + self.rng.gauss(0, self.shaken) for value in self.vector)
        return b"".join(round(value).to_bytes(2, "little", signed=True) for value in shaken)


class FakeMpu6050(Registers):
    """It sleeps after power on (register 0x6B); awake, with its interrupt on, it has a new vector every 10 ms."""

    def __init__(self, turning: float) -> None:
        super().__init__()
        self.turning = turning  # degrees a second
        self.taken = 0.0
        self.power_on()

    def power_on(self) -> None:
        self.values = {0x6B: 0x40}

    def read(self, count: int) -> bytes:
        if self.pointer == 0x75:
            return bytes([0x68])
        if self.pointer == 0x3A:
            runs = not self.get(0x6B) & 0x40 and self.get(0x38) & 1
            return bytes([bool(runs and monotonic() - self.taken > 0.009)])
        assert (self.pointer, count) == (0x47, 2)
        self.taken = monotonic()
        counts_per_degree = 131 / (1 << (self.get(0x1B) >> 3 & 3))
        return round(self.turning * counts_per_degree).to_bytes(2, "big", signed=True)


class FakeVl53l0x(Registers):
    """A measurement takes 10 ms, and only the byte of its own at 0x91 of the page behind lets it go on measuring."""

    OWN = 0x3C

    def __init__(self, metres: float | None) -> None:
        super().__init__()
        self.metres, self.status = metres, 0x40
        self.power_on()

    def power_on(self) -> None:
        self.values = {0x84: 0x10, 0x01: 0xFF}
        self.in_reset, self.calibrated, self.runs = False, set[int](), False
        self.done_at: float | None = None

    def set(self, register: int, value: int) -> None:
        behind = self.get(0xFF) == 1
        if register == 0xBF:
            self.power_on()
            self.in_reset = not value
        elif register == 0x00 and not behind and value & 0x03:
            assert self.get(0x0A) == 0x04
            self.done_at = monotonic() + 0.01
            if value & 0x02:
                assert self.calibrated == {(0x01, 0x41), (0x02, 0x01)}
                assert (self.get(0x01), self.get(0x89)) == (0xE8, 0x01)
                self.runs = self.get(0x91) == self.OWN
            else:
                self.calibrated.add((self.get(0x01), value))
        elif register == 0x0B:
            self.done_at = monotonic() + 0.01 if self.runs else None
        elif register != 0x00:
            super().set(register, value)

    def get(self, register: int) -> int:
        if register == 0x91 and register not in self.values:
            return self.OWN if self.values.get(0xFF) == 1 else 0
        return super().get(register)

    def read(self, count: int) -> bytes:
        match self.pointer:
            case 0xC0:
                return bytes([0 if self.in_reset else 0xEE])
            case 0x13:
                return bytes([4 * (self.done_at is not None and monotonic() >= self.done_at)])
            case 0x14:
                status = 0x58 if self.metres is not None else self.status
                millimetres = 8190 if self.metres is None else round(self.metres * 1000)
                return bytes([status, *bytes(9)]) + millimetres.to_bytes(2, "big")
        return super().read(count)


@dataclass
class FakeBus:
    """A bus. Transfers fail with the probability `failing`, take `hang` seconds, or are answered with `garbage`."""

    parts: dict[int, object] = field(default_factory=dict)
    failing: float = 0.0
    hang: float = 0.0
    garbage: str = ""
    open: int = 0
    sent: int = 0
    rng: random.Random = field(default_factory=lambda: random.Random(1))

    def transfer(self, address: int, out: bytes, count: int) -> bytes:
        self.sent += bool(out)
        sleep(self.hang)
        if self.rng.random() < self.failing or address not in self.parts:
            raise OSError(121, "Remote I/O error")
        part = self.parts[address]
        if out:
            part.write(out)
        answer = part.read(count) if count else b""
        match self.garbage:
            case "ones":
                return b"\xff" * count
            case "zeros":
                return b"\0" * count
            case "noise":
                return self.rng.randbytes(count)
            case "short":
                return answer[1:]
        return answer

    def close(self) -> None:
        self.open -= 1
