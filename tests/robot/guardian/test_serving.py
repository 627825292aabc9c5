"""What the guardian waits for, and for how long, and what it says meanwhile; time passes only where it waits."""

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from math import inf
from select import select

import pytest
from mindrun.driver import DeviceError
from mindrun.robot.guardian.messages import pack
from mindrun.robot.guardian.plan import Channel, Plan
from mindrun.robot.guardian.process import Process

from tests.robot.guardian.faked import TICK, Device

CLOSES = b""
NAMES = ("wheel", "claw")


@dataclass
class Port:
    """A driver of a device that cannot be opened the first so many times."""

    name: str
    opened: list[str]
    fails: int = 0
    device: Device = field(default_factory=Device)

    def open(self) -> Device:
        self.opened.append(self.name)
        if self.fails:
            self.fails -= 1
            raise DeviceError("nobody answers", "is it plugged in?") if self.name == "wheel" else OSError
        return self.device


class NoThread:
    """In place of an output's thread: the test itself is that."""

    def __init__(self, **named: object) -> None:
        """Whatever it is called."""

    def start(self) -> None:
        """Nothing."""

    def join(self, seconds: float) -> None:
        """Nothing."""


@dataclass
class Robot:
    """A process, the time, what is to happen when, how long was waited, and what was said."""

    now: float = 100.0
    happens: list[tuple[float, int, bytes]] = field(default_factory=list)
    waits: list[float | None] = field(default_factory=list)
    reports: list[str] = field(default_factory=list)
    states: list[str] = field(default_factory=list)
    opened: list[str] = field(default_factory=list)
    eager: bool = False  # whether the devices take everything as soon as it is waited

    def __post_init__(self) -> None:
        self.reading, self.writing = os.pipe()
        self.ports = [Port("wheel", self.opened), Port("claw", self.opened)]
        channels = tuple(Channel(port.name, 0.5, port) for port in self.ports)
        plan = Plan(TICK, channels)
        self.process = Process(plan, self.reading, self.reports.append, self.states.append, lambda: self.now)

    def select(
        self, reading: list[int], writing: list[int], other: list[int], seconds: float | None
    ) -> tuple[list[int], list[int], list[int]]:
        """Time passes until something happens, or it was waited for long enough."""
        self.waits.append(seconds)
        late = [output for output in self.process._opened if output.late(inf)]
        if self.eager and late:
            for output in late:
                output.attempt()
            if woken := select([self.process._woken], [], [], 0)[0]:
                return woken, [], []
        end = inf if seconds is None else self.now + seconds
        if not self.happens or self.happens[0][0] > end:
            assert end < inf, "it would wait for ever"
            self.now = end
            return [], [], []
        self.now, descriptor, data = self.happens.pop(0)
        if data is CLOSES:
            os.close(descriptor)
        else:
            os.write(descriptor, data)
        return [self.reading if descriptor == self.writing else self.process._woken], [], []

    def comes(self, after: float, number: int, value: float, armed: bool = True) -> None:
        """A frame is to come so long after now."""
        sent = round((self.now + after) * 1e9)
        self.happens.append((self.now + after, self.writing, pack(number, sent, armed, (value, value))))

    def ends(self, after: float) -> None:
        """The frames are to end."""
        self.happens.append((self.now + after, self.writing, CLOSES))

    def write(self) -> None:
        """Each device has one more chance."""
        for output in self.process._opened:
            output.attempt()

    @property
    def last(self) -> list[float]:
        """What each device was told last."""
        return [port.device.written[-1] for port in self.ports]


@pytest.fixture
def closed(monkeypatch: pytest.MonkeyPatch) -> Iterator[Robot]:
    """A robot whose devices are not yet open."""
    monkeypatch.setattr("mindrun.robot.guardian.process.Thread", NoThread)
    robot = Robot()
    monkeypatch.setattr("mindrun.robot.guardian.process.select", robot.select)
    yield robot
    for each in (robot.process._woken, robot.process.wake):
        os.close(each)
    os.close(robot.reading)


