"""A guardian whose actuators are files: every write goes to MIND_LOG with its time. Each of MIND_MANNERS is one's.

fine      takes everything
hangs     never returns from a move
fails     refuses every move
tired     refuses the first twenty of all writes
stuck     refuses everything
missing   cannot be opened
crashes   takes the whole process with it when it is moved
exits     raises SystemExit when it is moved
"""

import os
import signal
import sys
import time
from dataclasses import dataclass
from importlib import import_module
from itertools import count

from mindrun.driver import DeviceError
from mindrun.registry import kind
from mindrun.robot.guardian.__main__ import main
from mindrun.robot.guardian.plan import DRIVERS
from mindrun.robot.guardian.realtime import import_little

LOG = os.open(os.environ["MIND_LOG"], os.O_WRONLY | os.O_APPEND | os.O_CREAT)
MANNERS = os.environ.get("MIND_MANNERS", "fine fine fine").split()
NEUTRALS = tuple(map(float, os.environ.get("MIND_NEUTRALS", "0.5 0.5 1.0").split()))
_channels = count()


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
            case "tired", _ if self.tries <= 20:
                raise DeviceError("it is tired")
            case "crashes", True:
                os.kill(os.getpid(), signal.SIGSEGV)
            case "exits", True:
                sys.exit(3)
        os.write(LOG, f"{time.monotonic_ns()} {self.channel} {value:.6f}\n".encode())

    def close(self) -> None:
        """A line, too."""
        os.write(LOG, f"{time.monotonic_ns()} {self.channel} closed\n".encode())


@dataclass(frozen=True, slots=True)
class Logged:
    """Takes the place of the mock, in this process alone."""

    def open(self) -> LoggedDevice:
        """The next channel."""
        channel = next(_channels)
        if MANNERS[channel] == "missing":
            raise DeviceError("nobody answers")
        if "MIND_PRINTS" in os.environ:
            print("ready or not")
        return LoggedDevice(channel, MANNERS[channel])


if __name__ == "__main__":
    import_little(DRIVERS)
    import_module(f"{DRIVERS}.mock")  # which is replaced
    kind("actuator driver", "mock")(Logged)
    main()
