"""Every transition of the guardian's states, on a clock that only the test moves."""

from collections.abc import Iterator
from itertools import groupby
from math import nan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.robot.drivers.mock import MockActuator
from mindrun.robot.guardian.guard import FOLLOWING, LATCHED, MAX_FAILURES, NEUTRAL
from mindrun.robot.guardian.messages import Frame, pack
from mindrun.robot.guardian.plan import Channel

from tests.robot.guardian.faked import TICK, Faked, faked

WHEEL = Channel("wheel", 0.5, MockActuator())
CLAW = Channel("claw", 0.0, MockActuator(), reversed=True)
REST = [0.5, 1.0]


@pytest.fixture
def robot() -> Iterator[Faked]:
    """A wheel, and a claw that is reversed."""
    with faked(WHEEL, CLAW) as robot:
        yield robot


@pytest.fixture
def moving(robot: Faked) -> Faked:
    """The same, on its way."""
    robot.frame(0.875, 1.0)
    assert (robot.last, robot.state) == ([0.875, 0.0], FOLLOWING)
    return robot


def test_the_first_that_is_written_is_neutral(robot: Faked) -> None:
    assert [device.written for device in robot.devices] == [[0.5], [1.0]]


def test_before_the_first_frame_nothing_is_silence(robot: Faked) -> None:
    robot.wait(1000)
    assert (robot.state, robot.process.guard.silences) == (NEUTRAL, 0)


def test_what_is_not_armed_moves_nothing(robot: Faked) -> None:
    for _ in range(5):
        robot.wait(TICK)
        robot.frame(0.875, 1.0, armed=False)
    assert (robot.last, robot.state) == (REST, NEUTRAL)


def test_disarmed_is_neutral_at_once(moving: Faked) -> None:
    moving.frame(0.875, 1.0, armed=False)
    assert moving.last == REST
    moving.frame(0.625, 1.0)
    assert moving.last == [0.625, 0.0]


def test_two_ticks_of_silence_are_neutral_and_the_next_frame_goes_on(moving: Faked) -> None:
    moving.wait(1.9 * TICK)
    assert moving.state == FOLLOWING
    moving.wait(0.2 * TICK)
    assert (moving.last, moving.state, moving.process.guard.silences) == (REST, NEUTRAL, 1)
    moving.frame(0.75, 0.0)
    assert (moving.last, moving.state) == ([0.75, 1.0], FOLLOWING)


def test_silence_counts_from_when_a_frame_was_sent(moving: Faked) -> None:
    moving.wait(TICK)
    moving.frame(0.875, 1.0, age=TICK / 2)
    moving.wait(1.6 * TICK)
    assert moving.last == REST


def test_frames_that_waited_too_long_are_no_sign_of_life(moving: Faked) -> None:
    moving.now[0] += 3 * TICK
    moving.frame(0.875, 1.0, age=2 * TICK)
    assert (moving.last, moving.state) == (REST, NEUTRAL)
    moving.frame(0.875, 1.0, age=2 * TICK)
    assert moving.state == NEUTRAL


def test_a_frame_that_is_as_old_as_the_limit_is_too_old(moving: Faked) -> None:
    guard = moving.process.guard
    frame = Frame(99, 4096.0, True, (0.25, 0.25))
    assert guard.frame(frame, 4096.0 + guard.limit, True) is None
    assert guard.frame(frame, np.nextafter(4096.0 + guard.limit, 0.0), True) is not None


def test_of_frames_that_come_together_the_newest_counts(moving: Faked) -> None:
    sent = round(moving.now[0] * 1e9)
    moving.bytes(pack(8, sent, True, (0.1, 0.0)) + pack(9, sent, True, (0.2, 0.0)))
    assert 0.1 not in [round(value, 3) for value in moving.devices[0].written]
    assert moving.last == pytest.approx([0.2, 1.0])


@pytest.mark.parametrize("bad", [b"x" * 99, pack(9, 0, True, (nan, 0.5)), pack(0, 0, True, (0.5, 0.5))])
def test_a_bad_frame_latches(moving: Faked, bad: bytes) -> None:
    moving.bytes(bad)
    assert (moving.last, moving.state) == (REST, LATCHED)
    moving.number = 100
    for _ in range(10):
        moving.wait(TICK)
        moving.frame(0.875, 1.0)
    assert (moving.last, moving.state) == (REST, LATCHED)


def test_a_frame_from_the_future_latches(moving: Faked) -> None:
    moving.frame(0.875, 1.0, age=-2 * TICK)
    assert (moving.last, moving.state) == (REST, LATCHED)


def test_an_actuator_that_fails_brings_all_to_neutral(moving: Faked) -> None:
    moving.devices[0].fails = True
    for _ in range(4):
        moving.wait(TICK)
        moving.frame(0.6, 1.0)
    assert (moving.state, moving.devices[1].written[-1]) == (NEUTRAL, 1.0)
    assert any("wheel failed: no answer" in line for line in moving.said)


