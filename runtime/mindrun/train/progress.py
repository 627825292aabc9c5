"""The log of a run: one line per generation, in `progress.jsonl` and `progress.csv`."""

import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import asdict, fields
from itertools import takewhile
from math import isfinite
from pathlib import Path
from typing import Self

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


class AppendedFiles:
    """Files of a run to which rows are added: each is written anew as it `begins`, and open from then on."""

    def __init__(self, begins: Mapping[Path, bytes]) -> None:
        for path, data in begins.items():
            atomic_write.write(path, data)
        self._files = [os.open(path, os.O_WRONLY | os.O_APPEND) for path in begins]

    def _add(self, *rows: bytes) -> None:
        """Add all of a row to each file; a full disk may take part of it and fail only at the rest."""
        for descriptor, data in zip(self._files, rows, strict=True):
            while data:
                data = data[os.write(descriptor, data) :]

    def sync(self) -> None:
        """Bring the files to the disk, so that they are never behind a checkpoint."""
        for descriptor in self._files:
            os.fsync(descriptor)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        for descriptor in self._files:
            os.close(descriptor)


class ProgressLog(AppendedFiles):
    """The two files of the log, with only the generations that `state` has behind it."""

    def __init__(self, folder: Path, state: LessonState) -> None:
        records = [record for record in read_progress(folder) if _is_behind(record, state)]
        table = [_row(COLUMNS), *(_row(record.values()) for record in records)]
        super().__init__({folder / LINES: b"".join(map(_line, records)), folder / TABLE: b"".join(table)})

    def append(self, record: Record) -> None:
        values = asdict(record).items()
        plain = {name: value if value is not None and isfinite(value) else None for name, value in values}
        self._add(_line(plain), _row(plain.values()))


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
    """The record in a line; an empty one where it has none."""
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


def _line(record: Logged) -> bytes:
    return json.dumps(record).encode() + b"\n"


def _row(values: Iterable[object]) -> bytes:
    return ",".join("" if value is None else str(value) for value in values).encode() + b"\n"
