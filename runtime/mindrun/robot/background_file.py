"""A file that a thread of its own writes: who writes to it does not wait for a slow card."""

from queue import SimpleQueue
from threading import Event, Thread
from typing import BinaryIO


class BackgroundFile:
    """Brings to a file at once what is written. An error of the file is that of whatever is written or flushed next."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self._queue: SimpleQueue[bytes | Event | None] = SimpleQueue()  # an event is set when all before it is written
        self._failure: OSError | None = None
        self._writing = Thread(target=self._run, name="background_file", daemon=True)
        self._writing.start()

    def write(self, data: bytes) -> None:
        """Leave bytes to the thread; returns at once."""
        self._raise_failure()
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
                except OSError as error:
                    self._failure = error
