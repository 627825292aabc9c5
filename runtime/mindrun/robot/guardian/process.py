"""The guardian at work: devices opened and at neutral, then frames followed until they end.

Each actuator is written in a thread of its own, so that a device that hangs keeps no other from its neutral.
"""

import os
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from math import ceil, inf
from select import select
from threading import Condition, Thread
from time import monotonic

from mindrun.driver import ActuatorDevice, discard, failure
from mindrun.errors import text_of
from mindrun.robot.guardian.guard import FAILED, FOLLOWING, LATCHED, MOVES_ON, NEUTRAL, NOT_ARMED, REST, Guard, Order
from mindrun.robot.guardian.messages import FrameError, Reader
from mindrun.robot.guardian.plan import Channel, Plan
from mindrun.robot.processes import end_in_child

REPORT_SECONDS = 1.0  # between two reports on an actuator that is not at neutral
CLOSE_SECONDS = 0.5  # that a device may take to close
SILENT = "it does not answer"  # of an actuator that raises no error
MIN_RETRY_SECONDS, MAX_RETRY_SECONDS = 0.002, 0.05  # seconds between two tries: at first, and in the end
BOOT_SECONDS = 5.0  # for a device that was opened anew to acknowledge its first command
Say = Callable[[str], None]
Clock = Callable[[], float]


@dataclass(frozen=True, slots=True)
class Wanted:
    """A value that a device should have; a newer one replaces it, whether or not it was written."""

    value: float
    neutral: bool


class ActuatorOutput:
    """Writes what is wanted until the device acknowledges it; at the beginning that is neutral.

    A device that has worked, refuses neutral, and has acknowledged nothing for longer than `patience` is lost: it is
    closed, and `opened` anew as often as it takes.
    """

    def __init__(
        self, name: str, rest: float, settled: Callable[[], None], opened: Callable[[], ActuatorDevice],
        patience: float, clock: Clock = monotonic,
    ) -> None:  # fmt: skip
        self.name = name
        self.error = ""
        self._neutral = rest
        self._settled = settled
        self._opened = opened
        self._patience = patience
        self._clock = clock
        self._wanted = Wanted(rest, True)
        self._waiting: float | None = clock()  # since when nothing has been acknowledged that should have been
        self._closing = False
        self._process = os.getpid()
        self._change = Condition()
        self._thread = Thread(target=self._run, name=name, daemon=True)
        self._device: ActuatorDevice | None = None
        self._is_new_until = inf
        self._refuses_neutral = False
        self._writing_since: float | None = None

    def start(self, device: ActuatorDevice) -> None:
        self._device = device
        self._thread.start()

    def move(self, value: float, neutral: bool = False) -> None:
        """Order a value; returns at once."""
        with self._change:
            self._wanted = Wanted(value, neutral)
            if self._waiting is None:
                self._waiting = self._clock()
            self._change.notify()

    def rest(self) -> None:
        """Order neutral; returns at once."""
        self.move(self._neutral, True)

    @property
    def settled(self) -> bool:
        """True if neutral was the last that was wanted, and is acknowledged."""
        with self._change:
            return self._wanted.neutral and self._waiting is None

    def late(self, now: float) -> float:
        """The seconds for which a device, though something was wanted, has acknowledged nothing; a slow one does."""
        with self._change:
            return 0.0 if self._waiting is None else now - self._waiting

    def hangs(self, now: float) -> float:
        """The seconds for which the write under way has not returned, be it with an error; 0 where there is none."""
        since = self._writing_since
        return 0.0 if since is None else now - since

    def close(self, seconds: float) -> None:
        """Close the device; give up where that takes longer than allowed."""
        with self._change:
            self._closing = True
            self._change.notify()
        self._thread.join(seconds)

    def attempt(self) -> Wanted | None:
        """Write what is wanted, once: what has been tried without success, or None when there is nothing left to do."""
        wanted = self._wanted
        try:
            device = self._working_device()
            wanted = self._wanted  # of a device that was opened anew neutral: whoever opens it orders that
            self._writing_since = self._clock()
            device.write(wanted.value)
            end_in_child(self._process)
        except BaseException as error:  # whatever a driver raises, this thread goes on
            end_in_child(self._process)
            self.error, self._refuses_neutral = failure(error), wanted.neutral
            return wanted
        finally:
            self._writing_since = None
        with self._change:
            self.error, self._refuses_neutral, self._is_new_until = "", False, -inf
            if self._wanted is not wanted:
                self._waiting = self._clock()
                return wanted
            self._waiting = None
        if wanted.neutral:
            self._settled()
        return None

    def _working_device(self) -> ActuatorDevice:
        """The device, opened anew where it is lost; raises whatever its driver does."""
        now = self._clock()
        if self._refuses_neutral and self.late(now) > self._patience and now > self._is_new_until:
            self._close()
        if self._device is None:
            self._device = self._opened()
            self._is_new_until = self._clock() + BOOT_SECONDS
        return self._device

    def _close(self) -> None:
        device, self._device = self._device, None
        discard(device)
        end_in_child(self._process)

    def _run(self) -> None:
        pause = MIN_RETRY_SECONDS
        while not self._closing:
            tried = self.attempt()
            with self._change:
                if tried is self._wanted:
                    self._change.wait(pause)
                elif tried is None and self._waiting is None and not self._closing:
                    self._change.wait()
                pause = min(2 * pause, MAX_RETRY_SECONDS) if tried is self._wanted else MIN_RETRY_SECONDS
        self._close()


