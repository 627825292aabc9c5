"""What a robot needs: nothing until a part is opened, then the line that installs it; and what goes over a real bus."""

import subprocess
import sys
from types import SimpleNamespace

import pytest
from mindrun.driver import DeviceError
from mindrun.robot import i2c
from mindrun.robot.drivers.digital_inputs import Switch

WITHOUT = """
import sys
for name in ("cv2", "smbus2", "gpiozero", "lgpio", "RPi"):
    sys.modules[name] = None
import mindrun.robot.drivers
from mindrun.kinds.registry import kinds
from mindrun.driver import DeviceError
needed = {"ultrasonic": {"trigger": (5,), "echo": (6,)}, "grove_ultrasonic": {"ports": (4,)}, "switch": {"pin": 5},
    "pca9685": {"channel": 0}, "grove_motor": {"motor": 1}, "bumper": {"pins": (5,)}, "line_sensor": {"pins": (5,)},
    "encoder": {"a": 5, "b": 6, "steps": 20}, "mcp3008": {"inputs": (0,)}, "ball_eye": {"angles": (0.0,)},
    "lamp": {"pin": 5}, "servo": {"pin": 5}, "h_bridge": {"forward": 5, "backward": 6}}
for noun in ("sensor driver", "actuator driver"):
    for name, driver in kinds(noun).items():
        if name in ("mock", "simulated", "udp", "of one's own"):
            continue
        try:
            driver(**needed.get(name, {})).open()
        except DeviceError as error:
            assert "is not installed" in str(error) and "pip install 'mindrun[robot]'" in error.hint, (name, error)
            print(name)
"""


def test_nothing_is_needed_until_it_is_used() -> None:
    done = subprocess.run([sys.executable, "-c", WITHOUT], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert len(done.stdout.split()) == 20


def test_pins_that_nobody_can_drive_say_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    import gpiozero

    def nothing(pin: int, pull_up: bool) -> None:
        raise gpiozero.BadPinFactory("Unable to load any default pin factory!")

    monkeypatch.setattr(gpiozero, "DigitalInputDevice", nothing)
    with pytest.raises(DeviceError, match="GPIO 17 cannot be opened") as caught:
        Switch(17).open()
    assert "python3-lgpio" in caught.value.hint


class Message(list):
    """A message of smbus2."""

    def __bytes__(self) -> bytes:
        return bytes([0x11, 0x22])


def test_a_transfer_is_one_message_each_way(monkeypatch: pytest.MonkeyPatch) -> None:
    log = []
    bus = SimpleNamespace(fd=0, i2c_rdwr=lambda *messages: log.append(messages), close=lambda: log.append("closed"))
    kinds = {kind: lambda *what, kind=kind: Message([kind, *what]) for kind in ("write", "read")}
    message = SimpleNamespace(**kinds)
    monkeypatch.setitem(sys.modules, "smbus2", SimpleNamespace(SMBus=lambda number: bus, i2c_msg=message))
    wire = i2c.I2cDevice("it", 1, 0x40)
    assert wire.read(0x05, 2) == b"\x11\x22"
    wire.write(0x06, 7)
    assert wire.transfer(b"", 2) == b"\x11\x22"
    wire.close()
    wire.close()
    assert log == [
        (["write", 0x40, b"\x05"], ["read", 0x40, 2]),
        (["write", 0x40, b"\x06\x07"],),
        (["read", 0x40, 2],),
        "closed",
    ]


def test_smbus2_is_used_as_it_is() -> None:
    import smbus2

    bus = i2c.Bus(SimpleNamespace(i2c_rdwr=lambda *messages: None), smbus2.i2c_msg)
    assert bus.transfer(0x40, b"\x05", 3) == b"\0\0\0"
    assert bus.transfer(0x40, b"\x05\x01", 0) == b""


def test_a_bus_that_is_off_says_how_to_turn_it_on() -> None:
    with pytest.raises(DeviceError, match="I2C bus 97 cannot be opened") as caught:
        i2c.open_bus(97)
    assert "raspi-config" in caught.value.hint
