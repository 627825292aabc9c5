"""For every driver: a fake of its part, what it must read there, and how to break it."""

import socket
from collections.abc import Callable
from dataclasses import dataclass, field
from math import inf
from typing import Any

import pytest
from mindrun.robot import camera, driver_support, i2c
from mindrun.robot.camera import focal_length
from mindrun.robot.drivers import ball_tracker as tracking
from mindrun.robot.drivers import grove_motor as motors
from mindrun.robot.drivers.ads1115 import Ads1115
from mindrun.robot.drivers.ball_eye import BallEye
from mindrun.robot.drivers.ball_tracker import BallTracker
from mindrun.robot.drivers.digital_inputs import Bumper, LineSensor, Switch
from mindrun.robot.drivers.encoder import Encoder
from mindrun.robot.drivers.grove_motor import GroveMotor
from mindrun.robot.drivers.grove_ultrasonic import GroveUltrasonic
from mindrun.robot.drivers.h_bridge import HBridge
from mindrun.robot.drivers.lamp import Lamp
from mindrun.robot.drivers.lsm9ds1 import MagneticCompass, Motion, Turn
from mindrun.robot.drivers.mcp3008 import Mcp3008
from mindrun.robot.drivers.mock import MockActuator, MockSensor
from mindrun.robot.drivers.mpu6050 import Mpu6050
from mindrun.robot.drivers.own import KIND as OWN_KIND
from mindrun.robot.drivers.own import OwnActuator, OwnSensor, of_file
from mindrun.robot.drivers.pca9685 import Pca9685
from mindrun.robot.drivers.servo import PinServo
from mindrun.robot.drivers.udp import UdpActuator, UdpSensor
from mindrun.robot.drivers.ultrasonic import Ultrasonic
from mindrun.robot.drivers.vl53l0x import Vl53l0x

from tests.robot.drivers import frames
from tests.robot.drivers.echoes import ring
from tests.robot.drivers.fakes import (
    FakeAds1115,
    FakeBus,
    FakeGroveMotor,
    FakeGrovePi,
    FakeLsm9ds1,
    FakeMpu6050,
    FakePca9685,
    FakeVl53l0x,
)
from tests.robot.drivers.pins import FakeMcp3008, break_pins, mock_pins, pulsing_pins


@dataclass
class World:
    """A driver on fakes: what it reads (`within` so much), or what its part does (`state`) for a command."""

    driver: Any
    expected: tuple[float | None, ...] = ()
    within: float = 0.0
    state: Callable[[Any], float | None] = lambda device: None
    meant: Callable[[float], float] = lambda value: value
    bus: FakeBus | None = None
    fail: Callable[[], None] | None = None
    parts: list[Any] = field(default_factory=list)


def on_bus(patch: pytest.MonkeyPatch, address: int, part: Any, **world: Any) -> World:
    """A part on a bus of its own."""
    bus = FakeBus({address: part})

    def open_bus(number: int) -> FakeBus:
        assert number == 1
        bus.open += 1
        return bus

    patch.setattr(i2c, "open_bus", open_bus)
    return World(bus=bus, parts=[part], fail=lambda: setattr(bus, "failing", 1.0), **world)


def mock_sensor(patch: pytest.MonkeyPatch) -> World:
    return World(MockSensor(0.3, 2), (0.3, 0.3))


def udp_actuator(patch: pytest.MonkeyPatch) -> World:
    port = 47901  # where it is heard
    heard = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    heard.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    heard.bind(("127.0.0.1", port))
    return World(
        UdpActuator("me", port, "127.0.0.1"), state=lambda device: float(heard.recv(99).split()[-1]), parts=[heard]
    )


def ultrasonic(patch: pytest.MonkeyPatch) -> World:
    triggers, echoes, log = (5, 6, 13, 19, 26), (16, 17, 20, 21, 22), []
    pins = ring(mock_pins(patch), triggers, echoes, log)
    for pin, metres in zip(pins, (0.03, 0.2, None, 0.5, 0.6), strict=True):
        pin.metres = metres
    world = World(Ultrasonic(triggers, echoes, range=0.55), (0.03, 0.2, None, 0.5, None), 1e-3, parts=[pins, log])
    world.fail = lambda: setattr(pins[3], "fault", "silent")
    return world


