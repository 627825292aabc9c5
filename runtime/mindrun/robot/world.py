"""`python -P -m mindrun.robot.world --task T --socket PATH BUNDLE`: a simulated world at real time, behind a socket.

A process of its own, because the controller opens the sensors and the guardian the actuators. It says `ready` on its
standard output, or in one line what is wrong; `mindrun.robot.drivers.simulated` is who talks to it, and how.
"""

import argparse
import ctypes
import json
import os
import signal
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from importlib import import_module
from math import inf, isfinite
from pathlib import Path
from selectors import EVENT_READ, SelectSelector
from socket import AF_UNIX, SOCK_STREAM, socket
from tempfile import TemporaryDirectory
from time import monotonic
from typing import Any, Protocol

from mindrun.errors import MindError
from mindrun.graph import Graph
from mindrun.robot.drivers.simulated import ANSWER, READ, REQUEST, STATUS, WRITE

MAX_CLIENTS = 64
SEED_COUNT = 1 << 64
CHUNK_BYTES = 4096  # of requests that one client may have answered before the others
NEUTRAL_SECONDS = 2.0  # that the guardian has to bring a robot to neutral whose controller is gone
PARENT_DIED = 1  # PR_SET_PDEATHSIG


class World(Protocol):
    """What `mindrun.sim.commanded_world` simulates."""

    graph: Graph
    seed: int

    @property
    def tick(self) -> int: ...

    @property
    def pose(self) -> tuple[float, float, float]: ...

    @property
    def events(self) -> dict[str, int]: ...

    @property
    def ended(self) -> str | None: ...

    def readings(self) -> Any: ...

    def step(self, commands: Sequence[float]) -> None: ...

    def begin(self, seed: int) -> None: ...


class Scene:
    """A world, the command that each actuator holds, and what clients may ask; `again`: runs follow one another."""

    def __init__(self, world: World, again: bool = False) -> None:
        self.world, self.again = world, again
        self.commands = {actuator.name: float(actuator.kind.neutral) for actuator in world.graph.actuators}
        self.past: Counter[str] = Counter()  # what has ended the runs before
        self.missed = 0
        self._places = {s.name: slice(s.start, s.start + s.width) for s in world.graph.sensors}
        self._sense()

    def tick(self) -> None:
        """One tick under the commands that the actuators hold; a world that has ended stands still."""
        self.world.step(list(self.commands.values()))
        if self.again and self.world.ended:
            self.past[self.world.ended] += 1
            self.world.begin((self.world.seed + 1) % SEED_COUNT)
        self._sense()

    def answer(self, what: bytes, name: str, value: float) -> bytes:
        """The answer to a request."""
        if what == STATUS:
            return self._packed(json.dumps(self.status()).encode())
        if what == READ and name in self._places:
            return self._packed(self._readings[self._places[name]].tobytes())
        if what == READ:
            return self._packed(f"there is no sensor {name}".encode(), done=False)
        if name not in self.commands:
            return self._packed(f"there is no actuator {name}".encode(), done=False)
        if not 0.0 <= value <= 1.0:
            return self._packed(f"a command of {value} is not between 0 and 1".encode(), done=False)
        self.commands[name] = value
        return self._packed(b"")

    def status(self) -> dict[str, Any]:
        """How the run stands, and the runs before; `missed` are ticks for which the computer was too slow."""
        world = self.world
        return {
            "seed": world.seed, "tick": world.tick, "pose": world.pose, "events": world.events, "ended": world.ended,
            "commands": self.commands, "past": self.past, "missed": self.missed,
        }  # fmt: skip

    def _sense(self) -> None:
        self._readings, self._time = self.world.readings().astype("<f8"), monotonic()

    def _packed(self, held: bytes, done: bool = True) -> bytes:
        return ANSWER.pack(done, len(held), self._time) + held


