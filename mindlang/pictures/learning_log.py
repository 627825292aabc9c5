"""Logs of runs as data for pictures: generations, from a run's folder or a table, and the mean of several runs."""

import csv
import gzip
import os
import zlib
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from io import BytesIO, StringIO
from math import isfinite, sqrt
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.files.regular_files import read_whole
from mindrun.files.strict_json import is_whole
from mindrun.train import NotFoundError, RunError
from mindrun.train.progress import COUNT_COLUMNS, LINES, TABLE, read_progress
from mindrun.train.run_folder import MANIFEST, open_run, read_failure
from numpy.typing import NDArray

from mindlang.training.standstill import Records, idle_ticks

TABLES = (".csv", ".csv.gz")
HINT = f"a run is a folder like runs/GoToObject/20260714T120000Z-1, a table ends in {' or '.join(TABLES)}"
SCORES = ("best", "reevaluated", "verdict")
MAX_TABLE_BYTES = 64 << 20
REQUIRED_COLUMNS = ("attempt", "generation", "best")


@dataclass(frozen=True, slots=True)
class Curve:
    """The learning curve of a lesson: the records of its log. `note` tells it from others of its name.

    `failure` says why nothing came of it; "" where it was learnt, goes on, or nobody knows.
    `lesson` is the same for runs that teach the same lesson of the same mind, whatever their seeds and the weights that
    they began with; of a table nobody knows it. Where it `is_along_ticks`, those of an attempt so far stand in the
    place of its generations.
    """

    name: str
    records: Records
    path: Path
    note: str = ""
    lesson: str = ""
    failure: str = ""
    is_along_ticks: bool = False

    @property
    def attempts(self) -> list[int]:
        return sorted({int(record["attempt"] or 0) for record in self.records})

    def last(self, attempt: int) -> int:
        return max(int(record["generation"] or 0) for record in self.records if record["attempt"] == attempt)

    def has_ended(self, attempt: int) -> bool:
        """True if an attempt has certainly ended: it has a verdict, or another has begun after it."""
        return attempt < max(self.attempts) or bool(self.points(attempt, "verdict"))

    def points(self, attempt: int, column: str) -> list[tuple[int, float]]:
        """The generations of an attempt that have a finite score in a column, each with it."""
        scores = [
            (int(record["generation"] or 0), record.get(column))
            for record in self.records
            if record["attempt"] == attempt
        ]
        return [(generation, score) for generation, score in scores if score is not None and isfinite(score)]

    def data(self) -> dict[str, Any]:
        return {
            "name": self.name,
            "run": str(self.path),
            "attempts": len(self.attempts),
            "generations": len(self.records),
            "idle_ticks": idle_ticks(self.records),
            "failed": self.failure or None,
        }


def along_ticks(curve: Curve) -> Curve:
    """A curve along ticks; RunError where its log does not say them."""
    so_far, records = Counter[float | None](), list[Mapping[str, float | None]]()
    for record in curve.records:
        if (ticks := record.get("ticks")) is None:
            raise RunError(f"{curve.path} has no column ticks", "the folder of a run and its progress.csv have them")
        so_far[record["attempt"]] += int(ticks)
        records.append({**record, "generation": so_far[record["attempt"]]})
    return replace(curve, records=records, is_along_ticks=True)


def load_curves(paths: Iterable[Path]) -> list[Curve]:
    """The curves of all runs and tables, each once; NotFoundError or RunError where there is nothing to show."""
    logs = dict.fromkeys(log for path in paths for log in _logs(path))
    curves = [_from_table(log) if log.is_file() else _from_run(log) for log in logs]
    if empty := next((curve for curve in curves if not curve.records), None):
        raise RunError(f"{empty.path} has no generations yet")
    # Curves that share a name get the part of their path that they do not share as a note.
    alike = {curve.name: [other.path.resolve() for other in curves if other.name == curve.name] for curve in curves}
    notes = [os.path.relpath(curve.path.resolve(), os.path.commonpath(alike[curve.name])) for curve in curves]
    return [replace(curve, note=note) if note != "." else curve for curve, note in zip(curves, notes, strict=True)]


def _logs(path: Path) -> list[Path]:
    """The path itself where it is a run or a table, else all runs beneath it that have learnt for a generation."""
    if path.is_file() and path.name.endswith(TABLES):
        return [path]
    if not path.is_dir():
        raise NotFoundError(f"{path} is not a run" if path.exists() else f"there is no run {path}", HINT)
    if (path / MANIFEST).exists() or (path / LINES).exists():
        return [path]
    runs = [log.parent for log in sorted(path.rglob(LINES)) if read_progress(log.parent)]
    if not runs:
        raise NotFoundError(f"there is no run in {path} that has learnt for a generation")
    return runs


def _from_run(folder: Path) -> Curve:
    try:
        manifest = open_run(folder).manifest
    except NotFoundError:
        raise
    except RunError as error:
        raise RunError(f"{folder}: {error}", f"its {TABLE} can be drawn all the same") from error
    lesson = replace(manifest, seed=0, weights={}).identity
    return Curve(manifest.name, read_progress(folder), folder, "", lesson, read_failure(folder))


