"""The guardian's first process: it opens no device, and does what is left to do when the one that does has ended.

Then each device is brought to neutral from a process of its own: a driver that ends that takes no other along.
"""

import os
import signal
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from select import select
from time import monotonic, sleep

from mindrun.robot.guardian.messages import OVER, REST, WORKER, say
from mindrun.robot.guardian.plan import Channel, Plan
from mindrun.robot.guardian.process import Process
from mindrun.robot.guardian.realtime import ENDING_SIGNALS, IGNORED_SIGNALS, ignore, wake_on_signals
from mindrun.robot.processes import end_with_parent
from mindrun.terminal.standard_streams import ERROR_DESCRIPTOR, LineWriter

RESCUE_SECONDS = 5.0
MAX_TRIES = 3  # of an actuator: processes that end without a word
RETRY_SECONDS = 0.05  # between two tries to open what could not be
GRACE_SECONDS = 0.3  # in which a process that gives up says why


def watch(plan: Plan, frames: int, status: int, work: Callable[[int], int]) -> int:
    """Let another process `work`, which says its last word into the descriptor that it is given; the exit code.

    However that ends, or is stopped: without the word nothing is known to be at neutral, and all is brought there.
    """
    words, word = os.pipe()
    ignore(*IGNORED_SIGNALS)
    worker = forked(lambda: work(word), signal.SIGTERM)
    os.close(frames)
    os.close(word)
    say(status, WORKER, worker)

    def pass_on(number: int, _frame: object) -> None:
        with suppress(ProcessLookupError):
            os.kill(worker, number)

    for name in ENDING_SIGNALS:
        signal.signal(signal.Signals[name], pass_on)
    os.waitid(os.P_PID, worker, os.WEXITED | os.WSTOPPED | os.WNOWAIT)
    ignore(*ENDING_SIGNALS)
    os.kill(worker, signal.SIGKILL)  # where it was stopped
    code = os.waitstatus_to_exitcode(os.waitpid(worker, 0)[1])
    if _said(words) == [REST]:
        say(status, REST)
    else:
        how = f"by signal {-code}" if code < 0 else f"with exit code {code}"
        if not rescue(plan, status, RESCUE_SECONDS):
            report(f"it was ended {how} before all was at neutral; now all is, each by a process of its own")
    say(status, OVER)
    return abs(code)


def report(line: str) -> None:
    """Say a line on standard error, as far as it is read."""
    errors = LineWriter(ERROR_DESCRIPTOR, "guardian: ")
    errors(line)
    errors.drain(0.2)


def forked(work: Callable[[], int], by: signal.Signals) -> int:
    """Fork a process that does this work and ends, or gets this signal when the present one ends; its number."""
    parent = os.getpid()
    if child := os.fork():
        return child
    code = 1
    try:
        os.setsid()  # a driver may end its whole process group, which the parent is not in
        end_with_parent(parent, by)
        code = work()
    finally:
        os._exit(code)


def _said(words: int) -> list[str]:
    """The words that have come on a pipe since; a forked process may hold its other end, so nobody waits for that."""
    os.set_blocking(words, False)
    with suppress(BlockingIOError):
        return os.read(words, 1 << 16).decode(errors="replace").split()
    return []


@dataclass(frozen=True, slots=True)
class RescueAttempt:
    """A process that brings these actuators to neutral; `number` counts from 1, `handle` is readable when it ends."""

    channels: tuple[Channel, ...]
    number: int
    process: int
    handle: int
    words: int  # the pipe on which it says the name of each that is at neutral

    def end(self) -> None:
        """Kill the process, if it has not ended, and close its descriptors."""
        os.kill(self.process, signal.SIGKILL)
        os.waitpid(self.process, 0)
        os.close(self.handle)
        os.close(self.words)


def rescue(plan: Plan, status: int, seconds: float) -> list[str]:
    """Bring all to neutral, saying which are; the names of those that are not known to be, which are reported.

    What ends its process is tried again, then without the others of its device.
    """
    ignore(*IGNORED_SIGNALS, *ENDING_SIGNALS)  # whoever tells it to end is told that it does, when it is done
    until, at_rest = monotonic() + seconds, set[str]()

    def begun(channels: list[Channel], number: int) -> RescueAttempt:
        some, left = replace(plan, channels=tuple(channels)), max(until - monotonic(), 0.0)
        reading, writing = os.pipe()
        child = forked(lambda: _bring(some, writing, left), signal.SIGKILL)
        os.close(writing)
        return RescueAttempt(some.channels, number, child, os.pidfd_open(child), reading)

    devices: dict[str, list[Channel]] = {}  # one process has to drive all actuators of a device together
    for channel in plan.channels:
        devices.setdefault(channel.driver.device or f"only {channel.actuator}", []).append(channel)
    running = [begun(channels, 1) for channels in devices.values()]
    while running and (left := until + GRACE_SECONDS - monotonic()) > 0:
        ready = select([file for each in running for file in (each.handle, each.words)], [], [], left)[0]
        for attempt in [*running]:
            for name in _said(attempt.words):
                at_rest.add(name)
                say(status, REST, name)
            if attempt.handle in ready:
                attempt.end()
                running.remove(attempt)
                missing = [channel for channel in attempt.channels if channel.actuator not in at_rest]
                if attempt.number < MAX_TRIES and monotonic() < until:
                    running += [begun([channel], attempt.number + 1) for channel in missing]
    for attempt in running:
        attempt.end()
    lost = [channel.actuator for channel in plan.channels if channel.actuator not in at_rest]
    if lost:
        report(f"not known to be at neutral: {', '.join(lost)}; cut the actuators' power")
    return lost


def bring_to_neutral(process: Process, report: Callable[[str], None], seconds: float) -> list[str]:
    """Bring every actuator that opens to neutral, in time, and report what is wrong; the names of those at neutral."""
    until = monotonic() + seconds
    while (wrong := process.open()) and monotonic() < until:  # a bus that is busy is free again
        sleep(RETRY_SECONDS)
    if not process.settle(max(until - monotonic(), RETRY_SECONDS)):
        wrong.append(f"not everything was at neutral after {seconds:g} s")
    for line in wrong:
        report(line)
    return process.at_rest


def _bring(plan: Plan, words: int, seconds: float) -> int:
    errors = LineWriter(ERROR_DESCRIPTOR, "guardian: ")
    process = Process(plan, -1, errors, lambda line: None)
    wake_on_signals(process.wake)
    for name in bring_to_neutral(process, errors, seconds):
        say(words, name)
    process.close()
    errors.drain(0.2)
    return 0
