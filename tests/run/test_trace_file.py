"""`mindc run --trace`: a run as a table."""

import csv
import json
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from io import BytesIO, StringIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray
from pyarrow import parquet

from mindlang.compiler.compile import load
from mindlang.run.recorded_run import RecordedRun, record_run
from mindlang.run.setup import set_up
from mindlang.run.tables import csv_parts, trace_bytes, trace_table
from tests.calling import Call


def rows(text: str) -> list[dict[str, str]]:
    """A CSV file as spreadsheets read it."""
    return list(csv.DictReader(StringIO(text)))


def recorded(file: Path, task: str, seed: int) -> RecordedRun:
    """A run of a mind that has nothing to learn."""
    setup = set_up(str(file), load(file), task, None)
    return record_run(setup, setup.rollout(), seed)


def test_the_last_row_is_what_the_run_came_to(mindc: Call, rules: Path, tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    said = mindc("run", rules, "--task", "Chase", "--seed", 3, "--trace", path, "--json")
    found, table = json.loads(said.out), rows(path.read_text())
    assert len(table) == found["ticks"]
    assert [row["tick"] for row in table] == [str(i + 1) for i in range(len(table))]
    assert float(table[-1]["total"]) == found["score"]
    for line, paid in found["by_line"].items():
        assert float(table[-1][f"total {line}"]) == paid
    for event, times in found["by_event"].items():
        assert sum(int(row[f"event {event}"]) for row in table) == times
    assert f"{path}: a row for each of 1,200 ticks" in said.err


def test_every_reading_influence_and_command_is_there_to_the_bit(rules: Path) -> None:
    run = recorded(rules, "Chase", 3)
    table = rows(trace_bytes(run, ".csv").decode())
    for i, skill in enumerate(run.graph.skills):
        written = np.array([row[f"influence {skill.name}"] for row in table], np.float32)
        assert np.array_equal(written, run.influence[:, i])
    for i, actuator in enumerate(run.graph.actuators):
        written = np.array([row[f"command {actuator.name}"] for row in table], np.float32)
        assert np.array_equal(written, run.commands[:, i])
    for sensor in run.graph.sensors:
        for k in range(sensor.width):
            name = f"reading {sensor.name}" + f" {k + 1}" * (sensor.width > 1)
            written = np.array([row[name] for row in table], np.float32)
            assert np.array_equal(written, run.readings[:, sensor.start + k])
    assert np.array_equal(np.array([row["x"] for row in table], float), run.body[1:, 0])


def test_parquet_says_the_same(rules: Path) -> None:
    run = recorded(rules, "Chase", 3)
    table = parquet.read_table(BytesIO(trace_bytes(run, ".parquet"))).to_pydict()
    expected = trace_table(run)
    assert list(table) == list(expected)
    for name, column in expected.items():
        is_number = column.dtype.kind == "f"
        assert np.array_equal(np.array(table[name], column.dtype), column, equal_nan=is_number), name
        is_empty = np.isnan(column) if is_number else np.zeros(len(column), bool)
        assert [value is None for value in table[name]] == is_empty.tolist(), name


@pytest.mark.parametrize("precision", [np.float32, np.float64])
def test_the_largest_and_the_smallest_numbers_are_written_shortly(precision: type[np.floating[Any]]) -> None:
    known = np.finfo(precision)
    for number in (known.max, known.tiny, known.smallest_subnormal, -known.smallest_subnormal):
        text = b"".join(csv_parts({"a": np.array([number], precision)})).decode().split("\n")[1]
        assert _says(text, number)
        assert not any(_says(shorter, number) for shorter in _shorter(text))


@pytest.mark.parametrize("precision", [np.float32, np.float64])
@given(data=st.data())
def test_a_number_that_is_written_is_read_again(precision: type, data: st.DataObject) -> None:
    width = st.floats(width=32) if precision is np.float32 else st.floats()
    column: NDArray[np.float64] = data.draw(arrays(precision, st.integers(1, 20), elements=width))
    texts = [row["a"] for row in rows(b"".join(csv_parts({"a": column, "b": column})).decode())]
    for text, number in zip(texts, column, strict=True):
        assert (text == "") == (not np.isfinite(number))
        assert text == "" or precision(text).tobytes() == precision(number).tobytes()
        assert text == "" or _digits(text) <= _digits(repr(float(number)))
        assert text == "" or not any(_says(shorter, number) for shorter in _shorter(text))


def _digits(text: str) -> int:
    """How many digits say something: 1000000000000000.0 has one, and 999999986991104.0, the same single, has 15."""
    return len(text.partition("e")[0].replace(".", "").lstrip("-0").rstrip("0"))


def _says(text: str, number: np.floating[Any]) -> bool:
    with np.errstate(over="ignore"):  # the neighbour above the largest
        return type(number)(text).tobytes() == number.tobytes()


def _shorter(text: str) -> list[str]:
    """Both neighbours of a number that has one digit less."""
    exact = Decimal(text)
    digits = len(exact.normalize().as_tuple().digits) - 1
    rounded = (Context(digits, mode).plus(exact) for mode in (ROUND_FLOOR, ROUND_CEILING)) if digits else ()
    return [str(each) for each in rounded]


@given(names=st.lists(st.text(min_size=1), min_size=1, max_size=5, unique=True))
def test_any_name_is_one_column(names: list[str]) -> None:
    text = b"".join(csv_parts({name: np.arange(2) for name in names})).decode()
    assert next(csv.reader(StringIO(text, newline=""))) == names


def test_another_suffix_is_refused_before_anything_runs(mindc: Call, rules: Path, tmp_path: Path) -> None:
    said = mindc("run", rules, "--trace", tmp_path / "run.xls")
    assert (said.code, said.out) == (2, "")
    assert "must end in .csv or .parquet" in said.err


def test_without_pyarrow_it_says_what_to_install(
    mindc: Call, rules: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(__import__("sys").modules, "pyarrow", None)
    said = mindc("run", rules, "--trace", tmp_path / "run.parquet")
    assert said.code == 2
    assert "pip install" in said.err
    assert not (tmp_path / "run.parquet").exists()