def grove_ultrasonic(patch: pytest.MonkeyPatch) -> World:
    part = FakeGrovePi({4: 35, 3: 520})
    return on_bus(patch, 0x04, part, driver=GroveUltrasonic((4, 3)), expected=(0.35, None), within=0.001)


def ads1115(patch: pytest.MonkeyPatch) -> World:
    return on_bus(patch, 0x48, FakeAds1115(7.4 / 3.13), driver=Ads1115(), expected=(7.4,), within=0.001)


def motion(patch: pytest.MonkeyPatch) -> World:
    part = FakeLsm9ds1(0x68, 0x20, 0x17, 0x01, 0x28)
    part.vector = (300.0, -200.0, 16390.0)
    return on_bus(patch, 0x6B, part, driver=Motion(), expected=(0.0,), within=0.03)


def turn(patch: pytest.MonkeyPatch) -> World:
    part = FakeLsm9ds1(0x68, 0x10, 0x17, 0x02, 0x18)
    part.vector = (10.0, -20.0, 90 / 8.75e-3)
    return on_bus(patch, 0x6B, part, driver=Turn(), expected=(90.0,), within=0.5)


def compass(patch: pytest.MonkeyPatch) -> World:
    part = FakeLsm9ds1(0x3D, 0x22, 0x27, 0x08, 0xA8)
    part.vector = (200 / 0.14, 200 / 0.14, -400 / 0.14)
    return on_bus(patch, 0x1E, part, driver=MagneticCompass(), expected=(45.0,), within=1.5)


def switch(patch: pytest.MonkeyPatch) -> World:
    return World(Switch(17), (0.0,), parts=[mock_pins(patch).pin(17)], fail=lambda: break_pins(patch))


def bumper(patch: pytest.MonkeyPatch) -> World:
    factory = mock_pins(patch)
    world = World(Bumper((5, 6, 13), "down"), (0.0, 1.0, 0.0), fail=lambda: break_pins(patch))
    open_driver = Bumper.open

    def opened(driver: Bumper) -> Any:
        device = open_driver(driver)
        factory.pin(6).drive_high()
        return device

    patch.setattr(Bumper, "open", opened)
    return world


def line_sensor(patch: pytest.MonkeyPatch) -> World:
    factory = mock_pins(patch)
    for pin, level in ((20, 1), (21, 0)):
        factory.pin(pin).drive_high() if level else factory.pin(pin).drive_low()
    return World(LineSensor((20, 21), inverted=True), (0.0, 1.0), fail=lambda: break_pins(patch))


def encoder(patch: pytest.MonkeyPatch) -> World:
    mock_pins(patch)
    return World(Encoder(17, 27, steps=20), (0.0,), fail=lambda: break_pins(patch))


def mcp3008(patch: pytest.MonkeyPatch) -> World:
    mock_pins(patch)
    part = FakeMcp3008({0: 1.1, 3: 3.3})
    return World(Mcp3008((3, 0)), (1.0, 1 / 3), 0.002, parts=[part], fail=lambda: break_pins(patch))


def vl53l0x(patch: pytest.MonkeyPatch) -> World:
    return on_bus(patch, 0x29, FakeVl53l0x(0.42), driver=Vl53l0x(), expected=(0.42,), within=1e-9)


def mpu6050(patch: pytest.MonkeyPatch) -> World:
    part = FakeMpu6050(-90.0)
    return on_bus(patch, 0x68, part, driver=Mpu6050("down", still=1.0), expected=(89.0,), within=0.05)


def filmed(patch: pytest.MonkeyPatch, driver: Any, expected: tuple[float | None, ...], within: float) -> World:
    """A camera that sees a ball 12 degrees to the left."""
    x = frames.column(12.0)
    fake = frames.FakeCamera(lambda count: frames.taken(frames.ball(frames.room(), x, 100, 25), seed=count))
    patch.setattr(camera, "open_camera", lambda path, width, height: fake)
    patch.setattr(tracking, "cameras", driver_support.SharedParts())
    return World(driver, expected, within, parts=[fake], fail=fake.stopped.set)


def ball_tracker(patch: pytest.MonkeyPatch) -> World:
    return filmed(patch, BallTracker(), (12.0,), 0.5)