@pytest.fixture
def robot(closed: Robot) -> Robot:
    """A robot at neutral."""
    assert closed.process.open() == []
    closed.write()
    assert closed.process.settle()
    os.read(closed.process._woken, 4096)
    return closed


# Opening


def test_what_cannot_be_opened_is_said_and_tried_again(closed: Robot) -> None:
    closed.ports[0].fails, closed.ports[1].fails = 1, 2
    wheel, claw = "wheel cannot be opened: nobody answers is it plugged in?", "claw cannot be opened: OSError"
    assert closed.process.open() == [wheel, claw]
    assert closed.process.open() == [claw]
    assert closed.process.open() == []
    assert closed.process.open() == []
    assert closed.opened == ["wheel", "claw", "wheel", "claw", "claw"]


def test_each_is_told_neutral_again_when_all_are_open(closed: Robot) -> None:
    closed.ports[1].fails = 1
    closed.process.open()
    closed.write()
    assert closed.process.settle(0.0)
    assert closed.process.open() == []
    assert not closed.process.settle(0.0)
    closed.write()
    assert [port.device.written for port in closed.ports] == [[0.5, 0.5], [0.5]]


# Waiting for neutral


def test_it_waits_for_neutral_no_longer_than_it_may_and_says_who_keeps_it(closed: Robot) -> None:
    closed.process.open()
    assert not closed.process.settle(2.5)
    assert closed.waits == [1.0, 1.0, 0.5]
    said = "{} is not at neutral after {} s: it does not answer"
    assert closed.reports == [said.format(name, late) for late in (1, 2) for name in ("wheel", "claw")]
    closed.ports[0].device.fails = True
    closed.write()
    assert not closed.process.settle(0.5)
    assert closed.reports[4:] == ["wheel is not at neutral after 3 s: no answer"]
    closed.ports[0].device.fails = False
    closed.write()
    assert closed.process.settle(0.0)


@dataclass
class Tired(Device):
    """Refuses the first fifty writes."""

    tries: int = 0

    def write(self, value: float) -> None:
        self.tries += 1
        if self.tries <= 50:
            raise DeviceError("it is tired")
        self.written.append(value)


def test_it_waits_for_neutral_as_long_as_it_takes(closed: Robot) -> None:
    closed.ports[0].device, closed.eager = Tired(), True
    closed.process.open()
    assert closed.process.settle()
    assert (closed.now, len(closed.waits)) == (149.0, 51)
    assert closed.reports == [f"wheel is not at neutral after {late} s: it is tired" for late in range(1, 50)]


def test_it_sees_at_once_that_all_is_at_neutral(closed: Robot) -> None:
    closed.process.open()
    closed.eager = True
    assert closed.process.settle()
    assert (closed.now, closed.waits, closed.reports) == (100.0, [1.0], [])


# Following


def test_while_it_follows_it_waits_for_two_ticks_and_when_all_is_at_neutral_for_ever(robot: Robot) -> None:
    robot.eager = True
    robot.comes(10.0, 0, 0.75)
    robot.comes(10.0 + TICK, 1, 1.0)
    robot.ends(20.0)
    robot.process.serve()
    two = pytest.approx(2 * TICK)
    assert robot.waits == [None, two, two, 1.0, None]
    assert [port.device.written[1:] for port in robot.ports] == [[0.75, 1.0, 0.5]] * 2
    assert robot.states == ["following ", "neutral no frame for two ticks"]
    assert robot.reports == ["all actuators to neutral: no frame for two ticks"]


def test_what_is_not_armed_is_no_news(robot: Robot) -> None:
    robot.eager = True
    robot.comes(0.0, 0, 0.75)
    robot.comes(TICK, 1, 0.75, armed=False)
    robot.ends(50.0)
    robot.process.serve()
    assert [port.device.written[1:] for port in robot.ports] == [[0.75, 0.5]] * 2
    assert (robot.states, robot.reports) == (["following ", "neutral not armed"], [])


