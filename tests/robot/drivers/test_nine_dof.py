"""The 9-dof sensor and the battery: physical quantities in their units, the right way round."""

import pytest
from mindrun.driver import DeviceError
from mindrun.graph.wiring import SensorWire, reading
from mindrun.robot import i2c
from mindrun.robot.drivers.ads1115 import Ads1115
from mindrun.robot.drivers.lsm9ds1 import MagneticCompass, Motion, Turn

from tests.robot.drivers.fakes import FakeAds1115, FakeBus, FakeLsm9ds1

MS2, MILLIGAUSS = 0.061e-3 * 9.80665, 0.14


def on_bus(patch: pytest.MonkeyPatch, address: int, part: object) -> None:
    """Put a part on the bus."""
    patch.setattr(i2c, "open_bus", lambda number: FakeBus({address: part}))


@pytest.fixture
def accelerometer(monkeypatch: pytest.MonkeyPatch) -> FakeLsm9ds1:
    """An accelerometer at rest."""
    part = FakeLsm9ds1(0x68, 0x20, 0x17, 0x01, 0x28)
    part.vector = (0.0, 0.0, 9.80665 / MS2)
    on_bus(monkeypatch, 0x6B, part)
    return part


@pytest.fixture
def magnetometer(monkeypatch: pytest.MonkeyPatch) -> FakeLsm9ds1:
    """A magnetometer in central Europe."""
    part = FakeLsm9ds1(0x3D, 0x22, 0x27, 0x08, 0xA8)
    on_bus(monkeypatch, 0x1E, part)
    return part


def test_rest_and_motion_differ(accelerometer: FakeLsm9ds1) -> None:
    device = Motion(window=0.2).open()
    assert device.read()[0] < 0.05
    accelerometer.shaken = 0.5 / MS2
    for _ in range(30):
        shaken = device.read()[0]
    assert 0.5 < shaken < 1.3  # on three axes: the root of three times 0.5


@pytest.mark.parametrize("leaning", [(0.0, 0.0, 1.0), (0.0, 0.6, 0.8), (-0.8, 0.0, 0.6), (1.0, 0.0, 0.0)])
def test_leaning_is_no_motion(accelerometer: FakeLsm9ds1, leaning: tuple[float, float, float]) -> None:
    accelerometer.vector = tuple(part * 9.80665 / MS2 for part in leaning)
    assert Motion().open().read()[0] < 0.05


def test_no_gravity_is_a_fault(accelerometer: FakeLsm9ds1) -> None:
    device = Motion().open()
    accelerometer.vector = (0.0, 0.0, 0.0)
    with pytest.raises(DeviceError, match="no gravity"):
        device.read()


def test_a_chip_that_lost_power_is_set_up_again(accelerometer: FakeLsm9ds1) -> None:
    device = Motion().open()
    accelerometer.values.clear()
    with pytest.raises(DeviceError, match="anything new"):
        device.read()
    assert device.read()[0] < 0.05


@pytest.mark.parametrize(("face", "sign"), [("up", 1), ("down", -1)])
def test_to_the_left_is_positive(monkeypatch: pytest.MonkeyPatch, face: str, sign: int) -> None:
    part = FakeLsm9ds1(0x68, 0x10, 0x17, 0x02, 0x18)
    part.vector = (0.0, 0.0, 100 / 8.75e-3)
    on_bus(monkeypatch, 0x6B, part)
    assert Turn(face=face).open().read()[0] == pytest.approx(sign * 100, abs=0.5)


def test_too_fast_to_measure_is_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    part = FakeLsm9ds1(0x68, 0x10, 0x17, 0x02, 0x18)
    on_bus(monkeypatch, 0x6B, part)
    device = Turn().open()
    part.vector, part.rng.gauss = (0.0, 0.0, 32767.0), lambda mean, deviation: 0.0
    with pytest.raises(DeviceError, match="more than it can"):
        device.read()


@pytest.mark.parametrize(
    ("x", "y", "angle", "share"),
    [(200, 0, 0.0, 0.5), (0, 200, 90.0, 0.25), (0, -200, -90.0, 0.75), (141, 141, 45.0, 0.375)],
)
def test_north_reads_as_a_bearing(magnetometer: FakeLsm9ds1, x: int, y: int, angle: float, share: float) -> None:
    magnetometer.vector = (x / MILLIGAUSS, y / MILLIGAUSS, -430 / MILLIGAUSS)
    driver = MagneticCompass()
    (found,) = driver.open().read()
    assert found == pytest.approx(angle, abs=1.5)
    assert reading(SensorWire("north", driver, *driver.usual), found) == pytest.approx(share, abs=0.005)


def test_iron_and_mounting_are_taken_off(magnetometer: FakeLsm9ds1) -> None:
    magnetometer.vector = ((300 + 50) / MILLIGAUSS, (200 - 80) / MILLIGAUSS, 0.0)
    (found,) = MagneticCompass(x=350.0, y=-80.0).open().read()
    assert found == pytest.approx(90, abs=1.5)
    (found,) = MagneticCompass(x=350.0, y=-80.0, turn=120.0).open().read()
    assert found == pytest.approx(-150, abs=1.5)
    (found,) = MagneticCompass(x=350.0, y=-80.0, face="down").open().read()
    assert found == pytest.approx(-90, abs=1.5)


def test_no_field_is_a_fault(magnetometer: FakeLsm9ds1) -> None:
    with pytest.raises(DeviceError, match="no magnetic field"):
        MagneticCompass().open()


@pytest.mark.parametrize(("volts", "channel"), [(8.4, 0), (6.4, 3), (0.0, 1)])
def test_a_battery_is_measured_through_its_divider(monkeypatch: pytest.MonkeyPatch, volts: float, channel: int) -> None:
    part = FakeAds1115(volts / 3.13)
    on_bus(monkeypatch, 0x48, part)
    driver = Ads1115(channel)
    assert driver.open().read()[0] == pytest.approx(volts, abs=0.001)
    assert part.config == 0xC383 | channel << 12


def test_a_little_below_ground_is_empty(monkeypatch: pytest.MonkeyPatch) -> None:
    on_bus(monkeypatch, 0x48, FakeAds1115(-0.002))
    assert Ads1115().open().read() == (0.0,)


def test_a_wrong_divider_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    on_bus(monkeypatch, 0x48, FakeAds1115(5.0))
    with pytest.raises(DeviceError, match="divider is wrong"):
        Ads1115().open()


def test_a_conversion_that_never_ends_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    part = FakeAds1115(2.0)
    on_bus(monkeypatch, 0x48, part)
    device = Ads1115().open()
    monkeypatch.setattr(part, "read", lambda count: (part.config & 0x7FFF).to_bytes(2, "big"))
    with pytest.raises(DeviceError, match="does not finish"):
        device.read()
