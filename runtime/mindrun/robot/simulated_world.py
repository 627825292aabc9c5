"""A simulated world at real time, as its clients have it: a process of its own, and a connection to its socket.

It is a process because the controller opens the sensors and the guardian the actuators. An exchange is a REQUEST with a
name, then an ANSWER with what it holds. READ a sensor: its readings, float64. WRITE an actuator, an order or a memory:
nothing, it has the value now. STATUS: JSON. WORLD: the row of a recording after the last tick (`world_row_of`). BOXES:
the obstacles [boxes, 4], float64. Where one is refused, the reason.
"""

import json
import socket as sockets  # AF_UNIX by its name: there is none on Windows, where every driver is known all the same
import subprocess
import sys
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from struct import Struct
from tempfile import TemporaryDirectory
from typing import Any, BinaryIO

from mindrun.driver import DeviceError
from mindrun.errors import MindError

READ, WRITE, STATUS, WORLD, BOXES = b"R", b"W", b"S", b"T", b"B"
REQUEST = Struct("<cHd")  # what, length of the name, value; then the name in UTF-8
ANSWER = Struct("<?I")  # whether it was done, length of what it holds
EXCHANGE_SECONDS = 0.2  # seconds in which a world has to take a request, or to answer
NEUTRAL_SECONDS = 2.0  # that the guardian has to bring a robot to neutral whose controller is gone


@dataclass(slots=True)
class WorldConnection:
    """A connection to a simulated world. One that has failed is made anew: what comes late answers nothing."""

    path: str
    closed: bool = False
    _socket: sockets.socket | None = field(default=None, repr=False)

    def ask(self, what: bytes, name: str = "", value: float = 0.0) -> bytes:
        """The world's answer to a request; DeviceError where it refuses, or has not answered in time."""
        if self.closed:
            raise DeviceError("the connection to the simulated world is closed")
        try:
            done, held = self._exchange(what, name.encode(), value)
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

    def _exchange(self, what: bytes, name: bytes, value: float) -> tuple[bool, bytes]:
        if self._socket is None:
            self._socket = sockets.socket(sockets.AF_UNIX, sockets.SOCK_STREAM)
            self._socket.settimeout(EXCHANGE_SECONDS)
            self._socket.connect(self.path)
        self._socket.settimeout(EXCHANGE_SECONDS)
        self._socket.sendall(REQUEST.pack(what, len(name), value) + name)
        with self._socket.makefile("rb") as answers:
            done, length = ANSWER.unpack(_whole(answers, ANSWER.size))
            return done, _whole(answers, length)

    def _drop(self) -> None:
        if self._socket is not None:
            self._socket.close()
            self._socket = None


def _whole(answers: BinaryIO, count: int) -> bytes:
    if len(data := answers.read(count)) < count:
        raise ConnectionError("it has hung up")
    return data


def status(path: str) -> dict[str, Any]:
    """The state of the world at a socket: `tick`, `pose`, `events`, `ended` and more (`SimulatedScene.status`)."""
    with closing(WorldConnection(path)) as link:
        found: dict[str, Any] = json.loads(link.ask(STATUS))
    return found


@contextmanager
def simulated(bundle: Path, task: str, seed: int, master: str = "") -> Iterator[str]:
    """The socket of a world that lives in a process of its own for as long as this lasts; MindError if it cannot.

    Where numba has to compile first, that takes a minute. The world also ends with the thread that called this.
    """
    with TemporaryDirectory(prefix="mind-") as folder:
        path = f"{folder}/world"
        # -P: a file of the user's folder that is named like a module must not be imported.
        program = [sys.executable, "-P", "-m", "mindrun.robot.world_server"]
        program += [str(bundle), task, str(seed), master, path]
        # A session of its own: Ctrl-C ends the robot, and the guardian still finds the wheels that it stops.
        with subprocess.Popen(program, stdout=subprocess.PIPE, text=True, start_new_session=True) as process:
            assert process.stdout
            try:
                said = process.stdout.readline().strip()
                if said != "ready":
                    raise MindError(said or "the simulated world ended before it was ready")
                yield path
            finally:
                process.terminate()
                try:
                    process.wait(2 * NEUTRAL_SECONDS)
                except subprocess.TimeoutExpired:
                    process.kill()
