"""What happened, tick by tick: everything that is needed to compute it again, in a file that survives a power cut.

A line of JSON says what the columns are; then rows of fixed size follow. Line and rows have checksums; the line of the
oldest version has none. A row that was cut off at the end is no row.
"""

import os
import zlib
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from math import inf
from pathlib import Path
from threading import Event, Thread
from types import TracebackType
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from mindrun.files.regular_files import open_regular
from mindrun.graph.recording_header import CHECKSUM_FIELD as CHECKSUM_FIELD
from mindrun.graph.recording_header import MAX_HEADER_BYTES as MAX_HEADER_BYTES
from mindrun.graph.recording_header import About as About
from mindrun.graph.recording_header import RecordingError as RecordingError
from mindrun.graph.recording_header import about_of_line, line_of
from mindrun.robot.background_file import BackgroundFile

READ_BYTES = 1 << 22  # of rows at once, or one row where that is more


class Recorder:
    """Writes a recording; a context manager. OSError where the file is there already, or cannot be written.

    Rows are brought to the disk `every` so many seconds. Others see them as late, or `at_once`, which a thread does.
    Where there is a world, `world` says what its columns are now.
    """

    def __init__(
        self,
        path: Path,
        about: About,
        every: float = 1.0,
        at_once: bool = False,
        world: Callable[[], NDArray[Any]] | None = None,
    ) -> None:
        line = line_of(about)
        self._world = world
        self._row = np.zeros(1, about.row)
        self._path = path
        file = path.open("xb")
        self._file = BackgroundFile(file) if at_once else file
        try:
            self._file.write(line)
            self._file.flush()  # somebody may follow it already
        except OSError:
            with suppress(OSError):  # it would say the same again
                self._file.close()
            raise
        self._ending = Event()
        self._syncing = Thread(target=self._sync, args=(every,), name="recording", daemon=True)
        self._syncing.start()
        self._flush_every, self._flushed = inf if at_once else every, 0.0

    def write(self, **columns: Any) -> None:
        """A row, which is on the disk a second or two later; RecordingError where it cannot be."""
        for name, value in columns.items():
            self._row[name][0] = value
        if self._world:
            self._row["world"] = self._world()
        self._row["check"] = 0
        self._row["check"] = zlib.crc32(self._row.tobytes())
        time = float(self._row["time"][0])
        try:
            self._file.write(self._row.tobytes())
            if time - self._flushed >= self._flush_every:
                self._file.flush()
                self._flushed = time
        except OSError as error:
            raise RecordingError(f"{self._path} cannot be written: {error.strerror}") from error

    def close(self) -> None:
        """Bring the rest to the disk."""
        self._ending.set()
        self._syncing.join()
        try:
            self._file.flush()
            os.fsync(self._file.fileno())
        except OSError as error:
            raise RecordingError(f"{self._path} cannot be written: {error.strerror}") from error
        finally:
            with suppress(OSError):  # it has said so already
                self._file.close()

    def _sync(self, every: float) -> None:
        """Bring to the disk what has been written, beside the loop: a slow card must not hold a tick."""
        while not self._ending.wait(every):
            with suppress(OSError, ValueError):  # the writer hears of it; or the file is closed
                os.fsync(self._file.fileno())

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.close()


def recording_bytes(about: About, rows: NDArray[Any]) -> bytes:
    """A recording of these rows [ticks] of `about.row`, whose checksums are filled in."""
    for row in rows:
        row["check"] = 0
        row["check"] = zlib.crc32(row.tobytes())
    return line_of(about) + rows.tobytes()


def read(path: Path) -> tuple[About, Iterator[NDArray[Any]]]:
    """What a recording is of, and its rows in parts, as `whole_rows`; RecordingError where it is none."""
    try:
        with open(open_regular(path), "rb") as file:  # noqa: PTH123
            about = about_of_line(file.readline(MAX_HEADER_BYTES), path)
            return about, whole_rows(path, about, _parts(path, file.tell(), about.row.itemsize))
    except OSError as error:
        raise RecordingError(f"cannot read {path}: {error.strerror}") from error


def _parts(path: Path, offset: int, row_bytes: int) -> Iterator[bytes]:
    with open(open_regular(path), "rb") as file:  # noqa: PTH123
        file.seek(offset)
        while data := file.read(row_bytes * max(1, READ_BYTES // row_bytes)):
            yield data


def whole_rows(path: Path, about: About, parts: Iterable[bytes]) -> Iterator[NDArray[Any]]:
    """The rows of a recording whose bytes come in parts, however they are cut: those that are whole with each part.

    RecordingError where one is damaged, behind all that are before it. A last row that is not whole is no row.
    """
    size, number, waiting = about.row.itemsize, 0, bytearray()
    for part in parts:
        waiting += part
        whole = len(waiting) // size * size
        rows = np.frombuffer(bytes(waiting[:whole]), about.row)
        del waiting[:whole]
        good = [_is_whole(row) for row in rows]
        if not all(good):
            yield rows[: good.index(False)]
            raise RecordingError(f"{path} is damaged at row {number + good.index(False)}")
        number += len(rows)
        yield rows


def _is_whole(row: Any) -> bool:
    """Whether a row is what its checksum is of."""
    bare = row.copy()
    bare["check"] = 0
    return bool(zlib.crc32(bare.tobytes()) == row["check"])
