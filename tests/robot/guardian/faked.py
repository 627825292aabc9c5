"""A guardian without threads, devices or time: a test is all three."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from unittest.mock import patch

from mindrun.driver import DeviceError
from mindrun.robot.guardian.messages import pack
from mindrun.robot.guardian.plan import Channel, Plan
from mindrun.robot.guardian.process import Process

TICK = 0.05


@dataclass(slots=True)
class Device:
    """Takes what it is told, unless it `fails`, and keeps all of it."""

    fails: bool = False
    written: list[float] = field(default_factory=list)

    def open(self) -> "Device":
        """It, whenever it is opened."""
        return self

    def write(self, value: float) -> None:
        """One more."""
        if self.fails:
            raise DeviceError("no answer")
        self.written.append(value)

    def close(self) -> None:
        """Nothing."""


@dataclass(frozen=True, slots=True)
class Driver:
    """Opens the device that it was given."""

    device: Device

    def open(self) -> Device:
        """That device."""
        return self.device.open()


@dataclass(slots=True)
class Faked:
    """A process, its devices, what it says, and the time."""

    process: Process
    devices: tuple[Device, ...]
    said: list[str]
    now: list[float]
    number: int = 0

    def frame(self, *commands: float, armed: bool = True, age: float = 0.0) -> None:
        """A frame comes, and the devices do what follows."""
        self.bytes(pack(self.number, round((self.now[0] - age) * 1e9), armed, commands))
        self.number += 1

    def bytes(self, data: bytes) -> None:
        """Bytes come, and the devices do what follows."""
        self.process.step(data)
        self.write()

    def wait(self, seconds: float) -> None:
        """Time passes."""
        self.now[0] += seconds
        self.process.step(None)
        self.write()

    def write(self) -> None:
        """Each device has one more chance."""
        for output in self.process.outputs:
            output.attempt()

    @property
    def last(self) -> list[float]:
        """What each device was told last."""
        return [device.written[-1] for device in self.devices]

    @property
    def state(self) -> str:
        """That of the guard."""
        return self.process.guard.state


@contextmanager
def faked(*channels: Channel, devices: tuple[Device, ...] = ()) -> Iterator[Faked]:
    """A guardian of such actuators with these devices, or new ones, at neutral."""
    devices = devices or tuple(Device() for _ in channels)
    plan = Plan(TICK, tuple(replace(c, driver=Driver(d)) for c, d in zip(channels, devices, strict=True)))
    said: list[str] = []
    now = [100.0]
    with patch("mindrun.robot.guardian.process.Thread"):
        process = Process(plan, -1, said.append, said.append, clock=lambda: now[0])
        try:
            assert process.open() == []
            found = Faked(process, devices, said, now)
            found.write()
            yield found
        finally:
            for each in (process._woken, process.wake):
                os.close(each)
