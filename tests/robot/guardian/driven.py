"""A controller that does nothing but drive, at 50 Hz: `loop 0.1` and `read 0.1` on its standard input make it hang."""

import os
import sys
import threading
import time
from pathlib import Path

from mindrun.robot.drivers.lamp import Lamp
from mindrun.robot.guardian.client import Guardian
from mindrun.robot.guardian.plan import Channel, Plan

TICK = 0.02
LOGGED = (sys.executable, "-P", str(Path(__file__).with_name("logged.py")))
PLAN = Plan(
    TICK,
    (
        Channel("left_wheel", 0.5, Lamp(0)),
        Channel("right_wheel", 0.5, Lamp(1)),
        Channel("claw", 0.0, Lamp(2), reversed=True),
    ),
)


def loop(seconds: float) -> None:
    """A procedure that does not end."""
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        pass


def read(seconds: float) -> None:
    """A sensor that does not answer."""
    silent, other = os.pipe()
    threading.Timer(seconds, os.write, (other, b"\0")).start()
    os.read(silent, 1)


def main() -> None:
    """Drive until the end."""
    wanted: list[str] = []
    threading.Thread(target=lambda: wanted.extend(sys.stdin), daemon=True).start()
    with Guardian(PLAN, program=LOGGED) as guardian:
        print(guardian.pid, flush=True)
        tick = 0
        begin = time.monotonic()
        while True:
            tick += 1
            guardian.send([0.6 + 0.3 * (tick % 2), 0.8, 1.0], armed=True)
            if wanted:
                how, seconds = wanted.pop().split()
                time.sleep(float(seconds) % TICK)
                print(time.monotonic_ns(), flush=True)
                {"loop": loop, "read": read}[how](float(seconds))
                begin, tick = time.monotonic(), 0
            time.sleep(max(0.0, begin + tick * TICK - time.monotonic()))


if __name__ == "__main__":
    main()
