"""The guardian at work: devices opened and at neutral, then frames followed until they end."""

import os
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from math import ceil
from select import select
from time import monotonic

from mindrun.driver import ActuatorDevice
from mindrun.errors import text_of
from mindrun.robot.guardian.guard import (
    FAILED,
    FOLLOWING,
    LATCHED,
    MOVES_ON,
    NEUTRAL,
    NOT_ARMED,
    Guard,
    Move,
    Order,
    Rest,
)
from mindrun.robot.guardian.messages import FrameError, Reader
from mindrun.robot.guardian.output import ActuatorOutput
from mindrun.robot.guardian.plan import Channel, Plan
from mindrun.robot.processes import end_in_child

REPORT_SECONDS = 1.0  # between two reports on an actuator that is not at neutral
CLOSE_SECONDS = 0.5  # that a device may take to close
SILENT = "it does not answer"  # of an actuator that raises no error
Say = Callable[[str], None]
Clock = Callable[[], float]


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

    def settle(self, seconds: float = float("inf")) -> bool:
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
            if self.guard.failed(output.name, output.error or SILENT):
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
        match order:
            case Move(values):
                for output, value in zip(self.outputs, values, strict=True):
                    output.move(value)
            case Rest():
                self.rest()
                if self.guard.why != NOT_ARMED:  # the controller has said why
                    self._report(f"all actuators to neutral: {self.guard.why}")

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
