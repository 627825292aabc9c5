"""What happened, tick by tick: everything that is needed to compute it again, in a file that survives a power cut.

A line of JSON says what the columns are; then rows of fixed size follow. Line and rows have checksums; the line of an
older version has none. A row that was cut off at the end is no row.
"""

import json
import os
import re
import zlib
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from math import inf
from pathlib import Path
from threading import Event, Thread
from types import TracebackType
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from mindrun.errors import MindError
from mindrun.graph import Graph
from mindrun.named_readings import physical
from mindrun.regular_files import open_regular
from mindrun.robot.background_file import BackgroundFile
from mindrun.strict_json import are_names, is_whole, parsed
from mindrun.validate import MAX_TICK_SECONDS, MIN_TICK_SECONDS

FORMAT, UNSEALED = "mind recording 2", "mind recording 1"
MAX_HEADER_BYTES = 1 << 20
READ_BYTES = 1 << 22  # of rows at once, or one row where that is more
CHECKSUM_FIELD = b', "check": "'  # the checksum of the line before it, which is the last that it says
SHA256 = re.compile("[0-9a-f]{64}")


class RecordingError(MindError):
    """A recording that cannot be read, or was made of something else."""


@dataclass(frozen=True, slots=True)
class About:
    """What a recording is of: the SHA-256 of its bundle, the master, and the names of its columns."""

    bundle: str
    master: str
    tick: float
    sensors: tuple[str, ...]
    actuators: tuple[str, ...]
    skills: tuple[str, ...]
    readings: int

    @classmethod
    def of(cls, graph: Graph, bundle: str, master: str, sensors: tuple[str, ...]) -> Self:
        """A recording of these wired sensors under a graph."""
        actuators = tuple(actuator.name for actuator in graph.actuators)
        skills = tuple(skill.name for skill in graph.skills)
        return cls(bundle, master, graph.tick, sensors, actuators, skills, graph.width)

    def refuse_another(self, bundle: str, graph: Graph) -> None:
        """RecordingError unless the recording was made with the bundle of this SHA-256, which has this graph."""
        if self.bundle != bundle:
            raise RecordingError(
                f"this was recorded with another bundle ({self.bundle[:8]}…, not {bundle[:8]}…)",
                "take the bundle that was running",
            )
        if (
            self != About.of(graph, bundle, self.master, self.sensors)
            or not set(self.sensors) <= physical(graph).keys()
        ):
            raise RecordingError("this has other columns than its bundle: it was recorded by something else")

    @property
    def row(self) -> np.dtype[Any]:
        """A tick: its number and time, whether all had to be neutral and was armed; what was read, thought and sent."""
        sensors, skills, actuators = (len(names) for names in (self.sensors, self.skills, self.actuators))
        return np.dtype([
            ("tick", "<u8"), ("time", "<f8"), ("stopped", "u1"), ("armed", "u1"),
            ("faults", "u1", (sensors,)), ("ages", "<f4", (sensors,)), ("readings", "<f4", (self.readings,)),
            ("influence", "<f4", (skills,)), ("commands", "<f4", (actuators,)), ("sent", "<f4", (actuators,)),
            ("check", "<u4"),
        ])  # fmt: skip


class Recorder:
    """Writes a recording; a context manager. OSError where the file is there already, or cannot be written.

    Rows are brought to the disk `every` so many seconds. Others see them as late, or `at_once`, which a thread does.
    """

    def __init__(self, path: Path, about: About, every: float = 1.0, at_once: bool = False) -> None:
        self._row = np.zeros(1, about.row)
        self._path = path
        file = path.open("xb")
        self._file = BackgroundFile(file) if at_once else file
        self._ending = Event()
        self._syncing = Thread(target=self._sync, args=(every,), name="recording", daemon=True)
        self._syncing.start()
        self._file.write(_line(about))
        self._file.flush()  # somebody may follow it already
        self._flush_every, self._flushed = inf if at_once else every, 0.0

    def write(self, **columns: Any) -> None:
        """A row, which is on the disk a second or two later; RecordingError where it cannot be."""
        for name, value in columns.items():
            self._row[name][0] = value
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


def _line(about: About) -> bytes:
    said = json.dumps({"format": FORMAT, **{name: getattr(about, name) for name in About.__slots__}}).encode()[:-1]
    return _sealed(said + CHECKSUM_FIELD)


def about_of_line(line: bytes, path: Path) -> About:
    """What a first line says; RecordingError where it says nothing that a recording could be of."""
    try:
        plain = parsed(line, MAX_HEADER_BYTES)
        if not isinstance(plain, dict) or plain.get("format") not in (FORMAT, UNSEALED):
            raise ValueError("it is of another form")
        if plain["format"] == FORMAT and line != _sealed(line):
            raise RecordingError(f"{path} is damaged in its first line")
        return _typed({name: plain.get(name) for name in About.__slots__})
    except ValueError as error:
        raise RecordingError(f"{path} is no recording of this mindrun: {error}") from error


def _sealed(line: bytes) -> bytes:
    """The line with the checksum of what it says before that."""
    said = line.rpartition(CHECKSUM_FIELD)[0]
    return said + CHECKSUM_FIELD + f"{zlib.crc32(said):08x}".encode() + b'"}\n'


def _typed(plain: dict[str, Any]) -> About:
    """What a recording is of, from plain data; ValueError where that is none."""
    lists = [plain[name] for name in ("sensors", "actuators", "skills")]
    if not all(map(are_names, lists)) or not are_names([plain["master"]]):
        raise ValueError("its columns have no names")
    if not isinstance(plain["bundle"], str) or not SHA256.fullmatch(plain["bundle"]):
        raise ValueError("it does not say of which bundle it is")
    if type(plain["tick"]) not in (int, float) or not MIN_TICK_SECONDS <= plain["tick"] <= MAX_TICK_SECONDS:
        raise ValueError("it does not say how long a tick is")
    if not is_whole(plain["readings"], high=MAX_HEADER_BYTES):
        raise ValueError("it does not say how many readings there are")
    return About(**plain | {name: tuple(plain[name]) for name in ("sensors", "actuators", "skills")})
