"""Many runs of a task as a table, a row for each: what `mindc bench --csv` writes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from mindrun.graph.graph import Task
from mindrun.train.scoring import succeeded

from mindlang.run.columns import Column, columns
from mindlang.run.outcome import TIME, ended_by, events

if TYPE_CHECKING:
    from mindrun.graph.run_scores import Scores


def runs_table(task: Task, scores: Scores, seeds: Sequence[int]) -> dict[str, Column]:
    """The columns of the runs of one genome by name, named as those of a trace.

    `seed`, with which `mindc run --seed` repeats the run; `score`; `total`, what each reward line has paid; `event`,
    how often each event has happened; `ticks`; `ended by`, which is `time` where the run lasted its time; `succeeded`,
    1 or 0, where the task can succeed; `faults`, values that were not finite numbers.
    """
    return columns(_columns(task, scores, seeds))


def joined(tables: Mapping[str, Mapping[str, Column]]) -> dict[str, Column]:
    """The rows of several tables one after the other, and in a first column `mind` the name of each.

    What one of them has no column for is NaN there, and nothing in a file.
    """
    rows = {name: len(table["seed"]) for name, table in tables.items()}
    names = dict.fromkeys(column for table in tables.values() for column in table)
    whole = {
        name: np.concatenate([table.get(name, np.full(rows[of], np.nan)) for of, table in tables.items()])
        for name in names
    }
    return {"mind": np.repeat([*rows], [*rows.values()])} | whole


def _columns(task: Task, scores: Scores, seeds: Sequence[int]) -> Iterator[tuple[str, Column]]:
    yield "seed", np.array(seeds, np.uint64)
    yield "score", scores.total[0]
    for i, reward in enumerate(task.rewards):
        yield f"total {reward.text}", scores.by_line[0, :, i]
    for i, event in enumerate(events(task)):
        yield f"event {event}", scores.by_event[0, :, i]
    yield "ticks", scores.ticks[0]
    yield "ended by", np.array([ended_by(task, number) or TIME for number in scores.ended_by[0].tolist()])
    if task.can_succeed:
        yield "succeeded", succeeded(task, scores)[0].astype(np.int64)
    yield "faults", scores.faults[0]
