"""A controller that does nothing but drive, at 50 Hz: a line `loop 0` or `read 0` lets it hang, until another comes."""

import os
import sys
import threading
import time
from pathlib import Path

from mindrun.robot.drivers.lamp import Lamp
from mindrun.robot.guardian import client
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


PATIENCE = 300.0  # seconds, which decide nothing: on a busy machine a guardian takes its time
wanted: list[str] = []
silent, other = os.pipe()


def loop() -> None:
    """A procedure that does not end."""
    while not wanted:
        pass
    os.read(silent, 1)


def read() -> None:
    """A sensor that does not answer."""
    os.read(silent, 1)


def listen() -> None:
    """Keep every line."""
    for line in sys.stdin:
        wanted.append(line)
        os.write(other, b"\0")


def main() -> None:
    """Drive until the end."""
    threading.Thread(target=listen, daemon=True).start()
    client.HANG_SECONDS = PATIENCE
    with client.Guardian(PLAN, PATIENCE, LOGGED) as guardian:
        print(guardian.pid, flush=True)
        tick = 0
        begin = time.monotonic()
        while True:
            tick += 1
            guardian.send([0.6 + 0.3 * (tick % 2), 0.8, 1.0], armed=True)
            if wanted:
                how, seconds = wanted.pop().split()
                os.read(silent, 1)
                time.sleep(float(seconds))
                print(time.monotonic_ns(), flush=True)
                {"loop": loop, "read": read}[how]()
                wanted.clear()
                begin, tick = time.monotonic(), 0
            time.sleep(max(0.0, begin + tick * TICK - time.monotonic()))


if __name__ == "__main__":
    main()