def test_nothing_moves_before_each_has_acknowledged_neutral(moving: Faked) -> None:
    moving.devices[0].fails = True
    moving.wait(3 * TICK)
    moving.frame(0.6, 1.0)
    assert (moving.state, moving.devices[1].written[-1]) == (NEUTRAL, 1.0)
    moving.devices[0].fails = False
    moving.write()
    assert moving.last == REST
    moving.frame(0.6, 1.0)
    assert moving.last == pytest.approx([0.6, 0.0])


def test_a_device_that_fails_now_and_then_goes_on(moving: Faked) -> None:
    for tick in range(50):
        moving.devices[0].fails = bool(tick % 2)
        moving.wait(TICK)
        moving.frame(0.6, 1.0)
    assert (moving.state, moving.process.guard.failures) == (FOLLOWING, 0)


def test_too_many_failures_latch(moving: Faked) -> None:
    for _ in range(MAX_FAILURES):
        moving.devices[0].fails = True
        for _ in range(4):
            moving.wait(TICK)
            moving.frame(0.6, 1.0)
        moving.devices[0].fails = False
        moving.write()
        moving.frame(0.6, 1.0)
    assert (moving.state, moving.last) == (LATCHED, REST)


def test_trim_limits_and_direction() -> None:
    channel = Channel("wheel", 0.5, MockActuator(), trim=0.1, low=0.2, high=0.8, reversed=True)
    with faked(channel) as robot:
        for command in (0.5, 0.0, 1.0):
            robot.frame(command)
        assert robot.devices[0].written == pytest.approx([0.4, 0.4, 0.8, 0.2])


def test_trim_and_least_keep_both_ends() -> None:
    channel = Channel("wheel", 0.5, MockActuator(), trim=0.1, least=0.25)
    with faked(channel) as robot:
        for command in (0.0, 0.5, 1.0, 0.75, 0.50001, 0.49999, 0.25):
            robot.frame(command)
        assert robot.devices[0].written[1:] == pytest.approx([0.0, 0.6, 1.0, 0.85, 0.7, 0.45, 0.225], abs=1e-4)


def test_slew_holds_every_command_but_not_neutral() -> None:
    with faked(Channel("wheel", 0.5, MockActuator(), slew=1.0)) as robot:
        for _ in range(4):
            robot.wait(TICK)
            robot.frame(1.0)
        robot.frame(1.0, armed=False)
        written = [value for value, _ in groupby(robot.devices[0].written)]  # each is written until the next comes
        assert written == pytest.approx([0.5, 0.55, 0.6, 0.65, 0.7, 0.5])
        robot.wait(1000)
        robot.frame(0.0)
        assert robot.last == pytest.approx([0.45])


RATIOS = st.floats(0, 1)
CHANNELS = st.builds(
    lambda neutral, trim, limits, slew, turned, least: Channel(
        "any", neutral, MockActuator(), trim, min(limits), max(limits), slew, turned, least
    ),
    RATIOS,
    st.floats(-1, 1),
    st.tuples(RATIOS, RATIOS),
    st.floats(0, 100),
    st.booleans(),
    RATIOS,
)
EVENTS = st.one_of(
    st.tuples(st.just("frame"), st.tuples(*[st.floats(0, 1, width=32)] * 2), st.floats(0, 3 * TICK)),
    st.tuples(st.just("wild"), st.tuples(*[st.floats()] * 2)),
    st.tuples(st.just("bytes"), st.binary(max_size=80)),
    st.tuples(st.just("wait"), st.floats(0, 3 * TICK)),
    st.tuples(st.just("fail"), st.integers(0, 1)),
)


@given(st.tuples(CHANNELS, CHANNELS), st.lists(EVENTS, max_size=40))
def test_whatever_comes_devices_get_shares_and_faults_end_in_neutral(
    channels: tuple[Channel, Channel],
    events: list[tuple],  # type: ignore[type-arg]
) -> None:
    with faked(*channels) as robot:
        rest = [device.written[-1] for device in robot.devices]
        for event in events:
            match event:
                case "frame", commands, age:
                    robot.frame(*commands, age=age)
                case "wild", commands:
                    robot.frame(*commands)
                case "bytes", data:
                    robot.bytes(data)
                case "wait", seconds:
                    robot.wait(seconds)
                case "fail", index:
                    robot.devices[index].fails ^= True
            if robot.state != FOLLOWING:
                robot.write()  # neutral is tried again, on a device that works again
                assert all(d.fails or d.written[-1] == r for d, r in zip(robot.devices, rest, strict=True))
        for device in robot.devices:
            device.fails = False
        robot.wait(2 * TICK + 1e-6)  # frames count nanoseconds
        robot.write()
        assert robot.last == rest
        assert all(0.0 <= value <= 1.0 for device in robot.devices for value in device.written)
