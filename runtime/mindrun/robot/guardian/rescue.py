"""Bring actuators to neutral, each device from a process of its own: a driver that ends that takes no other along."""

import os
import signal
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass, replace
from select import select
from time import monotonic, sleep

from mindrun.robot.guardian.plan import Channel, Plan
from mindrun.robot.guardian.process import Process
from mindrun.robot.guardian.realtime import wake_on_signals
from mindrun.robot.guardian.status import say
from mindrun.robot.parent_process import end_with_parent
from mindrun.terminal.line_writer import LineWriter

MAX_TRIES = 3  # of an actuator: processes that end without a word
RETRY_SECONDS = 0.05  # between two tries to open what could not be
GRACE_SECONDS = 0.3  # in which a process that gives up says why
ERROR_DESCRIPTOR = 2


@dataclass(frozen=True, slots=True)
class Attempt:
    """A process that brings these actuators to neutral; `number` counts from 1, `handle` is readable when it ends."""

    channels: tuple[Channel, ...]
    number: int
    process: int
    handle: int
    words: int  # the pipe on which it says the name of each that is at neutral

    def at_rest(self) -> list[str]:
        """The names that it has said since."""
        with suppress(BlockingIOError):
            return os.read(self.words, 1 << 16).decode().split()
        return []

    def end(self) -> None:
        """End it, if it has not ended, and let go of it."""
        os.kill(self.process, signal.SIGKILL)
        os.waitpid(self.process, 0)
        os.close(self.handle)
        os.close(self.words)


def rescue(plan: Plan, told: Callable[[str], None], seconds: float) -> set[str]:
    """Bring all actuators to neutral; the names of those that have acknowledged it, each `told` at once.

    What ends its process is tried again, then without the others of its device.
    """
    until, at_rest = monotonic() + seconds, set[str]()

    def begun(channels: Iterable[Channel], number: int) -> Attempt:
        return _begun(replace(plan, channels=tuple(channels)), number, max(until - monotonic(), 0.0))

    running = [begun(channels, 1) for channels in of_devices(plan)]
    while running and (left := until + GRACE_SECONDS - monotonic()) > 0:
        ready = select([file for each in running for file in (each.handle, each.words)], [], [], left)[0]
        for attempt in [*running]:
            for name in attempt.at_rest():
                at_rest.add(name)
                told(name)
            if attempt.handle in ready:
                attempt.end()
                running.remove(attempt)
                missing = [channel for channel in attempt.channels if channel.actuator not in at_rest]
                if attempt.number < MAX_TRIES and monotonic() < until:
                    running += [begun([channel], attempt.number + 1) for channel in missing]
    for attempt in running:
        attempt.end()
    return at_rest


def of_devices(plan: Plan) -> list[list[Channel]]:
    """The actuators that one process has to drive together, since they are of one device."""
    found: dict[str, list[Channel]] = {}
    for channel in plan.channels:
        found.setdefault(channel.driver.device or f"only {channel.actuator}", []).append(channel)
    return [*found.values()]


def bring(process: Process, report: Callable[[str], None], seconds: float) -> list[str]:
    """Bring all that can be opened to neutral, in time; the names of those that are, and what is wrong reported."""
    until = monotonic() + seconds
    while (wrong := process.open()) and monotonic() < until:  # a bus that is busy is free again
        sleep(RETRY_SECONDS)
    if not process.settle(max(until - monotonic(), RETRY_SECONDS)):
        wrong.append(f"not everything was at neutral after {seconds:g} s")
    for line in wrong:
        report(line)
    return process.at_rest


def _begun(plan: Plan, number: int, seconds: float) -> Attempt:
    reading, writing = os.pipe()
    parent = os.getpid()
    child = os.fork()
    if not child:
        try:
            os.setsid()  # a driver may end its whole process group
            end_with_parent(parent, signal.SIGKILL)
            _bring(plan, writing, seconds)
        finally:
            os._exit(0)
    os.close(writing)
    os.set_blocking(reading, False)
    return Attempt(plan.channels, number, child, os.pidfd_open(child), reading)


def _bring(plan: Plan, words: int, seconds: float) -> None:
    report = LineWriter(ERROR_DESCRIPTOR, "guardian: ")
    process = Process(plan, -1, report)
    wake_on_signals(process.wake)
    for name in bring(process, report, seconds):
        say(words, name)
    process.close()
    report.drain(0.2)
