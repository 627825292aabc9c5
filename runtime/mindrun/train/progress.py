"""The log of a run: one line per generation, in `progress.jsonl` and `progress.csv`."""

import json
import os
from dataclasses import asdict, fields
from itertools import takewhile
from math import isfinite
from pathlib import Path
from types import TracebackType

from mindrun.files import atomic_write
from mindrun.files.regular_files import read_whole
from mindrun.files.strict_json import is_whole, parsed
from mindrun.train import RunError
from mindrun.train.lesson_state import LessonState, Record

LINES, TABLE = "progress.jsonl", "progress.csv"
Position = tuple[int, int]  # attempt and generation, which count from 1
Logged = dict[str, float | None]  # a generation: as Record, None where a score is not finite
COUNT_COLUMNS = "attempt", "generation"
COLUMNS = tuple(field.name for field in fields(Record))
MAX_LOG_BYTES = 1 << 28
MAX_LINE_BYTES = 1 << 12
MAX_COUNT = 2**53


class ProgressLog:
    """The two files of the log, open to append, with only the generations that `state` has behind it."""

    def __init__(self, folder: Path, state: LessonState) -> None:
        records = [record for record in read_progress(folder) if _is_behind(record, state)]
        atomic_write.write(folder / LINES, b"".join(_line(record) for record in records))
        atomic_write.write(folder / TABLE, _row(list(COLUMNS)) + b"".join(_row(list(r.values())) for r in records))
        self._lines = os.open(folder / LINES, os.O_WRONLY | os.O_APPEND)
        self._table = os.open(folder / TABLE, os.O_WRONLY | os.O_APPEND)

    def append(self, record: Record) -> None:
        """Add a generation."""
        plain = {name: _plain(value) for name, value in asdict(record).items()}
        write(self._lines, _line(plain))
        write(self._table, _row(list(plain.values())))

    def sync(self) -> None:
        """Bring the log to the disk, so that it is never behind a checkpoint."""
        os.fsync(self._lines)
        os.fsync(self._table)

    def __enter__(self) -> "ProgressLog":
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        os.close(self._lines)
        os.close(self._table)


def read_progress(folder: Path) -> list[Logged]:
    """The whole lines of a run's log; what follows a line that a crash damaged is left out."""
    try:
        lines = read_whole(folder / LINES, MAX_LOG_BYTES).split(b"\n")[:-1]
    except FileNotFoundError:
        return []
    except OSError as error:
        raise RunError(
            f"cannot read {folder / LINES}: {error.strerror}", "move it away: it is but the log of the run"
        ) from error
    return list(takewhile(bool, map(_record, lines)))


def _record(line: bytes) -> Logged:
    """The generation that a line says; an empty one where it says none."""
    try:
        record = parsed(line, MAX_LINE_BYTES)
    except ValueError:
        return {}
    if not isinstance(record, dict) or tuple(record) != COLUMNS:
        return {}
    counted = all(is_whole(record[name], 1) for name in COUNT_COLUMNS)
    return record if counted and all(map(_is_plain, record.values())) else {}


def _is_plain(value: object) -> bool:
    return value is None or is_whole(value, -MAX_COUNT, MAX_COUNT) or (isinstance(value, float) and isfinite(value))


def _is_behind(record: Logged, state: LessonState) -> bool:
    attempt, generation = int(record["attempt"] or 0) - 1, int(record["generation"] or 0)
    return (attempt, generation) <= (state.attempt, state.now.population.generation)


def _plain(value: float | None) -> float | None:
    return value if value is not None and isfinite(value) else None


def _line(record: Logged) -> bytes:
    return json.dumps(record).encode() + b"\n"


def _row(values: list[str] | list[float | None]) -> bytes:
    return ",".join("" if value is None else str(value) for value in values).encode() + b"\n"


def write(descriptor: int, data: bytes) -> None:
    """Write all of the data."""
    # A full disk may take part of a line and fail only at the rest.
    while data:
        data = data[os.write(descriptor, data) :]
