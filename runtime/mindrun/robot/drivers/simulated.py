"""Sensors and actuators of a simulated world, which is another process: see `mindrun.robot.simulated_world`."""

from dataclasses import dataclass
from math import isnan
from pathlib import Path
from struct import Struct, unpack
from typing import Annotated

from mindrun.driver import DeviceError
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import COUNT
from mindrun.robot.driver_support import TEXT, OpenSensor, measuring
from mindrun.robot.simulated_world import READ, WRITE, WorldConnection, status

VALUE = Struct("<d")

_seen: set[str] = set()  # the sockets of worlds that have answered this process


@dataclass(frozen=True, slots=True)
class SimulatedActuatorDevice:
    """An actuator of a simulated world, which keeps the last command."""

    link: WorldConnection
    actuator: str

    def write(self, value: float) -> None:
        """The command from the next tick on; where the world has been cleared away, nothing moves any more."""
        try:
            self.link.ask(WRITE, self.actuator, value)
        except DeviceError:
            if Path(self.link.path).exists():
                raise

    def close(self) -> None:
        self.link.close()


@kind("sensor driver", "simulated")
class SimulatedSensor:
    """A `sensor` of the simulated world at a `socket`, which has `count` readings."""

    socket: Annotated[str, TEXT]
    sensor: Annotated[str, TEXT]
    count: Annotated[int, COUNT] = 1

    unit = ""
    usual = (0.0, 1.0)

    @property
    def readings(self) -> int:
        return self.count

    def open(self) -> OpenSensor:
        """The sensor; DeviceError where the world has none such."""
        link = WorldConnection(self.socket)
        return measuring(lambda: self.values(link), link.close)

    def values(self, link: WorldConnection) -> tuple[float | None, ...]:
        """The sensor's readings in this tick, rough as the mind declares them; None where no skill there reads it."""
        held = link.ask(READ, self.sensor)
        if len(held) != VALUE.size * self.count:
            raise DeviceError(f"{self.sensor} has {len(held) // VALUE.size} readings there, not {self.count}")
        return tuple(None if isnan(reading) else reading for reading in unpack(f"<{self.count}d", held))


@kind("actuator driver", "simulated")
class SimulatedActuator:
    """An `actuator` of the simulated world at a `socket`."""

    socket: Annotated[str, TEXT]
    actuator: Annotated[str, TEXT]

    @property
    def device(self) -> str:
        return f"{self.socket} {self.actuator}"

    def open(self) -> SimulatedActuatorDevice:
        """The actuator, which does not move until it is commanded; DeviceError where the world has none such.

        It is there, too, where that world has been cleared away meanwhile: then nothing moves any more.
        """
        if not (self.socket in _seen and not Path(self.socket).exists()):
            if self.actuator not in status(self.socket)["commands"]:
                raise DeviceError(f"in the simulated world, there is no actuator {self.actuator}")
            _seen.add(self.socket)
        return SimulatedActuatorDevice(WorldConnection(self.socket), self.actuator)