def test_until_all_is_at_neutral_it_looks_once_a_second(robot: Robot) -> None:
    robot.comes(0.0, 0, 0.75)
    robot.comes(TICK, 1, 0.75, armed=False)
    robot.ends(3.5)
    robot.process.serve()
    assert robot.waits[2:] == [1.0] * 4
    lost = [f"all actuators to neutral, but {name} may still move: {name} failed: it does not answer" for name in NAMES]
    assert robot.reports[-2:] == lost


@pytest.mark.parametrize("number", [1, 3, 15])
def test_a_signal_ends_it_and_an_actuator_at_neutral_does_not(robot: Robot, number: int) -> None:
    woken = ((101.0, b"\0"), (102.0, b"\0\0"), (103.0, bytes([0, number])), (104.0, b"\0"))
    robot.happens = [(at, robot.process.wake, data) for at, data in woken]
    robot.process.serve()
    assert robot.now == 103.0
    assert robot.states == []


def test_frames_after_the_end_change_nothing(robot: Robot) -> None:
    robot.ends(1.0)
    robot.comes(2.0, 0, 0.75)
    robot.process.serve()
    assert robot.now == 101.0
    assert len(robot.happens) == 1


def test_a_controller_that_ends_while_something_moves_has_said_no_word(robot: Robot) -> None:
    robot.comes(0.0, 0, 0.75)
    robot.ends(TICK)
    robot.process.serve()
    assert robot.reports == ["the controller has ended without a word"]


def test_it_is_woken_though_its_pipe_is_full(robot: Robot) -> None:
    for _ in range(1 << 17):
        robot.process._nudge()
    assert os.read(robot.process._woken, 1 << 20).strip(b"\0") == b""


def test_a_latched_one_hears_nothing_more(robot: Robot) -> None:
    robot.comes(0.0, 0, 0.75)
    robot.happens.append((robot.now, robot.writing, b"x" * 99))
    robot.comes(TICK, 1, 0.75)
    robot.happens.append((robot.now, robot.writing, b"y" * 99))
    robot.ends(1.0)
    robot.process.serve()
    said = "a frame that is no frame"
    assert robot.states == ["following ", f"latched {said}"]
    assert robot.reports == [f"all actuators to neutral: {said}"]
    robot.write()
    assert robot.last == [0.5, 0.5]


# Who does not answer


@pytest.mark.parametrize(("error", "said"), [(True, "no answer"), (False, "it does not answer")])
def test_who_does_not_follow_for_two_ticks_brings_all_to_neutral(robot: Robot, error: bool, said: str) -> None:
    step = step_of(robot)
    step(0, 0.75)
    robot.ports[1].device.fails = error
    robot.process.outputs[0].attempt()
    if error:
        robot.process.outputs[1].attempt()
    robot.now += 2 * TICK
    step(1, 0.75)
    assert robot.process.guard.state == "following", "two ticks are not more than two ticks"
    robot.now += TICK / 128
    step(2, 0.75)
    assert robot.states[1:] == [f"neutral claw failed: {said}"]


@dataclass
class Hanging(Device):
    """A device that hangs in each write for so many seconds, in which the guardian goes on."""

    robot: Robot | None = None
    seconds: float = 0.0

    def write(self, value: float) -> None:
        if self.robot:
            self.robot.now += self.seconds
            self.robot.process.step(None)
        self.written.append(value)


@pytest.mark.parametrize(("seconds", "latches"), [(1.0, False), (1.0 + 1 / 128, True)])
def test_who_hangs_for_a_second_where_all_is_to_be_at_neutral_latches_all(
    robot: Robot, seconds: float, latches: bool
) -> None:
    step = step_of(robot)
    step(0, 0.75)
    step(1, 0.75, armed=False)
    robot.process.outputs[0].attempt()
    robot.process.outputs[1]._device = Hanging(robot=robot, seconds=seconds)
    robot.process.outputs[1].attempt()
    last = "latched claw does not come to neutral" if latches else "neutral claw failed"
    assert robot.states[-1] == f"{last}: it does not answer"


def step_of(robot: Robot) -> Callable[..., None]:
    """What makes the process take a frame that is sent now."""

    def step(number: int, value: float, armed: bool = True) -> None:
        robot.process.step(pack(number, round(robot.now * 1e9), armed, (value, value)))

    return step
