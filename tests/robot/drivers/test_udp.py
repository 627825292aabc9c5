"""Signals by UDP: the last that another robot has said, whatever is lost, late, damaged or one's own."""

import socket

import pytest
from mindrun.driver import DeviceError
from mindrun.robot.drivers import udp
from mindrun.robot.drivers.udp import UdpActuator, UdpSensor, packet

HERE = "127.0.0.1"


@pytest.fixture
def port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind((HERE, 0))
        return int(free.getsockname()[1])


def test_a_robot_hears_what_another_said_last_until_it_is_silent(port: int, monkeypatch: pytest.MonkeyPatch) -> None:
    now = [100.0]
    monkeypatch.setattr(udp, "monotonic", lambda: now[0])
    ears = UdpSensor("left", port, lasts=0.5).open()
    assert ears.read() == (0.0,)
    other, third, own = (UdpActuator(name, port, HERE).open() for name in ("right", "third", "left"))
    own.write(1.0)
    assert ears.read() == (0.0,)
    other.write(0.25)
    other.write(0.75)
    assert ears.read() == (0.75,)
    now[0] += 0.3  # nothing comes, as where datagrams are lost
    assert ears.read() == (0.75,)
    third.write(0.5)
    assert ears.read() == (0.5,)
    now[0] += 0.3
    assert ears.read() == (0.5,)
    now[0] += 0.3
    assert ears.read() == (0.0,)
    UdpActuator("right", port, HERE).open().write(0.125)  # it began anew, with small numbers
    assert ears.read() == (0.125,)
    for device in (ears, other, third, own):
        device.close()


@pytest.mark.parametrize(
    "data",
    [
        b"", b"x" * 999, b"mind signal a 1 2.0", b"mind signal a 1 nan", b"mind signal a 1", b"mind signal \xff 1 0.5",
        b"mind signal a x 0.5", packet("right", 1, 0.9), b"mind signal a 1 -0.5",
    ],
)  # fmt: skip
def test_what_is_damaged_late_or_a_strangers_is_not_heard(port: int, data: bytes) -> None:
    ears = UdpSensor("left", port, lasts=60.0).open()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        for each in (packet("right", 2, 0.25), data):
            sender.sendto(each, (HERE, port))
    assert ears.read() == (0.25,)
    ears.close()


def test_no_network_is_no_fault_and_no_port_is_one(port: int) -> None:
    away = UdpActuator("left", port, "203.0.113.1").open()
    away.write(0.5)  # whoever it goes to
    with pytest.raises(DeviceError, match="between 0 and 1"):
        away.write(1.5)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("", port))
        with pytest.raises(DeviceError, match=f"udp port {port}"):
            UdpSensor("left", port).open()
