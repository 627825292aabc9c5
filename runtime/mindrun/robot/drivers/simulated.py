"""Sensors and actuators of a simulated world, which is another process: see `mindrun.robot.simulated_world`."""

import json
import socket as sockets  # AF_UNIX by its name: there is none on Windows, where every driver is known all the same
from dataclasses import dataclass, field
from math import isnan
from pathlib import Path
from struct import Struct, unpack
from time import monotonic
from typing import Annotated, Any

from mindrun.driver import DeviceError
from mindrun.graph.graph import Graph
from mindrun.graph.named_readings import physical
from mindrun.graph.wiring import ActuatorWire, SensorWire, Wiring, read_by
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import COUNT, Reference
from mindrun.robot.simulated_world.protocol import ANSWER, READ, REQUEST, STATUS, WRITE

EXCHANGE_SECONDS = 0.2  # seconds for a whole exchange
TEXT = Reference("text")
VALUE = Struct("<d")

_seen: set[str] = set()  # the sockets of worlds that have answered this process


@dataclass(slots=True)
class WorldConnection:
    """A connection to a simulated world. One that has failed is made anew: what comes late answers nothing."""

    path: str
    closed: bool = False
    _socket: sockets.socket | None = field(default=None, repr=False)

    def ask(self, what: bytes, name: str = "", value: float = 0.0) -> bytes:
        """What the world answers; DeviceError where it refuses, or has not answered in time."""
        if self.closed:
            raise DeviceError("the connection to the simulated world is closed")
        try:
            done, held = self._exchange(what, name.encode(), value, monotonic() + EXCHANGE_SECONDS)
        except OSError as error:
            self._drop()
            why = error.strerror or error
            raise DeviceError(f"the simulated world at {self.path} does not answer: {why}") from error
        if not done:
            raise DeviceError(f"in the simulated world, {held.decode(errors='replace')}")
        return held

    def close(self) -> None:
        """Let go of the world; never raises."""
        self.closed = True
        self._drop()

    def _exchange(self, what: bytes, name: bytes, value: float, until: float) -> tuple[bool, bytes]:
        if self._socket is None:
            self._socket = sockets.socket(sockets.AF_UNIX, sockets.SOCK_STREAM)
            self._socket.settimeout(EXCHANGE_SECONDS)
            self._socket.connect(self.path)
        self._socket.settimeout(max(until - monotonic(), 0.001))
        self._socket.sendall(REQUEST.pack(what, len(name), value) + name)
        done, length, _ = ANSWER.unpack(_received(self._socket, ANSWER.size, until))
        return done, _received(self._socket, length, until)

    def _drop(self) -> None:
        if self._socket is not None:
            self._socket.close()
            self._socket = None


def _received(connection: sockets.socket, count: int, until: float) -> bytes:
    """The next `count` bytes of a connection, which have come by the time `until`."""
    data = b""
    while len(data) < count:
        left = until - monotonic()
        if left <= 0:
            raise TimeoutError("timed out")
        connection.settimeout(left)
        part = connection.recv(count - len(data))
        if not part:
            raise ConnectionError("it has hung up")
        data += part
    return data


@dataclass(frozen=True, slots=True)
class SimulatedSensorDevice:
    """A sensor of a simulated world."""

    link: WorldConnection
    sensor: str
    count: int

    def read(self) -> tuple[float | None, ...]:
        """The sensor's readings in this tick, rough as the mind declares them; None where no skill there reads it."""
        held = self.link.ask(READ, self.sensor)
        if len(held) != VALUE.size * self.count:
            raise DeviceError(f"{self.sensor} has {len(held) // VALUE.size} readings there, not {self.count}")
        return tuple(None if isnan(reading) else reading for reading in unpack(f"<{self.count}d", held))

    def close(self) -> None:
        """Let go of the world."""
        self.link.close()


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
        """Let go of the world."""
        self.link.close()


@kind("sensor driver", "simulated")
@dataclass(frozen=True, slots=True)
class SimulatedSensor:
    """A `sensor` of the simulated world at a `socket`, which has `count` readings."""

    socket: Annotated[str, TEXT]
    sensor: Annotated[str, TEXT]
    count: Annotated[int, COUNT] = 1

    unit = ""
    usual = (0.0, 1.0)

    @property
    def readings(self) -> int:
        """How many values it reads."""
        return self.count

    def open(self) -> SimulatedSensorDevice:
        """The sensor; DeviceError where the world has none such."""
        device = SimulatedSensorDevice(WorldConnection(self.socket), self.sensor, self.count)
        try:
            device.read()
        except DeviceError:
            device.close()
            raise
        return device


@kind("actuator driver", "simulated")
@dataclass(frozen=True, slots=True)
class SimulatedActuator:
    """An `actuator` of the simulated world at a `socket`."""

    socket: Annotated[str, TEXT]
    actuator: Annotated[str, TEXT]

    @property
    def device(self) -> str:
        """What only one process may drive."""
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


def status(path: str) -> dict[str, Any]:
    """How the world at a socket stands: `tick`, `pose`, `events`, `ended` and more (`SimulatedScene.status`)."""
    link = WorldConnection(path)
    try:
        found: dict[str, Any] = json.loads(link.ask(STATUS))
        return found
    finally:
        link.close()


def dry(graph: Graph, path: str, master: str) -> Wiring:
    """A robot whose actuators, and the sensors that are read below the master, are those of the world at a socket.

    Each sensor is read twice a tick, so that what the loop sees is never much more than half a tick older than in
    training.
    """
    read = read_by(graph, master)
    rate = min(max(2 / graph.tick, 0.01), 1000.0)
    max_age = min(max(0.25, 5 * graph.tick), 3600.0)  # a computer that simulates has other things to do, too
    return Wiring(
        robot="simulated",
        sensors=tuple(
            SensorWire(name, SimulatedSensor(path, name, sensor.width), 0.0, 1.0, rate=rate, max_age=max_age)
            for name, sensor in physical(graph).items()
            if name in read
        ),
        actuators=tuple(
            ActuatorWire(actuator.name, SimulatedActuator(path, actuator.name)) for actuator in graph.actuators
        ),
    )
