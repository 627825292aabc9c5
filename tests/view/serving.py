"""A view that is served while a test asks it: its server in a thread, clients that speak its protocol."""

import asyncio
import base64
import json
import socket
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from threading import Event, Thread
from typing import Any

import numpy as np
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Origin

from mindlang.compiler.compile import load
from mindlang.run.setup import RunSetup, set_up
from mindlang.view.learning import Learning
from mindlang.view.rows import DOUBLE_BYTES, HEADER, ROWS_KIND, SINGLE_BYTES
from mindlang.view.server import ViewServer
from mindlang.view.session import ViewSession
from mindlang.view.viewed import Viewed
from mindlang.view.viewed_run import ViewedRun

ANSWER_SECONDS = 600.0  # at which a test gives up: the simulator may have to be compiled
ENTERS = "\r\n"
UPGRADE = {
    "Upgrade": "websocket",
    "Connection": "Upgrade",
    "Sec-WebSocket-Key": base64.b64encode(b"0123456789abcdef").decode(),
    "Sec-WebSocket-Version": "13",
}


def prepared(path: Path, task: str) -> RunSetup:
    """A mind that is ready to run a task."""
    return set_up(str(path), load(path), task, None)


def simulated(path: Path, task: str = "Chase", seed: int = 3, interrupt: bool = True) -> Viewed:
    """A run that has not begun, but for its beginning."""
    setup = prepared(path, task)
    viewed = ViewedRun(setup, setup.rollout(interrupt), seed, {}).begun()
    viewed.grow()
    return viewed


class Served:
    """A view at an address, of which the token is the last part."""

    def __init__(self, server: ViewServer, loop: asyncio.AbstractEventLoop) -> None:
        self.port, self.token = server.port, server.token
        self._server, self._loop = server, loop
        self.host = f"127.0.0.1:{self.port}"

    @contextmanager
    def viewer(self, token: str | bytes | None = None) -> Iterator["ViewingClient"]:
        """A client that has said the token."""
        origin = Origin(f"http://{self.host}")
        with connect(f"ws://{self.host}/rows", origin=origin, compression=None, max_size=None) as client:
            client.send(self.token if token is None else token)
            yield ViewingClient(client)

    def drop(self) -> None:
        """Break every connection, as a net does that fails."""

        def abort() -> None:
            for viewer in self._server._viewers:
                viewer.connection.transport.abort()

        self._loop.call_soon_threadsafe(abort)

    def raw(self, data: bytes) -> bytes:
        """What the server says to bytes until it closes."""
        with socket.create_connection(("127.0.0.1", self.port), ANSWER_SECONDS) as client:
            client.sendall(data)
            found = b""
            try:
                while part := client.recv(1 << 16):
                    found += part
            except ConnectionResetError:
                pass
            return found

    def status(self, data: bytes) -> int | None:
        """The status with which a request is answered; None where it is not."""
        words = self.raw(data).split(b" ", 2)
        return int(words[1]) if len(words) > 1 else None


class ViewingClient:
    """A client that reads one message after the other."""

    def __init__(self, connection: ClientConnection) -> None:
        self.connection = connection

    def say(self, **message: Any) -> None:
        """Send a message."""
        self.connection.send(json.dumps(message))

    def hear(self, says: str) -> dict[str, Any]:
        """The next message that says this."""
        while True:
            found = self.connection.recv(ANSWER_SECONDS)
            if isinstance(found, str) and json.loads(found)["say"] == says:
                return dict(json.loads(found))

    def frame(self, **message: Any) -> bytes:
        """The bytes that answer a message."""
        self.say(**message)
        while isinstance(found := self.connection.recv(ANSWER_SECONDS), str):
            assert json.loads(found)["say"] != "refused", found
        return found

    def run(self, to: int, fork: int = 0) -> dict[str, Any]:
        """Let the run go on, and hear when it is there."""
        self.say(say="run", to=to, fork=fork)
        while True:
            ticks = self.hear("ticks")
            if ticks["fork"] == fork and (ticks["known"] >= to or ticks["over"]):
                return ticks


@contextmanager
def served(viewed: Viewed, learning: Learning | None = None, session: ViewSession | None = None) -> Iterator[Served]:
    """A view served until the block ends, in a session of its own where none is given."""
    loop, listening = asyncio.new_event_loop(), Event()
    server = ViewServer(session or ViewSession(viewed, learning))

    def ready(address: str) -> None:
        listening.set()

    def serve() -> None:
        with asyncio.Runner(loop_factory=lambda: loop) as runner, suppress(asyncio.CancelledError):
            runner.run(until_stopped())

    async def until_stopped() -> None:
        tasks.append(asyncio.current_task())
        await server.serve(ready)

    tasks: list[asyncio.Task[None] | None] = []
    thread = Thread(target=serve, daemon=True)
    thread.start()
    assert listening.wait(ANSWER_SECONDS)
    try:
        yield Served(server, loop)
    finally:
        if tasks[0] is not None:
            loop.call_soon_threadsafe(tasks[0].cancel)
        thread.join(ANSWER_SECONDS)
        assert not thread.is_alive()


def request(view: Served, line: str = "GET / HTTP/1.1", host: str | None = "HOST", **headers: str) -> bytes:
    """A request as bytes; HOST and PORT are those of the server."""
    lines = [line, *([] if host is None else [f"Host: {host}"]), *(f"{name}: {headers[name]}" for name in headers)]
    text = ENTERS.join([*lines, "", ""]).replace("HOST", view.host).replace("PORT", str(view.port))
    return text.encode("latin-1")


def unpacked(data: bytes, doubles: int, singles: int) -> tuple[int, int, np.ndarray, np.ndarray, np.ndarray]:
    """The fork, what was asked, the ticks and both blocks of a frame of rows; ValueError where it is none."""
    if len(data) < HEADER.size or HEADER.unpack_from(data)[0] != ROWS_KIND:
        raise ValueError("this is no frame of rows")
    _, fork, first, every, rows, ask = HEADER.unpack_from(data)
    middle = HEADER.size + DOUBLE_BYTES * doubles * rows
    if len(data) != middle + SINGLE_BYTES * singles * rows:
        raise ValueError(f"a frame of {rows} rows has another length than {len(data)} bytes")
    wide = np.frombuffer(data[HEADER.size : middle], "<f8").reshape(rows, doubles)
    narrow = np.frombuffer(data[middle:], "<f4").reshape(rows, singles)
    return fork, ask, first + every * np.arange(rows), wide, narrow
