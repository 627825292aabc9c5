"""The decisions of the guardian, by its state, the time and what came: no device, no clock, so that a test can be both.

neutral    nothing moves; an armed frame starts it, once every actuator has acknowledged its neutral
following  each frame moves the actuators; two ticks without one, or an actuator that fails, and all are neutral
latched    neutral until the guardian is started anew: whoever sends such frames is broken
"""

from collections.abc import Sequence
from math import inf

from mindrun.robot.guardian.messages import Frame
from mindrun.robot.guardian.plan import Channel, Plan

NEUTRAL, FOLLOWING, LATCHED = "neutral", "following", "latched"
STARTED, NOT_ARMED = "started", "not armed"  # why it is at neutral where the controller wants just that
NOT_YET = "not every actuator has come to neutral"  # why it still is where the controller wants to move
FAILED = "failed"  # behind the name of an actuator, because of which it is
MOVES_ON = "does not come to neutral"  # an actuator: a reason to latch, of which not everything is at neutral
SILENT_TICKS = 2  # after which the controller hangs, or an actuator does not answer
MAX_FAILURES = 3  # of actuators: the third latches


Order = tuple[float, ...] | None  # values for the devices, or none of them: every device to neutral
REST: Order = ()


def failing(why: str, actuators: Sequence[str]) -> int | None:
    """The number of the actuator because of which all are at neutral; None where it is not because of one."""
    return next((number for number, name in enumerate(actuators) if why.startswith(f"{name} {FAILED}")), None)


class Guard:
    """The state machine of the guardian: each method returns what the caller must do with the devices now."""

    def __init__(self, plan: Plan) -> None:
        self._plan = plan
        self._rest = tuple(each.rest for each in plan.channels)
        self._values, self._then = self._rest, -inf
        self.limit = SILENT_TICKS * plan.tick
        self.state, self.why = NEUTRAL, STARTED
        self.deadline = inf
        self.silences = self.failures = 0

    @property
    def rest(self) -> tuple[float, ...]:
        """The values that the devices are sent at neutral."""
        return tuple(map(turned, self._plan.channels, self._rest))

    def frame(self, frame: Frame, now: float, settled: bool) -> Order:
        """A good frame came; `settled` says whether every actuator has acknowledged its neutral.

        Its age counts from when it was sent: a frame that waited while this process hung is no sign of life.
        """
        if self.state == LATCHED or now >= frame.sent + self.limit:
            return None
        if frame.sent > now + self._plan.tick:
            return self.broken("a frame from the future")
        if not frame.armed:
            if self.state == FOLLOWING:
                return self._neutral(NOT_ARMED)
            self.why = NOT_ARMED if settled else self.why
            return None
        if self.state == NEUTRAL:
            if not settled:
                self.why = NOT_YET if self.why in (STARTED, NOT_ARMED) else self.why
                return None
            self.state, self.why = FOLLOWING, ""
        self.deadline = frame.sent + self.limit
        seconds = min(now - self._then, self._plan.tick)  # after a rest the first step is as small as any other
        wanted = zip(self._plan.channels, frame.commands, self._values, strict=True)
        self._values = tuple(moved(channel, command, before, seconds) for channel, command, before in wanted)
        self._then = now
        return tuple(map(turned, self._plan.channels, self._values))

    def passed(self, now: float) -> Order:
        """Time has passed without a frame; `now` is the monotonic clock in seconds."""
        if self.state != FOLLOWING or now < self.deadline:
            return None
        self.silences += 1
        return self._neutral("no frame for two ticks")

    def failed(self, actuator: str, why: str) -> Order:
        """An actuator has acknowledged no command for two ticks; at neutral that is why all stay there."""
        if self.state == LATCHED:
            return None
        said = f"{actuator} {FAILED}: {why}"
        if self.state == NEUTRAL:
            self.why = said
            return None
        self.failures += 1
        if self.failures >= MAX_FAILURES:
            return self.broken(f"{actuator} {FAILED}, as did {MAX_FAILURES - 1} before: {why}")
        return self._neutral(said)

    def broken(self, why: str) -> Order:
        """Something came that no working controller sends."""
        if self.state == LATCHED:
            return None
        order = self._neutral(why)
        self.state = LATCHED
        return order

    def _neutral(self, why: str) -> Order:
        self.state, self.why, self.deadline = NEUTRAL, why, inf
        self._values, self._then = self._rest, -inf
        return REST


def moved(channel: Channel, command: float, before: float, seconds: float) -> float:
    """A command as it moves, within the limits, no further from the value before than the slew allows."""
    value = min(max(started(channel, command), channel.low), channel.high)
    if channel.slew > 0:
        step = channel.slew * seconds
        value = min(max(value, before - step), before + step)
    return min(max(value, 0.0), 1.0)


def started(channel: Channel, command: float) -> float:
    """A command from neutral with the trim to the same ends, of which it makes the least share at once."""
    if channel.trim == 0 and channel.least == 0:
        return command
    rest, end = channel.rest, float(command > channel.neutral)
    if command == channel.neutral or end == channel.neutral:
        return rest
    share = (command - channel.neutral) / (end - channel.neutral)
    return rest + (end - rest) * (channel.least + (1.0 - channel.least) * share)


def meant(channel: Channel, value: float) -> float:
    """The command that is `started` as this value: neutral for what is less than the least share away from it."""
    if channel.trim == 0 and channel.least == 0:
        return value
    rest = channel.rest
    if value == rest:
        return channel.neutral
    end, spare = float(value > rest), 1.0 - channel.least
    share = max(0.0, (value - rest) / (end - rest) - channel.least) / spare if spare else 1.0
    return channel.neutral + (end - channel.neutral) * share


def turned(channel: Channel, value: float) -> float:
    """A value as the device counts: a reversed gripper's neutral must open it, too."""
    return 1.0 - value if channel.reversed else value
