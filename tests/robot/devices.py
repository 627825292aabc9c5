"""Devices of the `simulated` drivers that are this process: they keep who told them what, and when."""

import json
import os
import socket
import struct
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from threading import Thread

from mindrun.graph.wiring import ActuatorWire, SensorWire, Wiring
from mindrun.robot.drivers.simulated import VALUE, SimulatedActuator, SimulatedSensor
from mindrun.robot.simulated_world import ANSWER, READ, REQUEST, STATUS, WRITE

PEER = struct.Struct("3i")


@dataclass(frozen=True, slots=True)
class Told:
    """What an actuator was told, by which process, and when."""

    time: float
    process: int
    actuator: str
    value: float

    def neutral(self, neutrals: dict[str, float]) -> bool:
        """Whether that was neutral."""
        return self.value == neutrals[self.actuator]


@dataclass(slots=True)
class Devices:
    """A sensor that reads 0.6, and actuators with their neutral."""

    path: str
    neutrals: dict[str, float]
    told: list[Told] = field(default_factory=list)

    def wiring(self, name: str) -> Wiring:
        """A robot that is wired to them."""
        sensor = SensorWire("sense", SimulatedSensor(self.path, "sense"), 0.0, 1.0)
        ends = (ActuatorWire(actuator, SimulatedActuator(self.path, actuator)) for actuator in self.neutrals)
        return Wiring(name, (sensor,), tuple(ends))

    @property
    def at_rest(self) -> bool:
        """Whether each was told neutral last, or nothing at all."""
        last = {told.actuator: told for told in self.told}
        return all(told.neutral(self.neutrals) for told in last.values())

    @property
    def drivers(self) -> list[int]:
        """The processes that moved something, in the order in which they did; one that did so again stands twice."""
        moves = [told.process for told in list(self.told) if not told.neutral(self.neutrals)]
        return [one for number, one in enumerate(moves) if not number or moves[number - 1] != one]

    def answer(self, client: socket.socket) -> None:
        """Answer who has connected, until it goes."""
        process = PEER.unpack(client.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, PEER.size))[0]
        with client, client.makefile("rb") as said, suppress(OSError):
            while len(head := said.read(REQUEST.size)) == REQUEST.size:
                what, length, value = REQUEST.unpack(head)
                held = self.held(what, said.read(length).decode(), value, process)
                client.sendall(ANSWER.pack(True, len(held)) + held)

    def held(self, what: bytes, name: str, value: float, process: int) -> bytes:
        """What an answer holds."""
        match what:
            case _ if what == READ:
                return VALUE.pack(0.6)
            case _ if what == WRITE:
                self.told.append(Told(time.monotonic(), process, name, value))
            case _ if what == STATUS:
                return json.dumps({"commands": self.neutrals}).encode()
        return b""


@contextmanager
def devices(folder: Path, neutrals: dict[str, float]) -> Iterator[Devices]:
    """Devices that answer at a socket in this folder."""
    found = Devices(str(folder / "devices"), neutrals)
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind(found.path)
        listener.listen(64)
        Thread(target=_accept, args=(listener, found), daemon=True).start()
        try:
            yield found
        finally:
            with suppress(OSError):
                listener.shutdown(socket.SHUT_RDWR)
            os.unlink(found.path)  # noqa: PTH108


def _accept(listener: socket.socket, found: Devices) -> None:
    with suppress(OSError):
        while True:
            client, _ = listener.accept()
            Thread(target=found.answer, args=(client,), daemon=True).start()
