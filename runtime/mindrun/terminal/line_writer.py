"""Writing without ever waiting for a reader: a terminal that is paused must not keep a wheel turning."""

import os
from collections import deque
from io import RawIOBase
from select import select
from threading import Condition, Thread
from typing import Any

from mindrun.files.printable import visible

MAX_WAITING_PIECES = 1000  # pieces that wait; the oldest go first


class LineWriter(RawIOBase):
    """Writes to a file descriptor from a thread of its own; what nobody takes is dropped."""

    def __init__(self, descriptor: int, prefix: str = "") -> None:
        super().__init__()
        self._descriptor = descriptor
        self._prefix = prefix
        self._waiting: deque[bytes] = deque(maxlen=MAX_WAITING_PIECES)
        self._idle = True
        self._change = Condition()
        Thread(target=self._run, name="line_writer", daemon=True).start()

    def __call__(self, line: str) -> None:
        """Say a line, of which only what can be printed is said as it is; returns at once."""
        self.write(f"{self._prefix}{visible(' '.join(line.split()))}\n".encode(errors="replace"))

    def writable(self) -> bool:
        """True."""
        return True

    def write(self, data: Any) -> int:
        """Queue bytes as they are; their number, at once."""
        with self._change:
            self._waiting.append(bytes(data))
            self._change.notify_all()
        return memoryview(data).nbytes

    @property
    def is_idle(self) -> bool:
        """Whether everything is written."""
        with self._change:
            return self._idle and not self._waiting

    def drain(self, seconds: float) -> None:
        """Wait until everything is written, but no longer than so many seconds."""
        with self._change:
            self._change.wait_for(lambda: self._idle and not self._waiting, seconds)

    def _run(self) -> None:
        while True:
            with self._change:
                self._idle = True
                self._change.notify_all()
                self._change.wait_for(lambda: self._waiting)
                data, self._idle = self._waiting.popleft(), False
            self._say(data)

    def _say(self, data: bytes) -> None:
        while data:
            try:
                data = data[os.write(self._descriptor, data) :]
            except BlockingIOError:  # another program has left it not blocking
                select([], [self._descriptor], [])
            except (OSError, ValueError):  # nobody listens, or the disk is full: perhaps not for ever
                return
