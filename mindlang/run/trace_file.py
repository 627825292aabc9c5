"""A run as a table, a row for each tick, in a file for spreadsheets and notebooks: CSV, or Parquet by pyarrow."""

from __future__ import annotations

from collections.abc import Iterator
from io import BytesIO

import numpy as np
from mindrun.errors import MindError
from mindrun.graph.named_readings import reading_names
from mindrun.graph.run_scores import score_of

from mindlang.run.columns import Column, columns, csv_bytes
from mindlang.run.outcome import events
from mindlang.run.recorded_run import RecordedRun


def trace_table(run: RecordedRun) -> dict[str, Column]:
    """The columns of a run by name, each with a row for each tick.

    `tick` from 1 and `time` in seconds; where the robot is (`x`, `y` in units, `angle` in radians), each thing
    (`ball x`, NaN while it is nowhere), what the claw holds and the `battery`, as they are after the step of the tick,
    all of it but in environments; `reading`, `influence` and `command` of each name, 0 to 1, from before the step;
    `event`, how often it happened in this tick; `total`, the sum of each reward line so far, and of them all. What was
    not measured is NaN: a sensor that neither a skill below the master nor a reward reads, the influence of a skill
    that is not below it, a battery that nobody asks for. A name that several have is numbered, from 1 on.
    """
    world = () if run.task.scene.environment else _world(run)
    return columns([*_time(run), *world, *_mind(run), *_task(run)])


def trace_bytes(run: RecordedRun, suffix: str) -> bytes:
    """The table as a file of that suffix; MindError where pyarrow is needed and not there."""
    table = trace_table(run)
    return csv_bytes(table) if suffix == ".csv" else _parquet(table)


def _time(run: RecordedRun) -> Iterator[tuple[str, Column]]:
    yield "tick", np.arange(1, run.ticks + 1)
    yield "time", np.arange(1, run.ticks + 1) * run.graph.tick


def _world(run: RecordedRun) -> Iterator[tuple[str, Column]]:
    for k, name in enumerate(("x", "y", "angle")):
        yield name, run.body[1:, k]
    for i, thing in enumerate(run.contents):
        for k, name in enumerate(("x", "y", "size")):
            yield f"{thing.name} {name}", np.where(np.isfinite(run.things[1:, i, k]), run.things[1:, i, k], np.nan)
    names = np.array([*(thing.name for thing in run.contents), ""])
    yield "held", names[run.held[1:]]
    yield "touching", run.touching.astype(np.int64)
    yield "battery", run.battery


def _mind(run: RecordedRun) -> Iterator[tuple[str, Column]]:
    graph = run.graph
    for name, column in zip(reading_names(graph), run.readings.T[: graph.width], strict=True):
        yield f"reading {name}", column
    for i, skill in enumerate(graph.skills):
        yield f"influence {skill.name}", run.influence[:, i]
    for i, actuator in enumerate(graph.actuators):
        yield f"command {actuator.name}", run.commands[:, i]


def _task(run: RecordedRun) -> Iterator[tuple[str, Column]]:
    happened = np.diff(run.events, axis=0, prepend=0)
    for i, name in enumerate(events(run.task)):
        yield f"event {name}", happened[:, i]
    for i, reward in enumerate(run.task.rewards):
        yield f"total {reward.text}", run.lines[:, i]
    yield "total", score_of(run.lines)


def _parquet(table: dict[str, Column]) -> bytes:
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError as error:
        raise MindError("parquet files need pyarrow", "pip install 'mindlang[parquet]', or a name with .csv") from error
    file = BytesIO()
    empty_where_nan = {name: pyarrow.array(column, from_pandas=True) for name, column in table.items()}
    parquet.write_table(pyarrow.table(empty_where_nan), file)
    return file.getvalue()
