"""Says things without ever waiting for a listener: a terminal that is paused must not keep a wheel turning."""

import os
from collections import deque
from threading import Event, Thread

MOST = 64  # lines that wait; the oldest go first


class Teller:
    """Writes lines to a file descriptor from a thread of its own."""

    def __init__(self, descriptor: int, prefix: str = "") -> None:
        self._descriptor = descriptor
        self._prefix = prefix
        self._lines: deque[str] = deque(maxlen=MOST)
        self._more, self._idle = Event(), Event()
        self._idle.set()
        Thread(target=self._run, daemon=True).start()

    def __call__(self, line: str) -> None:
        """Say a line; returns at once."""
        self._idle.clear()
        self._lines.append(f"{self._prefix}{' '.join(line.split())}\n")
        self._more.set()

    def flush(self, seconds: float) -> None:
        """Wait until all is said, but no longer than this."""
        self._idle.wait(seconds)

    def _run(self) -> None:
        try:
            while self._more.wait():
                self._more.clear()
                while self._lines:
                    os.write(self._descriptor, self._lines.popleft().encode(errors="replace"))
                self._idle.set()
        except OSError:  # nobody listens any more
            self._idle.set()