def ball_eye(patch: pytest.MonkeyPatch) -> World:
    metres = 0.1 * focal_length(320, 60.0) / 25 - 0.05
    return filmed(patch, BallEye((-12.0, 0.0, 12.0)), (None, None, metres), 0.05)


def mock_actuator(patch: pytest.MonkeyPatch) -> World:
    return World(MockActuator(), state=lambda device: device.value)


OWN = """
from dataclasses import dataclass, field

@dataclass
class Device:
    value: float = 0.0

    def read(self):
        return (0.25, None)

    def write(self, value):
        self.value = value

    def close(self):
        raise RuntimeError("closing must never raise")

@dataclass(frozen=True)
class Driver:
    def open(self):
        return Device()
"""


def own_sensor(patch: pytest.MonkeyPatch) -> World:
    text = OWN.replace('raise RuntimeError("closing must never raise")', "pass")
    code = of_file("own.Driver", text)
    facts = {"unit": "m", "readings": 2, "usual": (0.0, 1.0), "possible": (0.0, 9.0), "near": 0.0, "device": ""}
    return World(OwnSensor(code.name, code.digest, code.lines, "", "{}", **facts), (0.25, None))


def own_actuator(patch: pytest.MonkeyPatch) -> World:
    code = of_file("own.Driver", OWN)
    driver = OwnActuator(code.name, code.digest, code.lines, "", "{}", device="")
    return World(driver, state=lambda device: device.device.value)


def lamp(patch: pytest.MonkeyPatch) -> World:
    pin = pulsing_pins(patch).pin(18)
    return World(Lamp(18), state=lambda device: pin.state)


def servo(patch: pytest.MonkeyPatch) -> World:
    pin = pulsing_pins(patch).pin(12)
    driver = PinServo(12, shortest=600.0, longest=2400.0)
    return World(driver, state=lambda device: pin.state * 20_000, meant=lambda v: 600 + 1800 * v, within=1e-6)


def h_bridge(patch: pytest.MonkeyPatch) -> World:
    factory = pulsing_pins(patch)
    ahead, back, enable = (factory.pin(number) for number in (5, 6, 13))
    return World(
        HBridge(5, 6, 13),
        state=lambda device: (ahead.state - back.state) * enable.state,
        meant=lambda v: 2 * v - 1,
        within=1e-9,
    )


def pca9685(patch: pytest.MonkeyPatch) -> World:
    part = FakePca9685()
    driver = Pca9685(channel=3, shortest=600.0, longest=2400.0)
    return on_bus(
        patch, 0x40, part, driver=driver, state=lambda device: part.pulse(3), meant=lambda v: 600 + 1800 * v, within=2.5
    )


def grove_motor(patch: pytest.MonkeyPatch) -> World:
    part = FakeGroveMotor()
    patch.setattr(motors, "boards", driver_support.SharedParts())
    return on_bus(
        patch,
        0x0F,
        part,
        driver=GroveMotor(motor=2),
        state=lambda device: part.turning(1),
        meant=lambda v: 255 * (2 * v - 1),
        within=0.51,
    )


SENSORS: dict[str, Callable[[pytest.MonkeyPatch], World]] = {
    "mock": mock_sensor,
    "ultrasonic": ultrasonic,
    "grove_ultrasonic": grove_ultrasonic,
    "ads1115": ads1115,
    "lsm9ds1_motion": motion,
    "lsm9ds1_turn": turn,
    "lsm9ds1_compass": compass,
    "switch": switch,
    "bumper": bumper,
    "line_sensor": line_sensor,
    "encoder": encoder,
    "mcp3008": mcp3008,
    "vl53l0x": vl53l0x,
    "mpu6050": mpu6050,
    "ball_tracker": ball_tracker,
    "ball_eye": ball_eye,
    "udp": lambda patch: World(UdpSensor("me", 47900), (0.0,)),  # tests/robot/drivers/test_udp.py: nobody speaks here
    OWN_KIND: own_sensor,
}
ACTUATORS: dict[str, Callable[[pytest.MonkeyPatch], World]] = {
    "mock": mock_actuator,
    "lamp": lamp,
    "udp": udp_actuator,
    "servo": servo,
    "h_bridge": h_bridge,
    OWN_KIND: own_actuator,
    "pca9685": pca9685,
    "grove_motor": grove_motor,
}
ANYTHING = (-inf, inf)
