"""A value that a viewer has edited, as a change of the run."""

from __future__ import annotations

from typing import get_args

from mindrun.engine.changes import Change, What
from mindrun.graph.graph import Graph, Task
from mindrun.graph.named_readings import reading_names

from mindlang.view import messages
from mindlang.view.columns import Columns
from mindlang.view.messages import RefusedError
from mindlang.view.texts import shown

GROUPS: dict[What, str] = {"reading": "readings", "influence": "influence", "memory": "readings"}


def replacement(graph: Graph, task: Task, columns: Columns, asked: messages.Change) -> Change:
    """The change that was asked for; RefusedError where there is no such value, or no such tick."""
    what = next(each for each in get_args(What) if each == asked.what)
    block, index = asked.column
    group = columns[GROUPS[what]]
    row = index - group.first
    sensed = sum(sensor.width for sensor in graph.sensors)
    first, last = {"reading": (0, sensed), "influence": (0, group.count), "memory": (sensed, group.count)}[what]
    if block != group.block or not first <= row < last:
        raise RefusedError(f"column {index} of block {block} has no {what}")
    if asked.tick > task.ticks:
        raise RefusedError(f"tick is a whole number from 1 to {task.ticks}")
    return Change(what, row, (asked.value,), asked.tick, asked.tick + asked.lasts - 1)


def replacement_text(graph: Graph, change: Change) -> str:
    """The change in words."""
    of_skill = change.what == "influence"
    name = graph.skills[change.row].name if of_skill else reading_names(graph)[change.row]
    what = f"the influence of {name} is" if of_skill else f"{name} is"
    ticks = f"tick {change.first}" if change.first == change.last else f"ticks {change.first} to {change.last}"
    return shown(f"{what} {change.values[0]:g} in {ticks}")
