"""Recordings: everything, tick by tick, that is needed to compute a run again, in a file that survives a power cut.

A line of JSON says what the columns are; then rows of fixed size follow. Line and rows have checksums; the line of the
oldest version has none. A row that was cut off at the end is no row.
"""

import errno
import os
import zlib
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, suppress
from itertools import chain
from pathlib import Path
from queue import SimpleQueue
from threading import Event, Thread
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from mindrun.errors import system_errors_as
from mindrun.files.regular_files import open_regular
from mindrun.graph.recording_header import MAX_HEADER_BYTES, about_of_line, line_of
from mindrun.graph.recording_header import About as About
from mindrun.graph.recording_header import RecordingError as RecordingError

READ_BYTES = 1 << 22  # at once
MAX_EMPTY_PARTS = 20  # in a row, before there is a first line
MAX_WAITING_BYTES = 1 << 26  # that a card has not taken yet


class BackgroundFile:
    """A file that a thread writes; an error of it is raised by the `write` or `flush` that follows.

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
        if self._failure:
            raise self._failure
        if self._given - self._taken > MAX_WAITING_BYTES:
            raise OSError(errno.ETIMEDOUT, os.strerror(errno.ETIMEDOUT))
        self._given += len(data)
        self._queue.put(data)

    def flush(self) -> None:
        """Wait until everything is in the file."""
        written = Event()
        self._queue.put(written)
        written.wait()
        if self._failure:
            raise self._failure

    def fileno(self) -> int:
        return self._file.fileno()

    def close(self) -> None:
        """Write what is left, and close the file; an error that was told is not told again."""
        self._queue.put(None)
        self._writing.join()
        with suppress(OSError):
            self._file.close()

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


class Recorder(AbstractContextManager["Recorder"]):
    """Writes a recording. OSError where the file is there already, or cannot be written.

    Others see each row at once; rows are brought to the disk `every` so many seconds, or in the end. Where there is a
    world, `world` says what its columns are now.
    """

    def __init__(
        self, path: Path, about: About, every: float | None = 1.0, world: Callable[[], NDArray[Any]] | None = None
    ) -> None:
        line = line_of(about)
        self._world = world
        self._row = np.zeros(1, about.row)
        self._unwritten = f"{path} cannot be written"
        self._file = BackgroundFile(path.open("xb"))
        try:
            self._file.write(line)
            self._file.flush()  # somebody may follow it already
        except OSError:
            self._file.close()
            raise
        self._ending = Event()
        self._syncing = Thread(target=self._sync, args=(every,), name="recording", daemon=True)
        self._syncing.start()

    def write(self, **columns: Any) -> None:
        """Write a row, which is on the disk a second or two later; RecordingError where it cannot be."""
        for name, value in columns.items():
            self._row[name][0] = value
        if self._world:
            self._row["world"] = self._world()
        with system_errors_as(RecordingError, self._unwritten):
            self._file.write(_sealed(self._row).tobytes())

    def close(self) -> None:
        """Bring the rest to the disk."""
        self._ending.set()
        self._syncing.join()
        try:
            with system_errors_as(RecordingError, self._unwritten):
                self._file.flush()
                os.fsync(self._file.fileno())
        finally:
            self._file.close()

    def _sync(self, every: float | None) -> None:
        """Bring to the disk what has been written, beside the loop: a slow card must not hold a tick."""
        while not self._ending.wait(every):
            with suppress(OSError):  # the writer hears of it
                os.fsync(self._file.fileno())

    def __exit__(self, *error: object) -> None:
        self.close()


class TemporaryRecorder(Recorder):
    """A recording that is no reason for a robot to stop: where it cannot be written, `tell` gets one sentence."""

    def __init__(
        self, path: Path, about: About, tell: Callable[[str], None], world: Callable[[], NDArray[Any]] | None = None
    ) -> None:
        super().__init__(path, about, None, world)  # it need not survive a power cut, and no card is worn by it
        self._tell, self._has_failed = tell, False

    def write(self, **columns: Any) -> None:
        """Write a row, where there is room for it."""
        if self._has_failed:
            return
        try:
            super().write(**columns)
        except RecordingError as error:
            self._has_failed = True
            self._tell(f"nothing more is seen, and the robot drives on: {error}")

    def close(self) -> None:
        """Let go of it; what was not written is missed by nobody."""
        with suppress(RecordingError):
            super().close()


def recording_bytes(about: About, rows: NDArray[Any]) -> bytes:
    """A recording of these rows [ticks] of `about.row`, whose checksums are filled in."""
    return line_of(about) + _sealed(rows).tobytes()


def _sealed(rows: NDArray[Any]) -> NDArray[Any]:
    rows["check"] = 0
    rows["check"] = [zlib.crc32(row.tobytes()) for row in rows]
    return rows


def read(path: Path) -> tuple[About, Iterator[NDArray[Any]]]:
    """The header of a recording, and its rows in parts; RecordingError where it is none.

    The rows raise it, too, where one is damaged, behind all that are before it. A last row that is not whole is no row.
    """
    with system_errors_as(RecordingError, f"cannot read {path}"):
        return read_growing(path, _parts(path))


def _parts(path: Path) -> Iterator[bytes]:
    with open(open_regular(path), "rb", buffering=0) as file:  # noqa: PTH123
        while data := file.read(READ_BYTES):
            yield data


def read_growing(path: Path, parts: Iterator[bytes]) -> tuple[About, Iterator[NDArray[Any]]]:
    """The header of a recording, and with each part of its bytes the rows [0 or more] that are whole now.

    RecordingError where it is no recording; the rows raise it where one is damaged, behind all that are before it. A
    last row that is not whole waits for the rest of it. `path` is what messages call it.
    """
    line, waiting = _first_line(path, parts)
    about = about_of_line(line, path)
    return about, whole_rows(path, about, chain([waiting], parts))


def _first_line(path: Path, parts: Iterator[bytes]) -> tuple[bytes, bytes]:
    """The first line, and what has come behind it."""
    waiting, empty = bytearray(), 0
    for part in parts:
        waiting += part
        if b"\n" in part or len(waiting) >= MAX_HEADER_BYTES:
            break
        empty = 0 if part else empty + 1
        if empty == MAX_EMPTY_PARTS:
            raise RecordingError(f"{path} has no first line yet", "is it still written?")
    line, end, rest = bytes(waiting).partition(b"\n")
    return line + end, rest


def whole_rows(path: Path, about: About, parts: Iterable[bytes]) -> Iterator[NDArray[Any]]:
    """The rows of a recording whose bytes come in parts, however they are cut: those that are whole with each part."""
    size, number, waiting = about.row.itemsize, 0, bytearray()
    for part in parts:
        waiting += part
        whole = len(waiting) // size * size
        rows = np.frombuffer(bytes(waiting[:whole]), about.row)
        del waiting[:whole]
        good = _sealed(rows.copy())["check"] == rows["check"]
        if not good.all():
            first = int(np.argmin(good))
            yield rows[:first]
            raise RecordingError(f"{path} is damaged at row {number + first}")
        number += len(rows)
        yield rows
