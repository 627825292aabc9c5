"""What a guardian says on its pipe, a line each, and the controller's ear for it.

worker PID   the process that opens the actuators; another watches it
ready, failed WHY, following, neutral WHY, latched WHY   how the worker is
rest         the worker's last word: every actuator that could be opened is at neutral
rest NAME    the worker is lost, and this actuator has been brought to neutral in its place
over         all has been done that can be
"""

import os
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from select import select
from time import monotonic

WORKER, REST, OVER = "worker", "rest", "over"


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
        """Whether the worker is no more."""
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
