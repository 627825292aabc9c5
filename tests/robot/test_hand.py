"""A hand on a robot: the loop stops where it has let go, the guardian's bounds hold it, and keys say what they say."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.engine.changes import ChangedEngine
from mindrun.errors import MindError
from mindrun.graph.policy import Policy
from mindrun.graph.recording_header import BY_LOOP, NOT_STOPPED
from mindrun.graph.wiring import ActuatorWire, SensorWire, Wiring
from mindrun.robot.drivers.mock import MockActuator, MockSensor
from mindrun.robot.guardian.guard import Guard
from mindrun.robot.guardian.messages import Frame
from mindrun.robot.guardian.plan import plan_of
from mindrun.robot.hand import HAND_SECONDS, hand_on
from mindrun.robot.keys import KeyDriving
from mindrun.robot.loop import Loop, Rate
from mindrun.robot.order_client import say_order
from mindrun.robot.orders import Orders
from mindrun.robot.recording import read
from mindrun.robot.replay import replay_recording
from mindrun.robot.sensing import ReadingFilter, Sampler

from tests.robot.driving import begun, until
from tests.robot.faults import TICK, Clock, Sent, graph

WHEELS = ("left_wheel", "right_wheel")


def test_a_robot_is_at_neutral_while_nobody_drives() -> None:
    of, clock, sent, told = graph("range_finder"), Clock(), Sent(), list[str]()
    hand = hand_on(of, "Go", WHEELS, clock)
    sampler = Sampler(SensorWire("sense", MockSensor(0.6, 3), 0.0, 1.0, max_age=1e3), clock)
    _, sampler.latest = sampler._measured(None)
    pace = Rate(TICK, clock, clock.sleep)
    loop = Loop(
        ChangedEngine(Policy(of, {})), ReadingFilter(of, [sampler]), sent, pace, True, tell=told.append, hand=hand
    )
    loop.pace.begin()
    loop.tick()
    for name in WHEELS:
        hand.say(name, 0.25)
    ticks = int(2 * HAND_SECONDS / TICK)
    for _ in range(ticks):
        loop.tick()
    moving = [armed for armed in sent.armed if armed]
    assert sent.armed == [False, *moving, *([False] * (ticks - len(moving)))]
    assert HAND_SECONDS / TICK - 2 <= len(moving) <= HAND_SECONDS / TICK + 2
    driven = [commands for commands, armed in zip(sent.commands, sent.armed, strict=True) if armed]
    assert all(each[:2].tolist() == [0.25, 0.25] for each in driven)
    assert len({float(each[2]) for each in driven}) > 1  # the claw is the mind's
    assert (loop.stopped, loop.alone) == (0, 1 + ticks - len(moving))
    stands = "nobody drives, and every actuator is at neutral"
    assert told == [stands, "the hand drives", stands]


@given(st.lists(st.tuples(st.floats(), st.floats(0, 1)), min_size=1, max_size=20))
def test_the_guardians_bounds_hold_a_wild_hand(said: list[tuple[float, float]]) -> None:
    of, clock = graph("range_finder"), Clock()
    hand = hand_on(of, "Go", ("left_wheel",), clock)
    orders = Orders(of, hand=hand)
    wires = [ActuatorWire(name, MockActuator(), low=0.4, high=0.6, slew=1.0) for name in (*WHEELS, "claw")]
    neutrals = {each.name: each.kind.neutral for each in of.actuators}
    guard, before = Guard(plan_of(TICK, neutrals, Wiring("mock", (), tuple(wires)))), 0.5
    for number, (wild, good) in enumerate(said, 1):
        for value in (good, wild):
            try:
                orders.say(f"left_wheel {value}")
            except MindError:
                assert not 0 <= value <= 1
        now = hand.now()
        assert now
        commands = hand.exchanged(np.full(3, 0.5, np.float32), now)
        assert 0 <= commands[0] <= 1
        at = number * TICK
        values = guard.frame(Frame(number, at, True, tuple(commands.tolist())), at, True)
        assert values
        assert 0.4 <= values[0] <= 0.6
        assert abs(values[0] - before) <= TICK * 1.0 + 1e-6
        before = values[0]


def test_a_robot_hears_the_hand_records_it_and_stops_when_it_is_silent(bundle: Path, tmp_path: Path) -> None:
    day = tmp_path / "day.rec"
    process = begun(bundle, day, "--drive", "left_wheel")
    try:
        with pytest.raises(MindError, match="left_wheel cannot be 2: it is a number from 0 to 1"):
            say_order("left_wheel", 2, process.pid)
        say_order("left_wheel", 0.875, process.pid)  # and nothing after it
        until(lambda: _stops(day)[-1] == BY_LOOP and NOT_STOPPED in _stops(day), process)
    finally:
        process.terminate()
        assert process.wait() == 0
    about, parts = read(day)
    rows = np.concatenate(list(parts))
    is_driven = rows["stopped"] == NOT_STOPPED
    assert about.by_hand == ("left_wheel",)
    assert (rows["sent"][is_driven, 0] == 0.875).all()
    assert (rows["sent"][is_driven, 1:] == rows["commands"][is_driven, 1:]).all()
    assert (rows["sent"][rows["stopped"] == BY_LOOP] == (0.5, 0.5, 0.0)).all()
    assert replay_recording(day, bundle).differs is None


def _stops(day: Path) -> list[int]:
    _, parts = read(day)
    return [0, *(int(each) for rows in parts for each in rows["stopped"])]


@pytest.mark.parametrize(
    ("keys", "numbers"),
    [
        (b"w", [1.0, 1.0, 0.0]),
        (b"\x1b[B", [0.0, 0.0, 0.0]),
        (b"a", [0.25, 0.75, 0.0]),
        (b"\x1b[C", [0.75, 0.25, 0.0]),
        (b"ew", [1.0, 1.0, 1.0]),  # the claw stays closed
        (b"e q", [0.5, 0.5, 0.0]),
        (b"x\xff", None),
    ],
)
def test_keys_of_a_terminal_say_all_that_is_held(keys: bytes, numbers: list[float] | None) -> None:
    hand = hand_on(graph("bearing"), "Go", (*WHEELS, "claw"), Clock())
    KeyDriving(hand).press(keys)
    said = hand.now()
    assert numbers == (said and [said[name] for name in hand.names])


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("left_whel", "there is no actuator, and no skill below Go, called left_whel"),
        ("Go", "Go is in charge: nothing influences it"),
        ("", "there is no actuator, and no skill below Go, called "),
    ],
)
def test_a_hand_holds_actuators_and_skills_below_the_master(name: str, said: str) -> None:
    with pytest.raises(MindError) as refused:
        hand_on(graph("bearing"), "Go", (name,))
    assert str(refused.value) == said
