"""VL53L0X, MPU-6050 and an eye of a camera: what is too far, asleep or beside a ray is not read as something."""

from concurrent.futures import ThreadPoolExecutor
from math import asin, cos, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.driver import DeviceError
from mindrun.robot import i2c
from mindrun.robot.drivers import ads1115, grove_ultrasonic
from mindrun.robot.drivers.ads1115 import Ads1115
from mindrun.robot.drivers.ball_eye import along_ray
from mindrun.robot.drivers.grove_ultrasonic import GroveUltrasonic
from mindrun.robot.drivers.mpu6050 import Mpu6050
from mindrun.robot.drivers.vl53l0x import Vl53l0x

from tests.robot.drivers.fakes import FakeAds1115, FakeBus, FakeGrovePi, FakeMpu6050, FakeVl53l0x


def test_what_asks_one_chip_waits_for_its_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two rangers of one board, two inputs of one converter: each in a thread of its own, as sensors are sampled."""
    monkeypatch.setattr(grove_ultrasonic, "ANSWERED_IN", 600.0)
    monkeypatch.setattr(ads1115, "DONE_IN", 600.0)
    parts = {0x04: FakeGrovePi({4: 40, 2: 20}), 0x48: FakeAds1115(1.0)}
    monkeypatch.setattr(i2c, "open_bus", lambda number: FakeBus(parts))
    drivers = [GroveUltrasonic((4,)), GroveUltrasonic((2,)), Ads1115(0, 2.0), Ads1115(1, 2.0)]
    found: list[set[object]] = [set() for _ in drivers]

    def read(number: int) -> None:
        device = drivers[number].open()
        for _ in range(10):
            try:
                found[number].add(round(device.read()[0] or 0.0, 2))
            except DeviceError as error:
                found[number].add(str(error))

    with ThreadPoolExecutor(len(drivers)) as pool:
        [*pool.map(read, range(len(drivers)))]
    assert found == [{0.4}, {0.2}, {2.0}, {2.0}]


def on_bus(patch: pytest.MonkeyPatch, address: int, part: object) -> None:
    """A part on a bus of its own."""
    patch.setattr(i2c, "open_bus", lambda number: FakeBus({address: part}))


@pytest.mark.parametrize(("metres", "expected"), [(0.0, 0.0), (0.8, 0.8), (0.81, None), (None, None)])
def test_a_range_is_metres_or_none(monkeypatch: pytest.MonkeyPatch, metres: float | None, expected: object) -> None:
    part = FakeVl53l0x(0.5)
    on_bus(monkeypatch, 0x29, part)
    device = Vl53l0x(range=0.8).open()
    part.metres = metres
    assert device.read() == (expected,)


def test_a_laser_that_is_broken_is_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    part = FakeVl53l0x(0.5)
    on_bus(monkeypatch, 0x29, part)
    device = Vl53l0x().open()
    part.metres, part.status = None, 0x08
    with pytest.raises(DeviceError, match="laser does not work"):
        device.read()


def test_a_range_finder_that_lost_power_is_set_up_again(monkeypatch: pytest.MonkeyPatch) -> None:
    part = FakeVl53l0x(0.5)
    on_bus(monkeypatch, 0x29, part)
    device = Vl53l0x().open()
    part.power_on()
    with pytest.raises(DeviceError, match="does not measure anything new"):
        device.read()
    assert device.read() == (0.5,)


@pytest.mark.parametrize("turning", [-499.0, -1.0, 0.0, 250.0])
def test_turning_left_is_positive_and_up_or_down(monkeypatch: pytest.MonkeyPatch, turning: float) -> None:
    on_bus(monkeypatch, 0x68, FakeMpu6050(turning))
    assert Mpu6050().open().read() == pytest.approx((turning,), abs=0.01)
    assert Mpu6050("down").open().read() == pytest.approx((-turning,), abs=0.01)


def test_a_gyroscope_that_fell_asleep_is_a_fault_and_then_woken(monkeypatch: pytest.MonkeyPatch) -> None:
    part = FakeMpu6050(90.0)
    on_bus(monkeypatch, 0x68, part)
    device = Mpu6050().open()
    part.power_on()
    with pytest.raises(DeviceError, match="does not measure anything new"):
        device.read()
    assert device.read() == pytest.approx((90.0,), abs=0.01)


def test_a_gyroscope_at_its_end_is_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    part = FakeMpu6050(0.0)
    on_bus(monkeypatch, 0x68, part)
    device = Mpu6050().open()
    part.turning = 32767 / 65.5
    with pytest.raises(DeviceError, match="more than it can"):
        device.read()


@given(st.floats(-3.14, 3.14), st.floats(0.2, 5.0), st.floats(0.01, 0.2))
def test_a_ray_ends_on_the_rim_of_the_ball_or_misses_it(angle: float, metres: float, radius: float) -> None:
    found = along_ray(angle, metres, radius)
    half = asin(min(1.0, radius / metres))
    if abs(angle) < half - 1e-9:
        assert found is not None
        x, y = found * cos(angle) - metres, found * sin(angle)
        assert x * x + y * y == pytest.approx(radius * radius, abs=1e-6)
        assert found <= metres
    elif abs(angle) > half + 1e-9:
        assert found is None
