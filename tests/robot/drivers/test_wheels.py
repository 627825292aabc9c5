"""Wheels on a Grove motor board: both start stopped, and no failure leaves one running the wrong way."""

from math import isclose
from random import Random

import pytest
from mindrun.driver import DeviceError
from mindrun.robot import driver_support, i2c
from mindrun.robot.drivers import grove_motor
from mindrun.robot.drivers.grove_motor import GroveMotor, MotorDevice

from tests.robot.drivers.fakes import FakeBus, FakeGroveMotor

LEFT, RIGHT = GroveMotor(motor=1), GroveMotor(motor=2)


@pytest.fixture
def bus(monkeypatch: pytest.MonkeyPatch) -> FakeBus:
    """A bus with a board whose motors still run, as after a crash."""
    found = FakeBus({0x0F: FakeGroveMotor(speeds=[200, 200], directions=0b1010)})

    def open_bus(number: int) -> FakeBus:
        found.open += 1
        return found

    monkeypatch.setattr(i2c, "open_bus", open_bus)
    monkeypatch.setattr(grove_motor, "boards", driver_support.SharedParts())
    return found


@pytest.fixture
def board(bus: FakeBus) -> FakeGroveMotor:
    """That board."""
    return bus.parts[0x0F]


def test_the_first_thing_sent_stops_both(board: FakeGroveMotor) -> None:
    LEFT.open()
    assert board.commands[0] == bytes([0x82, 0, 0])
    assert board.speeds == [0, 0]


def test_the_second_wheel_does_not_stop_the_first(bus: FakeBus, board: FakeGroveMotor) -> None:
    left = LEFT.open()
    left.write(1.0)
    right = RIGHT.open()
    right.write(0.0)
    assert (board.turning(0), board.turning(1), bus.open) == (255, -255, 1)
    left.close()
    assert (board.turning(0), board.turning(1), bus.open) == (0, -255, 1)
    right.close()
    assert (board.speeds, bus.open) == ([0, 0], 0)


@pytest.mark.parametrize(
    ("left", "right", "directions"), [(1, 1, 0b1010), (0, 0, 0b0101), (1, 0, 0b0110), (0, 1, 0b1001)]
)
def test_directions_are_those_of_seeed(board: FakeGroveMotor, left: int, right: int, directions: int) -> None:
    LEFT.open().write(left)
    RIGHT.open().write(right)
    assert board.directions == directions


def test_a_steady_wheel_costs_one_command(board: FakeGroveMotor) -> None:
    device = LEFT.open()
    device.write(0.7)
    sent = len(board.commands)
    for value in (0.8, 0.9, 0.6):
        device.write(value)
    assert len(board.commands) == sent + 3


def test_a_wheel_is_stopped_before_it_is_turned_round(board: FakeGroveMotor) -> None:
    device = LEFT.open()
    device.write(1.0)
    board.commands.clear()
    device.write(0.25)
    assert board.commands == [bytes([0x82, 0, 0]), bytes([0xAA, 0b1001, 1]), bytes([0x82, 128, 0])]


def test_a_board_that_lost_power_is_told_its_directions_again(
    board: FakeGroveMotor, monkeypatch: pytest.MonkeyPatch
) -> None:
    device = LEFT.open()
    device.write(0.8)
    board.directions, board.speeds = 0, [0, 0]
    monkeypatch.setattr(grove_motor, "DIRECTION_REFRESH_SECONDS", 0.0)
    device.write(0.8)
    assert board.turning(0) == 153


@pytest.mark.parametrize("seed", range(3))
def test_no_failure_makes_a_wheel_run_as_it_never_was_told(bus: FakeBus, board: FakeGroveMotor, seed: int) -> None:
    rng = Random(seed)
    devices = (LEFT.open(), RIGHT.open())
    allowed: list[set[int]] = [{0}, {0}]
    bus.rng, bus.failing = rng, 0.7
    for _ in range(30):
        wheel, value = rng.randrange(2), rng.choice([0.0, 0.2, 0.5, 0.9, 1.0])
        allowed[wheel].add(round(255 * (2 * value - 1)))
        if told(devices[wheel], value):
            allowed[wheel] = {0, round(255 * (2 * value - 1))}
            assert isclose(board.turning(wheel), 255 * (2 * value - 1), abs_tol=0.5)
        assert board.turning(0) in allowed[0]
        assert board.turning(1) in allowed[1]


def told(device: MotorDevice, value: float) -> bool:
    """Whether the device said that it did as it was told."""
    try:
        device.write(value)
    except DeviceError:
        return False
    return True
