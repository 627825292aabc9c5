"""`python -P -m mindrun.robot.world_server BUNDLE TASK SEED MASTER SOCKET`: a simulated world, behind a socket.

It says `ready` on its standard output, or in one line what is wrong; `simulated_world` begins it and talks to it.
"""

import asyncio
import json
import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from math import inf
from pathlib import Path
from selectors import SelectSelector
from socket import AF_UNIX, SOCK_STREAM, socket
from time import monotonic
from typing import Any

import numpy as np

from mindrun.errors import MindError
from mindrun.graph.bundle import read_bundle
from mindrun.graph.named_readings import kept_rows
from mindrun.graph.recording_header import world_row_of
from mindrun.robot.processes import end_with_parent
from mindrun.robot.simulated_world import ANSWER, BOXES, NEUTRAL_SECONDS, READ, REQUEST, STATUS, WORLD, WRITE

DEAF_SECONDS = 1.0  # in which a client has to take an answer


def main() -> None:
    """Simulate a world until the parent process ends."""
    bundle, task, seed, master, path = sys.argv[1:]
    end_with_parent(os.getppid(), signal.SIGTERM)
    try:
        world = _world(Path(bundle), task, int(seed), master)
        server = WorldServer(SimulatedScene(world))
        signal.signal(signal.SIGTERM, server.end)
        with listening(Path(path)) as listener:
            print("ready", flush=True)
            server.serve(listener, world.graph.tick)
    except MindError as error:
        print(f"{error}; {error.hint}" if error.hint else error, flush=True)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)


def _world(bundle: Path, task: str, seed: int, master: str) -> Any:
    """A `mindrun.sim.commanded_lanes.CommandedWorld`; here alone the simulator is imported."""
    try:
        simulator = import_module("mindrun.sim.commanded_lanes")
    except ImportError as error:
        raise MindError(f"there is no simulator here ({error})", "pip install mindlang") from error
    graph = read_bundle(bundle).graph
    try:
        return simulator.CommandedWorld(graph, task, seed, master or None)
    except MemoryError as error:
        raise MindError(f"this computer has too little memory for task {task}") from error


class SimulatedScene:
    """A world, the command that each actuator holds, the memories as the robot told them, and what clients may ask."""

    def __init__(self, world: Any) -> None:
        self.world = world
        self.commands = {actuator.name: float(actuator.kind.neutral) for actuator in world.graph.actuators}
        self.memories: dict[str, float] = {}
        self._cells = kept_rows(world.graph).keys()
        self._places = {s.name: s.place for s in world.graph.sensors}
        self._readings = world.readings().astype("<f8")

    def tick(self) -> None:
        """Simulate one tick under the commands that the actuators hold; a world that has ended stands still."""
        self.world.remember(self.memories)
        self.world.step(list(self.commands.values()))
        self._readings = self.world.readings().astype("<f8")

    def answer(self, what: bytes, name: str, value: float) -> bytes:
        try:
            done, held = True, self._held(what, name, value)
        except LookupError as refused:
            done, held = False, str(refused.args[0]).encode()
        return ANSWER.pack(done, len(held)) + held

    def status(self) -> dict[str, Any]:
        """The state of the run, as plain data."""
        world = self.world
        return {
            "seed": world.seed, "tick": world.tick, "pose": world.pose, "events": world.events, "ended": world.ended,
            "by_line": world.by_line, "score": world.score, "commands": self.commands,
        }  # fmt: skip

    def _held(self, what: bytes, name: str, value: float) -> bytes:
        """The content of an answer; LookupError with the reason where the request is refused."""
        if what == STATUS:
            return json.dumps(self.status()).encode()
        if what == WORLD:
            row = np.zeros(1, world_row_of(self.world.task))
            for name, value in self.world.columns().items():
                row[name][0] = value
            return row.tobytes()
        if what == BOXES:
            return bytes(self.world.boxes.astype("<f8").tobytes())
        if what == READ:
            if name not in self._places:
                raise LookupError(f"there is no sensor {name}")
            return bytes(self._readings[self._places[name]].tobytes())
        if name in self._places and self.world.order(name, value):
            return b""
        if name in self._cells:
            self.memories[name] = value
            return b""
        if name not in self.commands:
            raise LookupError(f"there is no actuator {name}")
        if not 0.0 <= value <= 1.0:
            raise LookupError(f"a command of {value} is not between 0 and 1")
        self.commands[name] = value
        return b""


class WorldServer:
    """Ticks on time, and answers all clients in between. One that sends nonsense, or does not listen, is cut off."""

    def __init__(self, scene: SimulatedScene) -> None:
        self.scene = scene
        self.clients = 0
        self._until = inf

    def end(self, *_signal: object) -> None:
        """Serve only the clients there are, and those not for long."""
        self._until = monotonic() + NEUTRAL_SECONDS

    def serve(self, listener: socket, period: float) -> None:
        """Tick every so many seconds, until the end; a tick that is past is missed, not made up for."""
        # A loop that waits for a tick to the microsecond: epoll would wait in whole milliseconds.
        with asyncio.Runner(loop_factory=lambda: asyncio.SelectorEventLoop(SelectSelector())) as runner:
            runner.run(self._tick(listener, period))

    async def _tick(self, listener: socket, period: float) -> None:
        due = monotonic() + period
        await asyncio.start_unix_server(self._answer, sock=listener)
        while self._until == inf or (self.clients and monotonic() < self._until):
            await asyncio.sleep(min(max(due - monotonic(), 0.0), 0.1))
            late = monotonic() - due
            if late >= 0:
                self.scene.tick()
                due += (int(late / period) + 1) * period

    async def _answer(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """Answer what a client asks, until it goes away or is cut off."""
        self.clients += 1
        try:
            while True:
                what, length, value = REQUEST.unpack(await reader.readexactly(REQUEST.size))
                if what not in (READ, WRITE, STATUS, WORLD, BOXES):
                    break
                name = (await reader.readexactly(length)).decode()
                writer.write(self.scene.answer(what, name, value))
                async with asyncio.timeout(DEAF_SECONDS):
                    await writer.drain()
        except (OSError, EOFError, UnicodeDecodeError):
            pass
        finally:
            self.clients -= 1
            writer.transport.abort()


@contextmanager
def listening(path: Path) -> Iterator[socket]:
    """A socket at `path`, in a folder of this user alone, which is removed in the end."""
    with socket(AF_UNIX, SOCK_STREAM) as listener:
        try:
            listener.bind(str(path))
            listener.listen()
        except OSError as error:
            raise MindError(f"cannot listen at {path}: {error.strerror or error}") from error
        try:
            yield listener
        finally:
            path.unlink(missing_ok=True)


if __name__ == "__main__":
    main()
