"""A device that is slow while orders come from another thread: what was ordered last is what it has in the end."""

import random
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from math import inf
from time import monotonic, sleep

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.driver import DeviceError
from mindrun.robot.drivers.mock import MockActuator
from mindrun.robot.guardian.guard import FOLLOWING
from mindrun.robot.guardian.messages import pack
from mindrun.robot.guardian.plan import Channel
from mindrun.robot.guardian.process import ActuatorOutput

from tests.draws import cases
from tests.robot.guardian.faked import TICK, Faked, faked

PATIENCE = 300.0  # seconds for a thread to do what it has to
REST = 0.5


@dataclass
class Gate:
    """A device whose write ends when it is let; then it `fails` or has the value."""

    written: list[float] = field(default_factory=list)
    fails: bool = False
    writing: threading.Semaphore = field(default_factory=lambda: threading.Semaphore(0))
    free: threading.Semaphore = field(default_factory=lambda: threading.Semaphore(0))

    def write(self, value: float) -> None:
        self.writing.release()
        assert self.free.acquire(timeout=PATIENCE)
        if self.fails:
            raise DeviceError("no answer")
        self.written.append(value)

    def close(self) -> None:
        """Nothing."""

    def let(self, writes: int = 1) -> None:
        """Let it end so many writes."""
        for _ in range(writes):
            assert self.writing.acquire(timeout=PATIENCE)
            self.free.release()


@contextmanager
def started(device: object) -> Iterator[ActuatorOutput]:
    output = ActuatorOutput("wheel", REST, lambda: None, lambda: device, inf)  # type: ignore[arg-type, return-value]
    output.start(device)  # type: ignore[arg-type]
    try:
        yield output
    finally:
        output.close(0.0)
        for _ in range(100):
            getattr(device, "free", threading.Semaphore()).release()


def until_settled(output: ActuatorOutput) -> None:
    end = monotonic() + PATIENCE
    while not output.settled:
        assert monotonic() < end
        sleep(0.001)


@pytest.mark.parametrize("fails", [False, True])
def test_a_neutral_that_is_ordered_during_a_write_is_written(fails: bool) -> None:
    device = Gate()
    with started(device) as output:
        device.let()
        until_settled(output)
        output.move(1.0)
        assert device.writing.acquire(timeout=PATIENCE)
        device.fails = fails
        output.rest()
        assert not output.settled
        device.free.release()
        assert device.writing.acquire(timeout=PATIENCE), "nobody writes the neutral"
        assert not output.settled, "neutral is not acknowledged yet"
        device.fails = False
        device.free.release()
        until_settled(output)
        assert device.written[-1] == REST


def test_of_all_that_is_ordered_during_a_write_the_last_is_written() -> None:
    device = Gate()
    with started(device) as output:
        device.let()
        until_settled(output)
        output.move(0.1)
        assert device.writing.acquire(timeout=PATIENCE)
        for value in (0.2, 0.3, 0.4):
            output.move(value)
        device.free.release()
        device.let()
        output.rest()
        device.let()
        until_settled(output)
        assert device.written == [REST, 0.1, 0.4, REST]


class Whimsical:
    """A device that takes its time, and now and then refuses, as its generator says."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.value = -1.0

    def write(self, value: float) -> None:
        sleep(self.random.choice((0.0, 0.0, 0.0005, 0.002)))
        if self.random.random() < 0.3:
            raise DeviceError("no answer")
        self.value = value

    def close(self) -> None:
        """Nothing."""


@settings(max_examples=cases(25), deadline=None)
@given(st.integers(0, 2**32), st.lists(st.one_of(st.none(), st.floats(0, 1)), max_size=60))
def test_whatever_is_ordered_whenever_settled_is_at_neutral(seed: int, orders: list[float | None]) -> None:
    device, pauses = Whimsical(seed), random.Random(seed)
    with started(device) as output:
        for order in orders:
            if order is None:
                output.rest()
            else:
                output.move(order)
            sleep(pauses.choice((0.0, 0.0, 0.001)))
        output.rest()
        until_settled(output)
        assert device.value == REST


class Noted(threading.Condition):
    """Notes for how long it is to wait, and does not; at the time that `then` has, that is done."""

    def __init__(self, then: dict[int, Callable[[], None]]) -> None:
        super().__init__()
        self.waits: list[float | None] = []
        self.then = then

    def wait(self, timeout: float | None = None) -> bool:
        self.waits.append(timeout)
        self.then.get(len(self.waits), lambda: None)()
        return True


class Stubborn:
    """A device that refuses all it is told until it gives in; what asks it a hundred times is to end."""

    def __init__(self, output: ActuatorOutput) -> None:
        self.written: list[float] = []
        self.refuses = True
        self.output = output

    def write(self, value: float) -> None:
        self.written.append(value)
        self.output._closing |= len(self.written) == 100
        if self.refuses:
            raise DeviceError("not now")

    def close(self) -> None:
        self.written.append(-1.0)


def test_what_fails_is_tried_again_soon_and_then_every_50_ms_and_what_is_new_at_once() -> None:
    output = ActuatorOutput("wheel", REST, lambda: None, lambda: device, inf)
    output._device = device = Stubborn(output)

    def give_in() -> None:
        device.refuses = False

    def end() -> None:
        output._closing = True

    output._change = Noted({7: lambda: output.move(0.75), 9: give_in, 10: end})
    output._run()
    slower = [0.002, 0.004, 0.008, 0.016, 0.032, 0.05, 0.05]
    assert output._change.waits == [*slower, 0.002, 0.004, None]
    assert device.written == [REST] * 7 + [0.75] * 3 + [-1.0]


# How late one is


@dataclass
class Slow:
    """A device of which each write takes so many tenths of a tick, in which time passes and frames come."""

    robot: Faked
    tenths: int
    passed: int = 0
    states: list[str] = field(default_factory=list)

    def write(self, value: float) -> None:
        for _ in range(self.tenths):
            self.robot.now[0] += TICK / 10
            self.passed += 1
            data = pack(self.passed, round(self.robot.now[0] * 1e9), True, (0.75,)) if self.passed % 10 == 0 else None
            self.robot.process.step(data)
            self.states.append(self.robot.state)

    def close(self) -> None:
        """Nothing."""


@pytest.mark.parametrize(("tenths", "answers"), [(10, True), (12, True), (19, True), (21, False), (70, False)])
def test_a_device_that_acknowledges_within_two_ticks_is_slow_and_not_dead(tenths: int, answers: bool) -> None:
    """A command comes each tick: most are replaced before they are tried, and none of these is waited for."""
    with faked(Channel("wheel", REST, MockActuator())) as robot:
        (output,) = robot.process.outputs
        output._device = device = Slow(robot, tenths)
        robot.process.step(pack(0, round(robot.now[0] * 1e9), True, (0.9,)))
        for _ in range(50):
            output.attempt()
        assert (set(device.states) == {FOLLOWING}) == answers
        assert (robot.process.guard.failures == 0) == answers
