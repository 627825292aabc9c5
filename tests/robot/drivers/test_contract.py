"""The same tests for every driver, on a fake of its part: it answers in time, with sense or with an error."""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import fields, replace
from math import inf, isclose, isfinite, nan
from time import monotonic
from typing import Annotated, get_origin, get_type_hints

import pytest
from mindrun.driver import DeviceError, SensorDevice
from mindrun.kinds.registry import kinds
from mindrun.robot import drivers
from mindrun.robot.drivers import ball_tracker

from tests.robot.drivers.worlds import ACTUATORS, ANYTHING, SENSORS, World

ELSEWHERE = {"simulated"}  # its device is another process: tests/robot/test_world.py
OPENING = READING = WRITING = 300.0  # seconds, in which all ends that does not hang, however busy the machine
ON_BUS_SENSORS = ["grove_ultrasonic", "ads1115", "lsm9ds1_motion", "lsm9ds1_turn", "lsm9ds1_compass"]
ON_BUS_SENSORS += ["vl53l0x", "mpu6050"]
ON_BUS_ACTUATORS = ["pca9685", "grove_motor"]
VALUES = (0.0, 0.5, 1.0, 0.25, 0.75, 0.123, 0.5)
REFUSED = (nan, inf, -inf, -0.001, 1.001)


