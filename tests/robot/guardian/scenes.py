"""What happens to a real controller and its real guardian, and how long it moves on: for tests and figures."""

import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from math import inf
from pathlib import Path

from mindrun.robot.guardian.client import Guardian
from mindrun.robot.guardian.messages import pack
from mindrun.robot.guardian.plan import to_json

from tests.robot.guardian.driven import LOGGED, PATIENCE, PLAN, TICK

NEUTRALS = (0.5, 0.5, 1.0)  # as the devices count
KILLS = (signal.SIGKILL, signal.SIGTERM, signal.SIGSEGV)
LOSSES = (signal.SIGKILL, signal.SIGSTOP)  # of a guardian
HANGS = ("stop", "loop", "read")
DRIVEN = Path(__file__).with_name("driven.py")


@dataclass(frozen=True, slots=True)
class Write:
    """What a device was told, and when."""

    time: float
    channel: int
    value: float | None  # None: it was closed

    @property
    def neutral(self) -> bool:
        """Whether that was neutral."""
        return self.value == NEUTRALS[self.channel]


def writes(log: Path) -> list[Write]:
    """Everything in a log."""
    lines = (line.split() for line in log.read_text().splitlines())
    return [
        Write(int(ns) / 1e9, int(channel), None if value == "closed" else float(value)) for ns, channel, value in lines
    ]


def at_rest(log: Path, after: float, until: float = inf) -> float | None:
    """When the last actuator had come to neutral, counted from `after`; None where one was not there at `until`."""
    since: list[float | None] = [None] * len(NEUTRALS)
    for write in writes(log):
        if write.value is not None and write.time < until:
            since[write.channel] = (since[write.channel] or write.time) if write.neutral else None
    return None if None in since else max(0.0, max(time or 0.0 for time in since) - after)


@dataclass(slots=True)
class Robot:
    """A controller that drives, and its guardian."""

    process: subprocess.Popen[str]
    log: Path
    guardian: int = 0
    errors: str = field(default="")

    def end(self) -> None:
        """Wait until both processes have ended: they share one end of this pipe."""
        assert self.process.stderr
        self.errors = self.process.stderr.read()
        self.process.wait()

    def say(self, text: str) -> None:
        """A line."""
        assert self.process.stdin
        self.process.stdin.write(f"{text}\n")
        self.process.stdin.flush()

    def ask(self, text: str) -> str:
        """The answer to a line."""
        assert self.process.stdout
        self.say(text)
        return self.process.stdout.readline()


@contextmanager
def robot(folder: Path, manners: str = "fine fine fine") -> Iterator[Robot]:
    """A robot that moves."""
    log = folder / "log"
    log.write_text("")
    process = subprocess.Popen(
        [sys.executable, str(DRIVEN)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "MIND_LOG": str(log), "MIND_MANNERS": manners},
    )
    with process:
        assert process.stdout
        found = Robot(process, log, int(process.stdout.readline()))
        try:
            yield found
        finally:
            process.kill()


def until_it_moves(log: Path, since: float = 0.0) -> None:
    """Wait until an actuator is anywhere else than at neutral."""
    give_up = time.monotonic() + PATIENCE
    while not any(write.time > since and not write.neutral for write in writes(log)):
        assert time.monotonic() < give_up, "it never moved"
        time.sleep(TICK / 2)


def kill(folder: Path, number: signal.Signals, rng: random.Random) -> float | None:
    """Kill a controller at a random moment: after how long all was at neutral, for good."""
    with robot(folder) as found:
        until_it_moves(found.log)
        time.sleep(rng.uniform(0, 0.1))
        begin = time.monotonic()
        found.process.send_signal(number)
        found.end()
    return at_rest(found.log, begin)


def lose(folder: Path, number: signal.Signals, rng: random.Random) -> float | None:
    """Kill or stop a guardian at a random moment: after how long another had brought all to neutral, for good."""
    with robot(folder) as found:
        until_it_moves(found.log)
        time.sleep(rng.uniform(0, 0.1))
        begin = time.monotonic()
        os.kill(found.guardian, number)
        found.end()
    return at_rest(found.log, begin)


def hang(found: Robot, how: str, rng: random.Random) -> float | None:
    """Hang a controller at a random moment: after how long all was at neutral; then it goes on."""
    until_it_moves(found.log, time.monotonic())
    time.sleep(rng.uniform(0, 2 * TICK))
    if how == "stop":
        begin = time.monotonic()
        found.process.send_signal(signal.SIGSTOP)
    else:
        begin = int(found.ask(f"{how} {rng.uniform(0, TICK)}")) / 1e9
    give_up = time.monotonic() + PATIENCE
    while (rest := at_rest(found.log, begin)) is None and time.monotonic() < give_up:
        time.sleep(TICK / 2)
    if how == "stop":
        found.process.send_signal(signal.SIGCONT)
    else:
        found.say("go on")
    return rest


def start(folder: Path, eager: bool) -> list[Write]:
    """Start a guardian, with frames that are there before it is ready where the controller is `eager`; its writes."""
    log = folder / "log"
    log.write_text("")
    environment = {**os.environ, "MIND_LOG": str(log)}
    if eager:
        frames = b"".join(pack(number, time.monotonic_ns() + 10**8 * number, True, (1, 1, 1)) for number in range(9))
        line = f"{to_json(PLAN)}\n".encode()
        subprocess.run(LOGGED, input=line + frames, env=environment, capture_output=True, check=True)
    else:
        with patient(environment), Guardian(PLAN, PATIENCE, LOGGED) as guardian:
            guardian.send((1, 1, 1), armed=True)
    return writes(log)


@contextmanager
def patient(environment: dict[str, str]) -> Iterator[None]:
    """This environment for programs that are started meanwhile."""
    before = dict(os.environ)
    os.environ.update(environment)
    try:
        yield
    finally:
        os.environ.clear()
        os.environ.update(before)
