"""The server of a simulated world: ticks on time, and answers between them."""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from math import inf
from pathlib import Path
from selectors import EVENT_READ, SelectSelector
from socket import AF_UNIX, SOCK_STREAM, socket
from time import monotonic

from mindrun.errors import MindError
from mindrun.robot.simulated_world.protocol import requests
from mindrun.robot.simulated_world.scene import SimulatedScene

MAX_CLIENTS = 64
CHUNK_BYTES = 4096  # of requests that one client may have answered before the others
NEUTRAL_SECONDS = 2.0  # that the guardian has to bring a robot to neutral whose controller is gone


class Server:
    """Ticks on time, and answers all clients in between. One that sends nonsense, or does not listen, is cut off."""

    def __init__(self, scene: SimulatedScene) -> None:
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
