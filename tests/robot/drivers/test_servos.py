"""Servos on a PCA9685: pulses of the right width, other channels left alone, and lost settings noticed."""

import pytest
from mindrun.driver import DeviceError
from mindrun.robot import i2c
from mindrun.robot.drivers.pca9685 import COUNT, Pca9685

from tests.robot.drivers.fakes import FakeBus, FakePca9685


@pytest.fixture
def card(monkeypatch: pytest.MonkeyPatch) -> FakePca9685:
    """A servo card that has just been turned on."""
    found = FakePca9685()
    monkeypatch.setattr(i2c, "open_bus", lambda number: FakeBus({0x40: found}))
    return found


def test_it_runs_at_fifty_pulses_a_second(card: FakePca9685) -> None:
    Pca9685(0).open()
    assert card.values[0xFE] == 121
    assert pytest.approx(50, rel=0.001) == 1e6 / (4096 * COUNT)


def test_nothing_moves_until_it_is_commanded(card: FakePca9685) -> None:
    device = Pca9685(0).open()
    assert [card.pulse(channel) for channel in range(16)] == [None] * 16
    device.write(0.5)
    assert card.pulse(0) == pytest.approx(1500, abs=COUNT)
    assert [card.pulse(channel) for channel in range(1, 16)] == [None] * 15


def test_pulses_end_where_they_were_told_to(card: FakePca9685) -> None:
    device = Pca9685(15, shortest=544.0, longest=2400.0).open()
    for value in (0.0, 0.1, 0.9, 1.0):
        device.write(value)
        assert card.pulse(15) == pytest.approx(544 + value * 1856, abs=COUNT / 2)


def test_a_second_servo_does_not_disturb_the_first(card: FakePca9685) -> None:
    first = Pca9685(0).open()
    first.write(1.0)
    writes = dict(card.values)
    second = Pca9685(1).open()
    assert card.values == writes
    second.write(0.0)
    assert card.pulse(0) == pytest.approx(2000, abs=COUNT)
    first.close()
    second.write(0.5)
    assert card.pulse(0) == pytest.approx(2000, abs=COUNT), "a claw keeps what it holds"


def test_a_card_at_another_rate_is_turned_off_before_it_is_set_up(card: FakePca9685) -> None:
    Pca9685(0).open().write(1.0)
    card.values[0xFE] = 60
    Pca9685(1).open()
    assert card.pulse(0) is None


def test_a_brown_out_is_told_and_then_mended(card: FakePca9685) -> None:
    device = Pca9685(0).open()
    device.write(0.5)
    card.power_on()
    with pytest.raises(DeviceError, match="lost its settings"):
        device.write(0.6)
    device.write(0.6)
    assert card.pulse(0) == pytest.approx(1600, abs=COUNT)


def test_something_else_at_that_address_is_refused(card: FakePca9685) -> None:
    card.set = lambda register, value: None
    with pytest.raises(DeviceError, match="is it a PCA9685"):
        Pca9685(0).open()
