"""The two pipes between the controller and its guardian: frames go one way, lines of text the other.

A frame is what the controller wants of every actuator in one tick, in so few bytes that a pipe takes all or none. What
a guardian says is a line each:

worker PID   the process that opens the actuators; another watches it
ready, failed WHY, following, neutral WHY, latched WHY   how the worker is
rest         the worker's last word: every actuator that could be opened is at neutral
rest NAME    the worker is lost, and this actuator has been brought to neutral in its place
over         all has been done that can be
"""

import os
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from math import inf, isfinite
from select import select
from struct import Struct
from time import monotonic
from zlib import crc32

MAGIC, FRAME_VERSION = b"MIND", 2
HEAD = "<4sBBHQq"  # magic, version, armed, how many commands, number, when it was sent
CHECK = Struct("<I")
MAX_COMMANDS = 1000  # commands: a write of up to 4096 bytes is atomic
WORKER, REST, OVER = "worker", "rest", "over"


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
    return _layout(count).size + CHECK.size


def pack(number: int, sent_ns: int, armed: bool, commands: Sequence[float]) -> bytes:
    """A frame as bytes, whatever its commands are: the reader refuses them."""
    head = MAGIC, FRAME_VERSION, armed, len(commands), number, sent_ns
    try:
        data = _layout(len(commands)).pack(*head, *commands)
    except OverflowError:  # larger than any float32
        data = _layout(len(commands)).pack(*head, *[inf] * len(commands))
    return data + CHECK.pack(crc32(data))


def _layout(count: int) -> Struct:
    return Struct(f"{HEAD}{count}f")


class Reader:
    """Makes frames out of the bytes of a pipe as they come."""

    def __init__(self, count: int) -> None:
        self._count = count
        self._rest = b""
        self._number = -1

    def feed(self, data: bytes) -> list[Frame]:
        """The frames that are complete with this data; FrameError where one of them is bad, and then for good."""
        self._rest += data
        frames, length = [], size(self._count)
        while len(self._rest) >= length:
            frames.append(self._frame(self._rest[:length]))
            self._rest = self._rest[length:]
        return frames

    def _frame(self, data: bytes) -> Frame:
        magic, version, armed, count, number, sent, *commands = _layout(self._count).unpack_from(data)
        for wrong, what in (
            (magic != MAGIC or version != FRAME_VERSION, "that is no frame"),
            (CHECK.pack(crc32(data[: -CHECK.size])) != data[-CHECK.size :], "that is damaged"),
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
        return Frame(number, sent / 1e9, bool(armed), tuple(commands))


def say(descriptor: int, *words: object) -> None:
    """Say a line at once; where nobody takes it, it is dropped."""
    with suppress(OSError):
        os.write(descriptor, f"{' '.join(map(str, words))}\n".encode())


@dataclass(slots=True)
class Heard:
    """All that was heard from a pipe, which must not block."""

    descriptor: int
    state: str = ""
    why: str = ""
    worker: int = 0  # 0: not said
    rests: bool = False
    at_rest: set[str] = field(default_factory=set)
    is_over: bool = False
    has_ended: bool = False  # nothing more will be said
    _part: bytes = b""

    @property
    def is_lost(self) -> bool:
        """True if the worker has said its last word, or was lost."""
        return self.rests or bool(self.at_rest) or self.is_over

    def listen(self) -> None:
        """Hear what was said since."""
        try:
            data = os.read(self.descriptor, 1 << 16)
        except BlockingIOError:
            return
        except OSError:  # a driver has closed it
            data = b""
        self.has_ended = not data
        *lines, self._part = (self._part + data).split(b"\n")
        for line in lines:
            self._take(*line.decode(errors="replace").partition(" ")[::2])

    def wait(self, enough: Callable[["Heard"], object], seconds: float) -> bool:
        """Listen until that is enough, or nothing more will be said; False where that takes more than so long."""
        until = monotonic() + seconds
        while not enough(self) and not self.has_ended:
            if not select([self.descriptor], [], [], max(until - monotonic(), 0.0))[0]:
                return False
            self.listen()
        return True

    def _take(self, word: str, rest: str) -> None:
        match word:
            case "worker":
                self.worker = int(rest)
            case "rest" if rest:
                self.at_rest.add(rest)
            case "rest":
                self.rests = True
            case "over":
                self.is_over = True
            case _:
                self.state, self.why = word, rest