@pytest.fixture
def world(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[World]:
    """The fake of a part."""
    worlds = SENSORS if "sensor" in request.node.name else ACTUATORS
    yield worlds[request.param](monkeypatch)
    ball_tracker.cameras.close()


sensors = pytest.mark.parametrize("world", SENSORS, indirect=True)
actuators = pytest.mark.parametrize("world", ACTUATORS, indirect=True)


def sensible(world: World, values: object) -> bool:
    """Whether these are as many as there should be, each None or a number that is possible."""
    low, high = getattr(world.driver, "possible", ANYTHING)
    return len(values) == world.driver.readings and all(
        value is None or (type(value) is float and isfinite(value) and low <= value <= high) for value in values
    )


def matches(values: tuple[float | None, ...], world: World) -> bool:
    """Whether the values are those that the fake has."""
    return all(
        found is expected if None in (found, expected) else isclose(found, expected, abs_tol=world.within)
        for found, expected in zip(values, world.expected, strict=True)
    )


def test_every_driver_is_tested() -> None:
    assert drivers
    assert kinds("sensor driver").keys() - ELSEWHERE == SENSORS.keys()
    assert kinds("actuator driver").keys() - ELSEWHERE == ACTUATORS.keys()


@pytest.mark.parametrize("driver", [*kinds("sensor driver").values(), *kinds("actuator driver").values()])
def test_options_say_what_they_mean(driver: type) -> None:
    assert not driver.__doc__.startswith(f"{driver.__name__}(")
    hints = get_type_hints(driver, include_extras=True)
    assert all(get_origin(hints[option.name]) is Annotated for option in fields(driver))


def read_for(seconds: float, device: SensorDevice) -> None:
    """Read again and again: a camera may have one more frame."""
    begin = monotonic()
    while monotonic() - begin < seconds:
        device.read()


@sensors
def test_sensor_reads_what_is_there(world: World) -> None:
    begin = monotonic()
    device = world.driver.open()
    assert monotonic() - begin < OPENING
    for _ in range(3):
        begin = monotonic()
        values = device.read()
        assert monotonic() - begin < READING
        assert sensible(world, values)
        assert matches(values, world), values
    device.close()


@sensors
def test_sensor_driver_is_a_value(world: World) -> None:
    assert {replace(world.driver)} == {world.driver}
    low, high = world.driver.usual
    assert low != high
    assert world.driver.readings == len(world.expected)
    assert isinstance(world.driver.unit, str)


@sensors
def test_sensor_closes_twice_and_opens_again(world: World) -> None:
    for _ in range(2):
        device = world.driver.open()
        device.close()
        device.close()
        if world.bus:
            assert world.bus.open == 0
            with pytest.raises(DeviceError, match="closed"):
                device.read()
    assert matches(world.driver.open().read(), world)


@sensors
def test_sensor_that_fails_says_so_in_time(world: World, monkeypatch: pytest.MonkeyPatch) -> None:
    if world.fail is None:
        return
    device = world.driver.open()
    device.read()
    world.fail()
    monkeypatch.setattr(ball_tracker, "MAX_FRAME_AGE_SECONDS", 0.2)  # nothing comes any more, however long one waits
    for _ in range(2):
        begin = monotonic()
        with pytest.raises(DeviceError):
            read_for(READING, device)
        assert monotonic() - begin < READING
    device.close()


@pytest.mark.parametrize("world", ON_BUS_SENSORS, indirect=True)
def test_sensor_on_a_dead_bus_cannot_be_opened(world: World) -> None:
    world.bus.failing = 1.0
    with pytest.raises(DeviceError, match="I2C bus 1 does not answer") as caught:
        world.driver.open()
    assert "i2cdetect -y 1" in caught.value.hint
    assert world.bus.open == 0


@pytest.mark.parametrize("world", ON_BUS_SENSORS, indirect=True)
def test_sensor_on_a_hanging_bus_ends(world: World) -> None:
    device = world.driver.open()
    for failing in (0.0, 1.0):
        world.bus.hang, world.bus.failing = 0.11, failing
        begin = monotonic()
        with suppress(DeviceError):
            assert matches(device.read(), world)
            assert not failing
        assert monotonic() - begin < READING
    world.bus.hang = world.bus.failing = 0.0
    assert matches(device.read(), world)


@pytest.mark.parametrize("world", ON_BUS_SENSORS, indirect=True)
@pytest.mark.parametrize("garbage", ["ones", "zeros", "short"])
def test_sensor_refuses_garbage(world: World, garbage: str) -> None:
    device = world.driver.open()
    world.bus.garbage = garbage
    begin = monotonic()
    with pytest.raises(DeviceError):
        device.read()
    assert monotonic() - begin < READING
    device.close()
    with pytest.raises(DeviceError):
        world.driver.open()
    assert world.bus.open == 0
    world.bus.garbage = ""
    assert matches(world.driver.open().read(), world)


@pytest.mark.parametrize("world", ON_BUS_SENSORS, indirect=True)
def test_sensor_makes_no_nonsense_of_noise(world: World) -> None:
    device = world.driver.open()
    world.bus.garbage = "noise"
    refused = 0
    for _ in range(12):
        try:
            assert sensible(world, device.read())
        except DeviceError:
            refused += 1
    assert refused > 6


@pytest.mark.parametrize("world", ON_BUS_SENSORS, indirect=True)
def test_sensor_goes_on_when_some_transfers_fail(world: World) -> None:
    device = world.driver.open()
    world.bus.failing, worked = 0.2, 0
    for _ in range(8):
        try:
            worked += matches(device.read(), world)
        except DeviceError:
            continue
    assert worked > 3


@actuators
def test_what_an_actuator_is_told_is_done(world: World) -> None:
    device = world.driver.open()
    for value in VALUES:
        begin = monotonic()
        device.write(value)
        assert monotonic() - begin < WRITING
        assert world.state(device) == pytest.approx(world.meant(value), abs=world.within)
    device.close()
    device.close()


@actuators
def test_what_is_no_command_is_not_sent(world: World) -> None:
    device = world.driver.open()
    device.write(0.75)
    before = world.bus.sent if world.bus else 0
    for value in REFUSED:
        with pytest.raises(DeviceError, match="was not sent"):
            device.write(value)
    assert world.state(device) == pytest.approx(world.meant(0.75), abs=world.within)
    assert (world.bus.sent if world.bus else 0) == before


@pytest.mark.parametrize("world", ON_BUS_ACTUATORS, indirect=True)
@pytest.mark.parametrize("hang", [0.0, 0.11])
def test_an_actuator_that_fails_says_so_in_time(world: World, hang: float) -> None:
    device = world.driver.open()
    device.write(0.75)
    world.bus.failing, world.bus.hang = 1.0, hang
    for _ in range(2):
        begin = monotonic()
        with pytest.raises(DeviceError):
            device.write(0.5)
        assert monotonic() - begin < WRITING
    world.bus.failing = world.bus.hang = 0.0
    device.write(0.5)
    assert world.state(device) == pytest.approx(world.meant(0.5), abs=world.within)
    world.bus.failing, world.bus.hang = 1.0, hang
    device.close()
    assert world.bus.open == 0
    with pytest.raises(DeviceError):
        device.write(0.5)


@pytest.mark.parametrize("world", ON_BUS_ACTUATORS, indirect=True)
def test_an_actuator_on_a_dead_bus_cannot_be_opened(world: World) -> None:
    world.bus.failing = 1.0
    with pytest.raises(DeviceError) as caught:
        world.driver.open()
    assert caught.value.hint
    assert world.bus.open == 0


@pytest.mark.parametrize("world", ON_BUS_ACTUATORS, indirect=True)
def test_an_actuator_goes_on_when_half_of_the_transfers_fail(world: World) -> None:
    device = world.driver.open()
    world.bus.failing, worked = 0.5, 0
    for value in VALUES * 2:
        try:
            device.write(value)
        except DeviceError:
            continue
        worked += 1
        assert world.state(device) == pytest.approx(world.meant(value), abs=world.within)
    assert worked > 4
