"""The log of a run: what is written is read, up to where the run stands, or to the first line that is none."""

import csv
import json
import os
from dataclasses import asdict, replace
from math import inf
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.train import training
from mindrun.train.lesson_state import Course, LessonState, Record, begin
from mindrun.train.population import Population
from mindrun.train.progress import LINES, TABLE, ProgressLog, read_progress

from tests.draws import cases
from tests.train.climbing import LENGTH, lesson

FIRST = Record(1, 1, 2.5, -1.25, 3.0, None, 100, 0.5, 0)
NUMBERS = st.floats(allow_nan=False)
RECORDS = st.builds(
    Record,
    st.integers(1, 5),
    st.integers(1, 9),
    NUMBERS,
    NUMBERS,
    st.none() | NUMBERS,
    st.none() | NUMBERS,
    st.integers(0, 2**53),
    st.floats(0, 1e9),
    st.integers(0, 2**53),
)


def at(attempt: int, generation: int) -> LessonState:
    """A state that has so many attempts, and so many generations of the next one, behind it."""
    state = begin(Course(lesson(), 1, np.empty((0, LENGTH), np.float32)))
    population = Population(state.now.population.genomes, np.empty(0), generation)
    return replace(state, attempt=attempt, now=replace(state.now, population=population))


def finite(record: Record) -> dict[str, object]:
    """As it is read: None for what is not finite."""
    return {name: None if value in (inf, -inf) else value for name, value in asdict(record).items()}


@given(st.lists(RECORDS, max_size=6))
@settings(max_examples=cases(25))
def test_what_is_logged_is_read(tmp_path_factory: pytest.TempPathFactory, records: list[Record]) -> None:
    folder = tmp_path_factory.mktemp("run")
    with ProgressLog(folder, at(0, 0)) as progress:
        for record in records:
            progress.append(record)
        progress.sync()
    assert read_progress(folder) == [finite(record) for record in records]
    with (folder / TABLE).open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    assert rows[0] == list(asdict(FIRST))
    said = [["" if value is None else str(value) for value in finite(record).values()] for record in records]
    assert rows[1:] == said


@pytest.mark.parametrize("attempt", [0, 1, 2])
@pytest.mark.parametrize("generation", [0, 1, 2, 3])
def test_what_the_state_has_not_behind_it_is_dropped(tmp_path: Path, attempt: int, generation: int) -> None:
    numbers = [(a, g) for a in (1, 2, 3) for g in (1, 2, 3)]
    with ProgressLog(tmp_path, at(0, 0)) as progress:
        for a, g in numbers:
            progress.append(replace(FIRST, attempt=a, generation=g))
    with ProgressLog(tmp_path, at(attempt, generation)) as progress:
        progress.append(replace(FIRST, attempt=9, generation=9))
    kept = [(a, g) for a, g in numbers if a <= attempt or (a == attempt + 1 and g <= generation)]
    assert [(record["attempt"], record["generation"]) for record in read_progress(tmp_path)] == [*kept, (9, 9)]
    assert len((tmp_path / TABLE).read_text().splitlines()) == 1 + len(kept) + 1


STRANGE: dict[str, object] = {
    "attempt": 0, "generation": 0, "best": "2.5", "mean": True, "reevaluated": [], "verdict": {}, "ticks": 2**53 + 1,
    "seconds": "", "faults": -(2**53) - 1,
}  # fmt: skip


@pytest.mark.parametrize("name", STRANGE)
def test_the_log_ends_before_a_line_that_no_run_writes(tmp_path: Path, name: str) -> None:
    lines = [json.dumps(finite(FIRST) | changes) for changes in ({}, {name: STRANGE[name]}, {})]
    (tmp_path / LINES).write_text("\n".join([*lines, ""]))
    assert read_progress(tmp_path) == [finite(FIRST)]


@pytest.mark.parametrize(
    "line",
    [
        "", "7", "[]", "{}", "{", "\x00", json.dumps(finite(FIRST) | {"more": 1}),
        json.dumps(dict(reversed(finite(FIRST).items()))), json.dumps(finite(FIRST)).replace("2.5", "NaN"),
        json.dumps(finite(FIRST)).replace("2.5", "1e999"), json.dumps(finite(FIRST)) + " " * 4096,
    ],
)  # fmt: skip
def test_the_log_ends_before_a_line_that_is_none(tmp_path: Path, line: str) -> None:
    whole = json.dumps(finite(FIRST))
    (tmp_path / LINES).write_text("\n".join([whole, whole, line, whole, ""]))
    assert read_progress(tmp_path) == [finite(FIRST)] * 2


def test_a_line_that_does_not_end_is_none(tmp_path: Path) -> None:
    (tmp_path / LINES).write_text(json.dumps(finite(FIRST)))
    assert read_progress(tmp_path) == []
    assert read_progress(tmp_path / "nowhere") == []


def test_numbers_at_their_bounds_are_numbers(tmp_path: Path) -> None:
    bounds = finite(replace(FIRST, ticks=2**53, faults=0)) | {"best": -(2**53), "mean": 0, "seconds": 1e308}
    (tmp_path / LINES).write_text(json.dumps(bounds) + "\n")
    assert read_progress(tmp_path) == [bounds]


def test_what_a_full_disk_takes_in_pieces_is_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write = os.write
    with ProgressLog(tmp_path, at(0, 0)) as progress:
        monkeypatch.setattr(os, "write", lambda descriptor, data: write(descriptor, data[:7]))
        progress.append(FIRST)
        monkeypatch.undo()
    assert read_progress(tmp_path) == [finite(FIRST)]


def test_both_files_are_brought_to_the_disk_and_closed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    synced: list[str] = []
    with ProgressLog(tmp_path, at(0, 0)) as progress:
        monkeypatch.setattr(
            os, "fsync", lambda descriptor: synced.append(Path(f"/proc/self/fd/{descriptor}").readlink().name)
        )
        progress.sync()
        monkeypatch.undo()
        opened = progress._files
    assert synced == [LINES, TABLE]
    for descriptor in opened:
        with pytest.raises(OSError, match="Bad file descriptor"):
            os.fstat(descriptor)


def test_the_log_is_on_the_disk_before_the_checkpoint_that_counts_on_it(monkeypatch: pytest.MonkeyPatch) -> None:
    order: list[str] = []
    monkeypatch.setattr("mindrun.train.checkpoint.save", lambda *given: order.append("checkpoint"))
    run = SimpleNamespace(folder=Path(), manifest=SimpleNamespace(identity="one"))
    training._save(run, at(0, 0), SimpleNamespace(sync=lambda: order.append("log")))  # type: ignore[arg-type]
    assert order == ["log", "checkpoint"]
