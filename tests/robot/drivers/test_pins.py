"""Drivers on pins: no motor turns the wrong way in between, a servo waits, an encoder counts, a bumper says where."""

import pytest
from gpiozero.pins.mock import MockFactory, MockPWMPin
from hypothesis import given
from hypothesis import strategies as st
from mindrun.driver import DeviceError
from mindrun.robot.drivers.digital_inputs import LineSensor
from mindrun.robot.drivers.encoder import Encoder
from mindrun.robot.drivers.h_bridge import HBridge
from mindrun.robot.drivers.lamp import Lamp
from mindrun.robot.drivers.servo import PinServo

from tests.robot.drivers.pins import mock_pins, pulsing_pins, turn_encoder

A, B, ENABLE = 5, 6, 13
COMMANDS = st.lists(st.sampled_from([0.0, 0.25, 0.5, 0.75, 1.0]), min_size=1, max_size=12)


@pytest.mark.parametrize("enable", [None, ENABLE])
@given(commands=COMMANDS)
def test_a_motor_turns_only_as_it_was_or_is_commanded(enable: int | None, commands: list[float]) -> None:
    with pytest.MonkeyPatch.context() as patch:
        factory = pulsing_pins(patch)
        device = HBridge(A, B, enable).open()
        before, seen = 0.0, list[float]()
        change = MockPWMPin._change_state

        def changed(pin: MockPWMPin, value: float) -> bool:
            done = change(pin, value)
            seen.append(turning(factory, enable))
            return done

        patch.setattr(MockPWMPin, "_change_state", changed)
        for command in commands:
            seen.clear()
            device.write(command)
            speed = 2 * command - 1
            assert set(seen) <= {before, 0.0, speed}
            assert turning(factory, enable) == speed
            before = speed
        device.close()


def turning(factory: MockFactory, enable: int | None) -> float:
    """How fast a motor turns on the pins as they are."""
    ahead, back = factory.pin(A).state, factory.pin(B).state
    return float((ahead - back) * (1 if enable is None else factory.pin(enable).state))


def test_a_motor_stands_when_it_is_closed_and_takes_no_command_then(monkeypatch: pytest.MonkeyPatch) -> None:
    factory = pulsing_pins(monkeypatch)
    device = HBridge(A, B, ENABLE).open()
    device.write(1.0)
    device.close()
    device.close()
    assert turning(factory, ENABLE) == 0
    with pytest.raises(DeviceError):
        device.write(1.0)


def test_a_pin_that_is_taken_says_which_and_lets_go_of_the_others(monkeypatch: pytest.MonkeyPatch) -> None:
    pulsing_pins(monkeypatch)
    lamp = Lamp(B).open()
    with pytest.raises(DeviceError, match="backward pin, GPIO 6, cannot be opened"):
        HBridge(A, B, ENABLE).open()
    lamp.close()
    HBridge(A, B, ENABLE).open().close()


def test_a_servo_does_not_move_until_it_is_commanded(monkeypatch: pytest.MonkeyPatch) -> None:
    pin = pulsing_pins(monkeypatch).pin(12)
    device = PinServo(12).open()
    assert pin.frequency is None
    device.write(0.5)
    assert (pin.frequency, pin.state) == (50, pytest.approx(0.075))


def test_a_servo_whose_pulses_are_turned_round_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    pulsing_pins(monkeypatch)
    with pytest.raises(DeviceError, match="GPIO 12 cannot be opened"):
        PinServo(12, shortest=2000.0, longest=1000.0).open()


@pytest.mark.parametrize(("measure", "expected"), [("distance", -0.75), ("angle", 90.0)])
def test_an_encoder_counts_turns(monkeypatch: pytest.MonkeyPatch, measure: str, expected: float) -> None:
    factory = mock_pins(monkeypatch)
    device = Encoder(A, B, steps=4, circumference=0.2, measure=measure).open()
    turn_encoder(factory, A, B, 5)
    turn_encoder(factory, A, B, -20)
    assert device.read() == pytest.approx((expected,))


def test_a_speed_is_what_was_travelled_since_the_reading_before(monkeypatch: pytest.MonkeyPatch) -> None:
    factory, now = mock_pins(monkeypatch), [100.0]
    monkeypatch.setattr("mindrun.robot.drivers.encoder.monotonic", lambda: now[0])
    device = Encoder(A, B, steps=10, circumference=0.5, measure="speed").open()
    for steps, speed in ((4, 0.4), (-2, -0.2), (0, 0.0)):
        turn_encoder(factory, A, B, steps)
        now[0] += 0.5
        assert device.read() == pytest.approx((speed,))


@pytest.mark.parametrize(("inverted", "expected"), [(False, (1.0, 0.0)), (True, (0.0, 1.0))])
def test_a_line_sensor_says_what_is_dark(monkeypatch: pytest.MonkeyPatch, inverted: bool, expected: tuple) -> None:
    factory = mock_pins(monkeypatch)
    factory.pin(A).drive_high()
    factory.pin(B).drive_low()
    assert LineSensor((A, B), inverted).open().read() == expected
