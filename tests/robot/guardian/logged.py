"""A guardian whose actuators are files: every write goes to MIND_LOG with its time. Each of MIND_MANNERS is one's.

fine      takes everything
hangs     never returns from a move
fails     refuses every move
tired     refuses the first twenty of all writes
stuck     refuses everything
missing   cannot be opened
late      cannot be opened at first
crashes   takes the whole process with it when it is moved
loose     refuses everything from its tenth write on, until it is opened anew the fourth time
jammed    the same, but that hangs the second time
exits     raises SystemExit when it is moved
"""

import os
import signal
import sys
import time
from collections import Counter
from dataclasses import dataclass
from typing import Annotated

from mindrun.driver import DeviceError
from mindrun.kinds.registry import kind
from mindrun.robot.driver_support import PIN
from mindrun.robot.guardian.__main__ import main

LOG = os.open(os.environ["MIND_LOG"], os.O_WRONLY | os.O_APPEND | os.O_CREAT)
MANNERS = os.environ.get("MIND_MANNERS", "fine fine fine").split()
NEUTRALS = (0.5, 0.5, 1.0)
_openings = Counter[int]()


@dataclass(slots=True)
class LoggedDevice:
    """Writes down what it is told to."""

    channel: int
    manner: str
    tries: int = 0

    def write(self, value: float) -> None:
        """A line: when, which, what."""
        moving = value != NEUTRALS[self.channel]
        self.tries += 1
        match self.manner, moving:
            case "hangs", True:
                time.sleep(3600)
            case ("fails", True) | ("stuck", _):
                raise DeviceError("it refuses")
            case (("loose" | "jammed"), _) if _openings[self.channel] == 1 and self.tries >= 10:
                raise DeviceError("no answer")
            case "tired", _ if self.tries <= 20:
                raise DeviceError("it is tired")
            case "crashes", True:
                signal.raise_signal(signal.SIGSEGV)
            case "exits", True:
                sys.exit(3)
        os.write(LOG, f"{time.monotonic_ns()} {self.channel} {value:.6f}\n".encode())

    def close(self) -> None:
        """A line, too."""
        os.write(LOG, f"{time.monotonic_ns()} {self.channel} closed\n".encode())


@dataclass(frozen=True, slots=True)
class Logged:
    """Takes the place of the lamp, in this process alone; its pin is the channel."""

    pin: Annotated[int, PIN]
    frequency: float = 200.0
    device = ""

    def open(self) -> LoggedDevice:
        """The channel, unless it is not there."""
        _openings[self.pin] += 1
        match MANNERS[self.pin], _openings[self.pin]:
            case ("missing", _) | ("late", 1) | ("loose", 2 | 3 | 4):
                raise DeviceError("nobody answers")
            case "jammed", 2:
                time.sleep(3600)
        if "MIND_PRINTS" in os.environ:
            print("ready or not")
        return LoggedDevice(self.pin, MANNERS[self.pin])


if __name__ == "__main__":
    kind("actuator driver", "lamp")(Logged)
    main()