class Process:
    """All outputs, the guard that decides about them, and the two pipes that wake them."""

    def __init__(self, plan: Plan, frames: int, report: Say, status: Say, clock: Clock = monotonic) -> None:
        self._clock = clock
        self._plan = plan
        self._frames = frames
        self._report = report
        self._status = status
        self._woken, self.wake = os.pipe()  # by a signal's number, or 0 of an output that is at neutral
        for descriptor in (self._woken, self.wake):
            os.set_blocking(descriptor, False)
        self.guard = Guard(plan)
        self._reader = Reader(len(plan.channels))
        rests = zip(plan.channels, self.guard.rest, strict=True)
        self.outputs = [
            ActuatorOutput(each.actuator, rest, self._nudge, partial(self._opened_anew, each), self.guard.limit, clock)
            for each, rest in rests
        ]
        self._opened: list[ActuatorOutput] = []
        self._lost: set[str] = set()  # the names of actuators of which this was said
        self._ending = False
        self._process = os.getpid()
        self._told = 0.0

    def open(self) -> list[str]:
        """Open every device, each at neutral before the next, and say which cannot be opened, and why.

        Called again, it tries those anew that could not.
        """
        wrong = []
        for channel, output in zip(self._plan.channels, self.outputs, strict=True):
            if output in self._opened:
                continue
            try:
                device = channel.driver.open()
                end_in_child(self._process)
                output.start(device)
            except BaseException as error:  # a driver may raise SystemExit: no other stays closed for that
                end_in_child(self._process)
                hint = getattr(error, "hint", "")
                wrong.append(f"{output.name} cannot be opened: {text_of(error)} {hint}".strip())
            else:
                self._opened.append(output)
        self.rest()  # once more: to open one can reset another that is on the same chip
        return wrong

    def rest(self) -> None:
        """Send neutral to every actuator."""
        for output in self._opened:
            output.rest()

    def settle(self, seconds: float = inf) -> bool:
        """Wait until every actuator has acknowledged neutral; False where that takes more than so many seconds.

        Says once a second which has not.
        """
        until = self._clock() + seconds
        while not self._settled():
            left = until - self._clock()
            if left <= 0:
                return False
            self._wait([], min(left, REPORT_SECONDS))
            now = self._clock()
            if self.guard.state == FOLLOWING or now - self._told < REPORT_SECONDS:
                continue
            for output in self._opened:
                if output.late(now) >= REPORT_SECONDS:
                    self._told = now
                    late = ceil(output.late(now))
                    self._report(f"{output.name} is not at neutral after {late} s: {output.error or SILENT}")
        return True

    def serve(self) -> None:
        """Do what the frames say, until they end or a signal comes."""
        while not self._ending:
            data, patience = None, None if self._settled() else REPORT_SECONDS
            if self.guard.state == FOLLOWING:
                patience = max(self.guard.deadline - self._clock(), 0.0)
            if self._frames in self._wait([self._frames], patience):
                data = os.read(self._frames, 1 << 16)
                if not data:
                    if self.guard.state == FOLLOWING:
                        self._report("the controller has ended without a word")
                    return
            self.step(data)

    def step(self, data: bytes | None) -> None:
        """Do what follows from this data, from the time, and from what the devices have done."""
        before = self.guard.state, self.guard.why
        if data:
            self._obey(self._take(data))
        self._obey(self.guard.passed(self._clock()))
        for output in self._opened:
            self._attend(output, self._clock())
        if (self.guard.state, self.guard.why) != before:
            self._status(f"{self.guard.state} {self.guard.why}")

    def close(self) -> None:
        """Let go of every device that can."""
        for output in self._opened:
            output.close(CLOSE_SECONDS)

    def _take(self, data: bytes) -> Order:
        if self.guard.state == LATCHED:
            return None
        try:
            frames = self._reader.feed(data)
        except FrameError as error:
            return self.guard.broken(str(error))
        # Of several that waited only the newest counts.
        return self.guard.frame(frames[-1], self._clock(), self._settled()) if frames else None

    def _attend(self, output: ActuatorOutput, now: float) -> None:
        """Stop everything where an actuator answers no more, and latch where it hangs; say that it is lost, or back."""
        is_lost = output.late(now) > self.guard.limit
        if is_lost and (self.guard.state == FOLLOWING or output.name not in self._lost):
            self._lost.add(output.name)
            said = f"{output.name} {FAILED}: {output.error or SILENT}"
            if self.guard.failed(output.name, output.error or SILENT) == REST:
                self.rest()
                said = self.guard.why
            self._report(f"all actuators to neutral, but {output.name} may still move: {said}")
        elif not is_lost and output.name in self._lost:
            self._lost.remove(output.name)
            self._report(f"{output.name} is fine again")
        if self.guard.state == NEUTRAL and output.hangs(now) > REPORT_SECONDS:
            self._obey(self.guard.broken(f"{output.name} {MOVES_ON}: {SILENT}"))

    def _opened_anew(self, channel: Channel) -> ActuatorDevice:
        """The device of an actuator that has failed; called in the thread of its output, before it is at neutral."""
        device = channel.driver.open()
        end_in_child(self._process)
        self.rest()  # nothing is to move; to open one can reset another that is on the same chip
        return device

    def _obey(self, order: Order) -> None:
        if order == REST:
            self.rest()
            if self.guard.why != NOT_ARMED:  # the controller has said why
                self._report(f"all actuators to neutral: {self.guard.why}")
        elif order:
            for output, value in zip(self.outputs, order, strict=True):
                output.move(value)

    @property
    def at_rest(self) -> list[str]:
        """The names of the actuators that have acknowledged neutral."""
        return [output.name for output in self._opened if output.settled]

    def _settled(self) -> bool:
        return all(output.settled for output in self._opened)

    def _wait(self, descriptors: list[int], seconds: float | None) -> list[int]:
        ready = select([self._woken, *descriptors], [], [], seconds)[0]
        if self._woken in ready and any(os.read(self._woken, 4096)):
            self._ending = True
        return ready

    def _nudge(self) -> None:
        with suppress(OSError):  # full: then it wakes as well; or a driver has closed it, which is noticed elsewhere
            os.write(self.wake, b"\0")
