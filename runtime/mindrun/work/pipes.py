"""The pipes of a worker's process, on which nobody waits for longer than is said."""

import os
import select
import subprocess
from collections.abc import Callable
from contextlib import suppress
from typing import IO

from mindrun.errors import MindError

PART_BYTES = 1 << 16  # at most at a time
KEPT_BYTES = 4096  # of what a worker says on standard error: the end of it
SHOWN_CHARACTERS = 300  # of its last line
SECOND_MILLISECONDS = 1000


class LostError(MindError):
    """A worker has ended, is silent, or answers nonsense."""


class Pipes:
    """Standard input, output and error of a process; a wait ends with LostError after `silent_seconds`.

    What it says on standard error is read meanwhile, so that it never waits for that; its end is kept, and `hear` told.
    """

    def __init__(
        self,
        process: subprocess.Popen[bytes],
        silent_seconds: float,
        hear: Callable[[bytes], object] = lambda part: None,
    ) -> None:
        self.silent_seconds, self._told = silent_seconds, hear
        self._process, self._said = process, b""
        self._input, self._output, self._error = (_unblocked(each) for each in _streams(process))
        self._hears = True

    def write(self, data: bytes) -> None:
        """Write all of it."""
        rest = memoryview(data)
        while rest:
            self._wait(self._input, select.POLLOUT)
            rest = rest[os.write(self._input, rest[:PART_BYTES]) :]

    def read(self, size: int) -> bytes:
        """Some bytes, at most so many; none where the output has ended."""
        self._wait(self._output, select.POLLIN)
        return os.read(self._output, min(size, PART_BYTES))

    def last_line(self) -> str:
        """What it said last on standard error."""
        with suppress(OSError, subprocess.TimeoutExpired):
            self._process.wait(1)
        while self._hears and self._hear():
            pass
        lines = self._said.decode(errors="replace").strip().splitlines()
        return lines[-1][:SHOWN_CHARACTERS] if lines else ""

    def close(self) -> None:
        """Close all three."""
        for stream in _streams(self._process):
            with suppress(OSError):  # what is left to be written has nobody to go to
                stream.close()

    def _wait(self, descriptor: int, event: int) -> None:
        while True:
            poll = select.poll()
            poll.register(descriptor, event)
            if self._hears:
                poll.register(self._error, select.POLLIN)
            ready = dict(poll.poll(self.silent_seconds * SECOND_MILLISECONDS))
            if not ready:
                raise LostError(f"it has said nothing for {self.silent_seconds:g} seconds")
            if self._error in ready:
                self._hear()
            if descriptor in ready:
                return

    def _hear(self) -> bool:
        """Take what is said on standard error; whether there was anything."""
        try:
            part = os.read(self._error, PART_BYTES)
        except BlockingIOError:
            return False
        self._hears = bool(part)
        self._told(part)
        self._said = (self._said + part)[-KEPT_BYTES:]
        return self._hears


def _streams(process: subprocess.Popen[bytes]) -> list[IO[bytes]]:
    return [stream for stream in (process.stdin, process.stdout, process.stderr) if stream is not None]


def _unblocked(stream: IO[bytes]) -> int:
    os.set_blocking(stream.fileno(), False)
    return stream.fileno()
