"""Messages between a program and the process that steps its environments: plain data and arrays, pickled."""

import pickle
from collections.abc import Callable
from socket import socket
from struct import Struct
from typing import Any

LENGTH = Struct("<Q")  # of a message, before it
REACHED = Struct("<I")  # which environment of a question is asked, in memory that outlives the process
MAX_READ_BYTES = 1 << 20  # at once


class Channel:
    """One end of a connected pair of sockets, on which questions and answers alternate.

    `look` is called whenever a wait has taken the socket's time limit.
    """

    def __init__(self, end: socket, look: Callable[[], object] = lambda: None) -> None:
        self._socket, self._look = end, look

    def send(self, message: Any) -> None:
        """Send a message; OSError where nobody is left to take it."""
        data = pickle.dumps(message, pickle.HIGHEST_PROTOCOL)
        rest = memoryview(LENGTH.pack(len(data)) + data)
        while rest:
            try:
                rest = rest[self._socket.send(rest) :]
            except TimeoutError:
                self._look()

    def receive(self) -> Any:
        """The next message; EOFError where the other end is closed."""
        data = bytearray()
        while len(data) < LENGTH.size or len(data) < LENGTH.size + LENGTH.unpack_from(data)[0]:
            try:
                part = self._socket.recv(MAX_READ_BYTES)
            except TimeoutError:
                self._look()
                continue
            if not part:
                raise EOFError
            data += part
        return pickle.loads(memoryview(data)[LENGTH.size :])

    def close(self) -> None:
        """Close this end."""
        self._socket.close()