def _from_table(path: Path) -> Curve:
    try:
        header, *rows = [row for row in csv.reader(StringIO(_text(path), newline="")) if row] or [[]]
    except (OSError, EOFError, zlib.error) as error:
        raise NotFoundError(f"{path} cannot be read: {getattr(error, 'strerror', None) or error}") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise RunError(f"{path} is not a table of text") from error
    if missing := [column for column in REQUIRED_COLUMNS if column not in header]:
        raise RunError(f"{path} is not the log of a run: it has no column {missing[0]}")
    if rows and len(rows[-1]) < len(header):
        rows.pop()  # of a run that is just writing it
    return Curve(path.name.partition(".csv")[0], list(_records(path, header, rows)), path)


def _text(path: Path) -> str:
    """The text of a table, which may be packed; RunError where there is more of it than any run writes."""
    data = read_whole(path, MAX_TABLE_BYTES)
    if path.suffix == ".gz":
        data = gzip.GzipFile(fileobj=BytesIO(data)).read(MAX_TABLE_BYTES + 1)
    if len(data) > MAX_TABLE_BYTES:
        raise RunError(f"{path} is larger than {MAX_TABLE_BYTES >> 20} MiB, and not the log of a run")
    return data.decode("utf-8-sig")


def _records(path: Path, header: list[str], rows: list[list[str]]) -> Iterator[dict[str, float | None]]:
    for line, row in enumerate(rows, 2):
        try:
            cells = dict(zip(header, row, strict=True))
            scores = {name: float(cells[name]) if cells[name] else None for name in SCORES if name in cells}
            counts = {name: int(cells[name]) for name in (*COUNT_COLUMNS, "ticks") if name in cells}
            if not all(map(is_whole, counts.values())):
                raise ValueError("it has no number")
            yield counts | scores
        except ValueError as error:
            raise RunError(f"{path}, line {line}: not a generation of a log") from error


@dataclass(frozen=True, slots=True)
class MeanPoint:
    """The mean of a score after a generation; its standard error, which one attempt alone does not have."""

    generation: int
    mean: float
    error: float | None


@dataclass(frozen=True, slots=True)
class MeanCurve:
    """The runs of one lesson, which differ in their seeds; `note` tells it from others of its name."""

    name: str
    note: str
    runs: Sequence[Curve]

    @property
    def attempts(self) -> int:
        return sum(len(run.attempts) for run in self.runs)

    @property
    def generations(self) -> int:
        """How far the mean goes: to the end of the longest attempt, or as far as all have come that still go on."""
        every = [(run, attempt) for run in self.runs for attempt in run.attempts]
        going_on = [run.last(attempt) for run, attempt in every if not run.has_ended(attempt)]
        return min(going_on, default=max(run.last(attempt) for run, attempt in every))

    def points(self, column: str) -> list[MeanPoint]:
        """The mean of a score at every generation that has one; none where an attempt never had a finite one.

        An attempt that has ended, or was given up, has come to what it had last: it keeps it, so that the mean does not
        rise because the bad ones are gone.
        """
        found = [run.points(attempt, column) for run in self.runs for attempt in run.attempts]
        if not all(found):
            return []
        tracks = [tuple(zip(*track, strict=True)) for track in found]  # generations, and their scores
        known = np.unique(np.concatenate([generations for generations, _ in tracks]))
        known = known[(known >= max(generations[0] for generations, _ in tracks)) & (known <= self.generations)]
        had_last = [np.array(scores)[np.searchsorted(made, known, side="right") - 1] for made, scores in tracks]
        return [_mean(*each) for each in zip(known.tolist(), np.stack(had_last, axis=1), strict=True)]

    def verdict(self) -> MeanPoint | None:
        """The mean of what the attempts came to, on layouts that chose nothing; None while one goes on."""
        verdicts = [run.points(attempt, "verdict") for run in self.runs for attempt in run.attempts]
        return _mean(self.generations, [track[-1][1] for track in verdicts]) if all(verdicts) else None

    def data(self) -> dict[str, Any]:
        verdict = self.verdict()
        return {
            "name": self.name,
            "runs": [str(run.path) for run in self.runs],
            "attempts": self.attempts,
            "ticks" if self.runs[0].is_along_ticks else "generations": self.generations,
            "verdict_mean": verdict.mean if verdict else None,
            "verdict_standard_error": verdict.error if verdict else None,
        }


def by_lesson(curves: Iterable[Curve]) -> list[MeanCurve]:
    """The curves whose runs teach the same lesson of the same mind together; tables of logs by their name."""
    groups: dict[tuple[str, str], list[Curve]] = {}
    for curve in curves:
        groups.setdefault((curve.name, curve.lesson), []).append(curve)
    return [MeanCurve(name, _note(runs), runs) for (name, _), runs in groups.items()]


def _note(runs: Sequence[Curve]) -> str:
    attempts = sum(len(run.attempts) for run in runs)
    failed = sum(bool(run.failure) for run in runs)
    told = f"{attempts} attempt{'s' * (attempts > 1)} in {len(runs)} run{'s' * (len(runs) > 1)}"
    return f"{told}, {failed} of them failed" if failed else told


def _mean(generation: int, scores: Sequence[float] | NDArray[np.float64]) -> MeanPoint:
    error = float(np.std(scores, ddof=1)) / sqrt(len(scores)) if len(scores) > 1 else None
    return MeanPoint(generation, float(np.mean(scores)), error)
