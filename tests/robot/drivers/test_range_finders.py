"""Range finders: no echo, a broken wire and a lost edge are three things, and no two neighbours fire in turn."""

from math import inf
from time import monotonic

import pytest
from mindrun.driver import DeviceError
from mindrun.robot import i2c
from mindrun.robot.drivers.grove_ultrasonic import GroveUltrasonic
from mindrun.robot.drivers.ultrasonic import Ultrasonic, firing_order

from tests.robot.drivers.echoes import ring
from tests.robot.drivers.fakes import FakeBus, FakeGrovePi
from tests.robot.drivers.pins import mock_pins

TEN = Ultrasonic(trigger=(2, 3, 4, 5, 6, 7, 8, 9, 10, 11), echo=(12, 13, 14, 15, 16, 17, 18, 19, 20, 21))


@pytest.mark.parametrize("count", [5, 7, 8, 9, 10, 11, 12, 16])
def test_no_two_neighbours_fire_in_turn(count: int) -> None:
    order = firing_order(count)
    assert sorted(order) == [*range(count)]
    steps = [(after - before) % count for before, after in zip(order, [*order[1:], order[0]], strict=True)]
    assert {1, count - 1} & {*steps} == set()


@pytest.mark.parametrize("count", [1, 2, 3, 4, 6])
def test_few_fire_in_some_order(count: int) -> None:
    assert sorted(firing_order(count)) == [*range(count)]


def test_the_ten_of_the_paper(monkeypatch: pytest.MonkeyPatch) -> None:
    log: list[str] = []
    pins = ring(mock_pins(monkeypatch), TEN.trigger, TEN.echo, log)
    distances = [0.05 + 0.09 * index for index in range(10)]
    for pin, metres in zip(pins, distances, strict=True):
        pin.metres = metres
    device = TEN.open()
    begin = monotonic()
    assert device.read() == pytest.approx(distances, abs=1e-3)
    assert monotonic() - begin > 0.05
    assert log == [f"GPIO{TEN.echo[index]}" for index in firing_order(10)]


def test_what_does_not_echo_is_none_again_and_again(monkeypatch: pytest.MonkeyPatch) -> None:
    (pin,) = ring(mock_pins(monkeypatch), (5,), (6,), [])
    pin.metres = None
    device = Ultrasonic((5,), (6,)).open()
    assert [device.read() for _ in range(3)] == [(None,)] * 3
    pin.metres = 0.4
    assert device.read() == pytest.approx((0.4,), abs=1e-3)


@pytest.mark.parametrize(
    ("fault", "said"), [("silent", "does not answer"), ("stuck", "holds its echo"), ("lost", "when is not known")]
)
def test_a_fault_is_no_distance(monkeypatch: pytest.MonkeyPatch, fault: str, said: str) -> None:
    (pin,) = ring(mock_pins(monkeypatch), (5,), (6,), [])
    pin.metres = 0.4
    device = Ultrasonic((5,), (6,)).open()
    device.read()
    pin.fault = fault
    with pytest.raises(DeviceError, match=said):
        (device.read(), device.read())  # a line that stays high is at first no echo


def test_pins_must_make_pairs(monkeypatch: pytest.MonkeyPatch) -> None:
    mock_pins(monkeypatch)
    with pytest.raises(DeviceError, match="1 trigger pins and 2 echo pins"):
        Ultrasonic((5,), (6, 7)).open()
    with pytest.raises(DeviceError, match="GPIO 6 and 5"):
        Ultrasonic((5, 6), (7, 5)).open()
    Ultrasonic((5, 6), (7, 8)).open().close()  # the pins of those before were let go


def test_a_port_with_no_ranger_is_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(i2c, "open_bus", lambda number: FakeBus({4: FakeGrovePi({4: 35})}))
    assert GroveUltrasonic((4,)).open().read() == (0.35,)
    with pytest.raises(DeviceError, match="no ranger on port D5"):
        GroveUltrasonic((4, 5)).open().read()


def test_a_board_that_is_busy_for_ever_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    board = FakeGrovePi({4: 35})
    monkeypatch.setattr(i2c, "open_bus", lambda number: FakeBus({4: board}))
    device = GroveUltrasonic((4,)).open()
    board.takes = inf
    with pytest.raises(DeviceError, match="does not finish"):
        device.read()
