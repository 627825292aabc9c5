"""A frame: what the controller wants of every actuator in one tick, in so few bytes that a pipe takes all or none."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, isfinite
from struct import Struct
from zlib import crc32

MAGIC, FRAME_VERSION = b"MIND", 2
HEAD = Struct("<4sBBHQq")  # magic, version, armed, how many commands, number, when it was sent
CHECK = Struct("<I")
MAX_COMMANDS = 1000  # commands: a write of up to 4096 bytes is atomic


class FrameError(Exception):
    """Bytes that are no frame, or not the one that can come next."""


@dataclass(frozen=True, slots=True)
class Frame:
    """The commands of one tick, in the order of the plan; `sent` is the monotonic clock of both processes, in seconds.

    Where it is not `armed`, it says no more than that the controller lives.
    """

    number: int
    sent: float
    armed: bool
    commands: tuple[float, ...]


def size(count: int) -> int:
    """How many bytes a frame of so many commands has."""
    return HEAD.size + 4 * count + CHECK.size


def pack(number: int, sent_ns: int, armed: bool, commands: Sequence[float]) -> bytes:
    """A frame as bytes, whatever its commands are: to refuse them is the reader's."""
    floats = _floats(len(commands))
    try:
        body = floats.pack(*commands)
    except OverflowError:  # larger than any float32
        body = floats.pack(*[inf] * len(commands))
    data = HEAD.pack(MAGIC, FRAME_VERSION, armed, len(commands), number, sent_ns) + body
    return data + CHECK.pack(crc32(data))


class Reader:
    """Makes frames of bytes as they come."""

    def __init__(self, count: int) -> None:
        self._count = count
        self._size = size(count)
        self._rest = b""
        self._number = -1

    def feed(self, data: bytes) -> list[Frame]:
        """The frames that are complete with this data; FrameError where one of them is bad, and then for good."""
        self._rest += data
        frames = []
        while len(self._rest) >= self._size:
            frames.append(self._frame(self._rest[: self._size]))
            self._rest = self._rest[self._size :]
        return frames

    def _frame(self, data: bytes) -> Frame:
        magic, version, armed, count, number, sent = HEAD.unpack_from(data)
        commands = _floats(self._count).unpack_from(data, HEAD.size)
        for wrong, what in (
            (magic != MAGIC or version != FRAME_VERSION, "that is no frame"),
            (CHECK.unpack_from(data, self._size - CHECK.size)[0] != crc32(data[: -CHECK.size]), "that is damaged"),
            (count != self._count, f"with {count} commands instead of {self._count}"),
            (armed > 1, f"with an armed flag of {armed}"),
            (number <= self._number, f"number {number} after number {self._number}"),
            # Asked before any comparison: NaN is neither too small nor too large.
            (not all(map(isfinite, commands)), "with a command that is not finite"),
            (not all(0.0 <= command <= 1.0 for command in commands), "with a command out of 0..1"),
        ):
            if wrong:
                raise FrameError(f"a frame {what}")
        self._number = number
        return Frame(number, sent / 1e9, bool(armed), commands)


def _floats(count: int) -> Struct:
    return Struct(f"<{count}f")
