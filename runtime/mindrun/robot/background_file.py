"""A file that a thread of its own writes: who writes to it does not wait for a slow card."""

import errno
import os
from queue import SimpleQueue
from threading import Event, Thread
from typing import BinaryIO

MAX_WAITING_BYTES = 1 << 26  # that a card has not taken yet


class BackgroundFile:
    """Brings to a file at once what is written. An error of the file is that of whatever is written or flushed next.

    A file that takes nothing for so long that memory would fill is one that cannot be written.
    """

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self._queue: SimpleQueue[bytes | Event | None] = SimpleQueue()  # an event is set when all before it is written
        self._failure: OSError | None = None
        self._given, self._taken = 0, 0  # bytes; only who writes counts the first, only the thread the second
        self._writing = Thread(target=self._run, name="background_file", daemon=True)
        self._writing.start()

    def write(self, data: bytes) -> None:
        """Leave bytes to the thread; returns at once."""
        self._raise_failure()
        if self._given - self._taken > MAX_WAITING_BYTES:
            raise OSError(errno.ETIMEDOUT, os.strerror(errno.ETIMEDOUT))
        self._given += len(data)
        self._queue.put(data)

    def flush(self) -> None:
        """Wait until everything is in the file."""
        written = Event()
        self._queue.put(written)
        written.wait()
        self._raise_failure()

    def fileno(self) -> int:
        """The descriptor of the file."""
        return self._file.fileno()

    def close(self) -> None:
        """Write what is left, and close the file."""
        self._queue.put(None)
        self._writing.join()
        self._file.close()

    def _raise_failure(self) -> None:
        if self._failure:
            raise self._failure

    def _run(self) -> None:
        while (item := self._queue.get()) is not None:
            if isinstance(item, Event):
                item.set()
            elif not self._failure:  # what follows would have a gap before it
                try:
                    self._file.write(item)
                    self._file.flush()
                    self._taken += len(item)
                except OSError as error:
                    self._failure = error
