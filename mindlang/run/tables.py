"""Runs as tables for spreadsheets and notebooks: one run with a row a tick, many with a row each; CSV, or Parquet."""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np
from mindrun.errors import MindError
from mindrun.graph.draws import drawn_numbers
from mindrun.graph.graph import Task
from mindrun.graph.named_readings import reading_names
from mindrun.graph.run_scores import Scores, score_of
from mindrun.train.scoring import succeeded
from numpy.typing import NDArray

from mindlang.run.outcome import TIME, ended_by, events

if TYPE_CHECKING:
    from mindlang.run.recorded_run import RecordedRun

Column = NDArray[Any]
Table = Mapping[str, Column]
SLICE_ROWS = 10_000  # rows whose texts are in memory at a time


def trace_table(run: "RecordedRun") -> dict[str, Column]:
    """The columns of a run by name, each with a row for each tick.

    `tick` from 1 and `time` in seconds; what the task has `drawn` for the run; where the robot is (`x`, `y` in units,
    `angle` in radians), each thing (`ball x`, NaN while it is nowhere), what the claw holds and the `battery`, as they
    are after the step of the tick, all of it but in environments;
    `reading`, `influence` and `command` of each name, 0 to 1, from before the step;
    `event`, how often it happened in this tick; `total`, the sum of each reward line so far, and of them all. What was
    not measured is NaN: a sensor that neither a skill below the master nor a reward reads, the influence of a skill
    that is not below it, a battery that nobody asks for. A name that several have is numbered, from 1 on.
    """
    graph, ticks = run.graph, np.arange(1, run.ticks + 1)
    readings, influence, commands = run.readings.T[: graph.width], run.influence.T, run.commands.T
    happened = np.diff(run.events, axis=0, prepend=0)
    return _numbered(
        [
            ("tick", ticks),
            ("time", ticks * graph.tick),
            *((f"drawn {name}", np.full(run.ticks, number)) for name, number in run.drawn.items()),
            *(() if run.task.scene.environment else _world(run)),
            *((f"reading {name}", column) for name, column in zip(reading_names(graph), readings, strict=True)),
            *((f"influence {skill.name}", influence[i]) for i, skill in enumerate(graph.skills)),
            *((f"command {actuator.name}", commands[i]) for i, actuator in enumerate(graph.actuators)),
            *((f"event {name}", happened[:, i]) for i, name in enumerate(events(run.task))),
            *((f"total {reward.text}", run.lines[:, i]) for i, reward in enumerate(run.task.rewards)),
            ("total", score_of(run.lines)),
        ]
    )


def _world(run: "RecordedRun") -> Iterator[tuple[str, Column]]:
    yield from zip(("x", "y", "angle"), run.body[1:].T, strict=False)
    itself = f"robot {run.setup.robot}"
    for i, (thing, label) in enumerate(zip(run.contents, run.labels, strict=True)):
        if label == itself:
            continue
        for k, name in enumerate(("x", "y", "size")):
            yield f"{label} {name}", np.where(np.isfinite(run.things[1:, i, k]), run.things[1:, i, k], np.nan)
        if thing.kind.is_robot:
            yield f"{label} angle", run.turned[1:, i]
    names = np.array([*(thing.name for thing in run.contents), ""])
    yield "held", names[run.held[1:]]
    yield "touching", run.touching.astype(np.int64)
    yield "battery", run.battery


def runs_table(task: Task, scores: Scores, seeds: Sequence[int]) -> dict[str, Column]:
    """The columns of the runs of one genome by name, named as those of a trace: what `mindc bench --csv` writes.

    `seed`, with which `mindc run --seed` repeats the run; what the task has `drawn` for it; `score`; `total`, what
    each reward line has paid; `event`, how often each event has happened; `ticks`; `ended by`, which is `time` where
    the run lasted its time; `succeeded`, 1 or 0, where the task can succeed; `faults`, values that were not finite
    numbers.
    """
    drawn = [drawn_numbers(task.draws, seed) for seed in seeds]
    ended = [ended_by(task, number) or TIME for number in scores.ended_by[0].tolist()]
    return _numbered(
        [
            ("seed", np.array(seeds, np.uint64)),
            *((f"drawn {draw.name}", np.array([each[draw.name] for each in drawn])) for draw in task.draws),
            ("score", scores.total[0]),
            *((f"total {reward.text}", scores.by_line[0, :, i]) for i, reward in enumerate(task.rewards)),
            *((f"event {event}", scores.by_event[0, :, i]) for i, event in enumerate(events(task))),
            ("ticks", scores.ticks[0]),
            ("ended by", np.array(ended)),
            *([("succeeded", succeeded(task, scores)[0].astype(np.int64))] if task.can_succeed else []),
            ("faults", scores.faults[0]),
        ]
    )


def joined(tables: Mapping[str, Table], first: str = "mind") -> dict[str, Column]:
    """The rows of several tables of runs, a first column with the name of each; NaN where one has no column."""
    rows = {name: len(table["seed"]) for name, table in tables.items()}
    names = dict.fromkeys(column for table in tables.values() for column in table)
    whole = {
        name: np.concatenate([table.get(name, np.full(rows[of], np.nan)) for of, table in tables.items()])
        for name in names
    }
    return {first: np.repeat([*rows], [*rows.values()])} | whole


def _numbered(named: Iterable[tuple[str, Column]]) -> dict[str, Column]:
    """The columns by name; a name that several have is numbered, from 1 on."""
    pairs = list(named)
    times = Counter(name for name, _ in pairs)
    seen: Counter[str] = Counter()
    table = {}
    for name, column in pairs:
        seen[name] += 1
        table[f"{name} {seen[name]}" if times[name] > 1 else name] = column
    return table


def trace_bytes(run: "RecordedRun", suffix: str) -> bytes:
    """The trace of a run as a file of that suffix; MindError where pyarrow is needed and not there."""
    table = trace_table(run)
    if suffix == ".csv":
        return b"".join(csv_parts(table))
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError as error:
        raise MindError("parquet files need pyarrow", "pip install 'mindlang[parquet]', or a name with .csv") from error
    file = BytesIO()
    empty_where_nan = {name: pyarrow.array(column, from_pandas=True) for name, column in table.items()}
    parquet.write_table(pyarrow.table(empty_where_nan), file)
    return file.getvalue()


def csv_parts(table: Table) -> Iterator[bytes]:
    """The table as CSV, a line of names and one for each row, part after part: not all of it is in memory as text."""
    yield (",".join(map(_quoted, table)) + "\n").encode()
    for begin in range(0, max(map(len, table.values())), SLICE_ROWS):
        texts = [_texts(column[begin : begin + SLICE_ROWS]) for column in table.values()]
        yield "\n".join([*map(",".join, zip(*texts, strict=True)), ""]).encode()


def _quoted(name: str) -> str:
    return '"' + name.replace('"', '""') + '"' if set(name) & set('",\n\r') else name


def _texts(column: Column) -> list[str]:
    """Each number with the fewest digits that give it back; nothing where it is not finite."""
    if column.dtype.kind in "US":
        return list(map(_quoted, column.tolist()))
    if column.dtype == np.float32:
        texts = [repr(float(text)) if "e" in text else text for text in map(str, column)]  # 1e6 is no 1e+06
    else:
        texts = list(map(repr, column.tolist()))
    for row in np.flatnonzero(~np.isfinite(column)):
        texts[row] = ""
    return texts