class Server:
    """Ticks on time, and answers all clients in between. One that sends nonsense, or does not listen, is cut off."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self._clients: dict[socket, bytearray] = {}  # what of each has not been answered
        self._selector = SelectSelector()  # epoll would wait in whole milliseconds
        self._until = inf

    def end(self, *_signal: object) -> None:
        """Serve only the clients there are, and those not for long."""
        self._until = monotonic() + NEUTRAL_SECONDS

    def serve(self, listener: socket, period: float) -> None:
        """Tick every so many seconds, until the end; a tick that is past is missed, not made up for."""
        listener.setblocking(False)
        self._selector.register(listener, EVENT_READ, self._welcome)
        due = monotonic() + period
        while self._until == inf or (self._clients and monotonic() < self._until):
            for key, _ in self._selector.select(min(max(due - monotonic(), 0.0), 0.1)):
                key.data(key.fileobj)
            late = monotonic() - due
            if late >= 0:
                self.scene.tick()
                missed = int(late / period)
                self.scene.missed += missed
                due += (missed + 1) * period
        for client in list(self._clients):
            self._part(client)

    def _welcome(self, listener: socket) -> None:
        with suppress(OSError):  # it has gone already
            client, _ = listener.accept()
            client.setblocking(False)
            self._clients[client] = bytearray()
            self._selector.register(client, EVENT_READ, self._hear)
            if len(self._clients) > MAX_CLIENTS:
                self._part(client)

    def _hear(self, client: socket) -> None:
        try:
            said = client.recv(CHUNK_BYTES)
            self._clients[client] += said
            answers = b"".join(self.scene.answer(*request) for request in requests(self._clients[client]))
            if not said or client.send(answers) < len(answers):
                self._part(client)
        except (OSError, ValueError):
            self._part(client)

    def _part(self, client: socket) -> None:
        self._selector.unregister(client)
        del self._clients[client]
        client.close()


def requests(buffer: bytearray) -> Iterator[tuple[bytes, str, float]]:
    """The requests that are whole, taken out of the buffer; ValueError for what is none."""
    while len(buffer) >= REQUEST.size:
        what, length, value = REQUEST.unpack_from(buffer)
        end = REQUEST.size + length
        if what not in (READ, WRITE, STATUS):
            raise ValueError(f"{what!r} is no request")
        if len(buffer) < end:
            return
        name = buffer[REQUEST.size : end].decode()
        del buffer[:end]
        yield what, name, value


@contextmanager
def simulated(
    bundle: Path, task: str, seed: int, speed: float = 1.0, *, again: bool = False, master: str = ""
) -> Iterator[str]:
    """The socket of a world that lives in a process of its own for as long as this lasts; MindError if it cannot.

    Where numba has to compile first, that takes a minute. The world also ends with the thread that called this.
    """
    with TemporaryDirectory(prefix="mind-") as folder:
        path = f"{folder}/world"
        # -P: a file of the user's folder that is named like a module must not be imported.
        program = [sys.executable, "-P", "-m", "mindrun.robot.world", f"--task={task}", f"--seed={seed}"]
        program += [f"--speed={speed}", f"--master={master}", f"--socket={path}", *["--again"] * again]
        program += ["--", str(bundle)]
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


@contextmanager
def listening(path: Path) -> Iterator[socket]:
    """A socket at `path` for this user alone, which is removed in the end; one that is dead is replaced."""
    with socket(AF_UNIX, SOCK_STREAM) as listener:
        old = os.umask(0o177)
        try:
            if path.is_socket() and not _lives(path):
                path.unlink()
            listener.bind(str(path))
            listener.listen()
        except OSError as error:
            raise MindError(f"cannot listen at {path}: {error.strerror or error}") from error
        finally:
            os.umask(old)
        try:
            yield listener
        finally:
            path.unlink(missing_ok=True)


def _lives(path: Path) -> bool:
    with socket(AF_UNIX, SOCK_STREAM) as client:
        return client.connect_ex(str(path)) == 0


def main() -> None:
    """Be a world until the parent ends."""
    options = _options()
    _end_with_parent()
    try:
        _run(options)
    except MindError as error:
        print(f"{error}; {error.hint}" if error.hint else error, flush=True)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)


def _run(options: argparse.Namespace) -> None:
    world = _world(options)
    server = Server(Scene(world, options.again))
    signal.signal(signal.SIGTERM, server.end)
    with listening(options.socket) as listener:
        print("ready", flush=True)
        server.serve(listener, world.graph.tick / options.speed)


def _world(options: argparse.Namespace) -> World:
    """The world of a bundle. Here alone the simulator is imported: a robot has none."""
    from mindrun.bundle import read_bundle

    try:
        simulator = import_module("mindrun.sim.commanded_world")
    except ImportError as error:
        raise MindError(f"there is no simulator here ({error})", "pip install mindlang") from error
    graph = read_bundle(options.bundle).graph
    try:
        world: World = simulator.World(graph, options.task, options.seed, options.master or None)
    except MemoryError as error:
        raise MindError(f"this computer has too little memory for task {options.task}") from error
    return world


def _end_with_parent() -> None:
    """As far as the system can: be terminated when the parent dies."""
    parent = os.getppid()
    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).prctl(PARENT_DIED, signal.SIGTERM)
    if os.getppid() != parent:
        sys.exit(1)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        "mindrun.robot.world", description="A simulated world, behind a socket.", allow_abbrev=False
    )
    parser.add_argument("bundle", type=Path, metavar="FILE.bundle")
    parser.add_argument("--task", required=True, help="the task whose world it is")
    parser.add_argument("--socket", required=True, type=Path, metavar="PATH")
    parser.add_argument("--seed", type=_seed, default=0, help="of the layout (default: 0)")
    parser.add_argument("--speed", type=_speed, default=1.0, help="times real time (default: 1)")
    parser.add_argument("--master", default="", help="the skill in charge (default: the mind's master)")
    parser.add_argument("--again", action="store_true", help="begin the next seed when a run ends")
    return parser.parse_args()


def _seed(text: str) -> int:
    if not 0 <= int(text) < SEED_COUNT:
        raise argparse.ArgumentTypeError(f"{text} is not a seed")
    return int(text)


def _speed(text: str) -> float:
    if not (isfinite(float(text)) and float(text) > 0):
        raise argparse.ArgumentTypeError(f"{text} is not a speed above 0")
    return float(text)


if __name__ == "__main__":
    main()
