"""A guardian whose drivers do harm, and a controller that ends in some way: `python hostile.py` is the first of both.

Each of MIND_MANNERS is `HOW@WHEN` of an actuator, or `fine`. WHEN: `open`, `write N`, `stop` (neutral, once it has
moved), `neutral` (whenever it is told), `close`. HOW is a name of `HARM`. `hostile.py drive HOW SECONDS` is the
controller; what each actuator was told, and each end, are lines of MIND_LOG. All may be of one MIND_DEVICE.
"""

import os
import signal
import sys
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, Any

from mindrun.driver import DeviceError
from mindrun.kinds.registry import kind
from mindrun.robot.driver_support import PIN

NEUTRALS = (0.5, 0.5, 1.0)
TICK = 0.02
PATIENCE = 3.0


def note(*words: object) -> None:
    """A line of the log, whatever descriptors there are."""
    log = os.open(os.environ["MIND_LOG"], os.O_WRONLY | os.O_APPEND)
    os.write(log, f"{time.monotonic_ns()} {' '.join(map(str, words))}\n".encode())
    os.close(log)


def _raise(error: type[BaseException]) -> Callable[[], None]:
    def harm() -> None:
        raise error("it refuses")

    return harm


class UnsaidError(Exception):
    """An error of which nothing can be said."""

    def __str__(self) -> str:
        return str(self.args[1])


def _kill(number: signal.Signals) -> Callable[[], None]:
    return lambda: signal.raise_signal(number)  # in this thread, as a fault of C code is: nothing is written after it


def _stay() -> None:
    if not os.fork():
        time.sleep(2)
        os._exit(0)


HARM: dict[str, Callable[[], Any]] = {
    "raise": _raise(DeviceError),
    "unsaid": _raise(UnsaidError),
    "exit": _raise(SystemExit),
    "_exit 0": lambda: os._exit(0),
    "_exit 1": lambda: os._exit(1),
    "SIGKILL": _kill(signal.SIGKILL),
    "group": lambda: os.killpg(0, signal.SIGKILL),
    "SIGSEGV": _kill(signal.SIGSEGV),
    "SIGSTOP": _kill(signal.SIGSTOP),
    "SIGTERM": _kill(signal.SIGTERM),
    "hang": lambda: time.sleep(3600),
    "close": lambda: os.closerange(3, 256),
    "fork": os.fork,
    "stay": _stay,
    "print": lambda: print("x" * 100_000, flush=True),  # more than a pipe takes
}
WHEN = ("open", "write", "stop", "neutral", "close")


@dataclass(slots=True)
class Device:
    """Writes down what it is told to, and does its harm."""

    channel: int
    how: str
    when: str
    writes: int = 0
    has_moved: bool = False

    def harm(self, *moments: str) -> None:
        """Do it, if it is one of these moments."""
        if self.when in moments:
            note("harm", self.channel, self.how)
            HARM[self.how]()

    def write(self, value: float) -> None:
        """A line, unless it comes to harm before."""
        self.writes += 1
        rests = value == NEUTRALS[self.channel]
        self.harm(f"write {self.writes}", *["stop"] * (rests and self.has_moved), *["neutral"] * rests)
        self.has_moved = self.has_moved or not rests
        note(self.channel, f"{value:.6f}")

    def close(self) -> None:
        """Nothing, but for harm."""
        self.harm("close")


@dataclass(frozen=True, slots=True)
class Hostile:
    """Takes the place of the lamp; its pin is the channel."""

    pin: Annotated[int, PIN]
    frequency: float = 200.0
    device = os.environ.get("MIND_DEVICE", "")

    def open(self) -> Device:
        """The channel."""
        how, _, when = os.environ["MIND_MANNERS"].split(",")[self.pin].partition("@")
        device = Device(self.pin, how, when)
        device.harm("open")
        return device


def guard() -> None:
    """Be a guardian."""
    from mindrun.robot.guardian.__main__ import main

    kind("actuator driver", "lamp")(Hostile)
    main()


def end(how: str) -> None:
    """In the controller: end so."""
    note("end", how)
    match how:
        case "_exit":  # of a sensor's driver, in a thread of its own
            threading.Thread(target=os._exit, args=(0,)).start()
            time.sleep(3600)
        case "error":
            raise ZeroDivisionError
        case "hang":
            time.sleep(0.5)
            sys.exit(0)
        case _:
            sys.exit(0)


def drive(how: str, seconds: float) -> None:
    """Be a controller, at 50 Hz, that ends `how` some time after something has moved, or never."""
    from mindrun.robot.guardian.client import Guardian, GuardianError

    from tests.robot.guardian.driven import PLAN

    program = (sys.executable, "-P", __file__)
    try:
        with Guardian(PLAN, PATIENCE, program) as guardian:
            print(guardian.pid, guardian._processes.first.pid, flush=True)
            begin, tick = time.monotonic(), 0
            while True:
                tick += 1
                guardian.send([0.6 + 0.3 * (tick % 2), 0.8, 1.0], armed=True)
                if how != "never" and time.monotonic() > begin + seconds:
                    end(how)
                time.sleep(max(0.0, begin + tick * TICK - time.monotonic()))
    except GuardianError as error:
        note("said", error)
        sys.exit(2)


if __name__ == "__main__":
    if sys.argv[1:2] == ["drive"]:
        drive(sys.argv[2], float(sys.argv[3]))
    else:
        guard()
