"""Rows of a recording as the columns that a page is sent: of a robot's day, of a dry run and of a run alike."""

from __future__ import annotations

from typing import Any

import numpy as np
from mindrun.graph.recording_header import POSE_COLUMNS, THING_COLUMNS, RecordedWorld
from numpy.typing import NDArray

from mindlang.view.columns import DOUBLE_BLOCK, FLOW, SINGLE_BLOCK, Columns
from mindlang.view.row_blocks import Chunk, Doubles, Singles

Rows = NDArray[Any]
NOTHING_HELD = -1
UNKNOWN_AT_FIRST = "readings", "commands", "sent"


def world_columns(things: int, rewards: int) -> tuple[dict[str, int], dict[str, int]]:
    """The groups of doubles and of singles that a world of so many things and reward lines has."""
    doubles = {"robot": POSE_COLUMNS, "things": THING_COLUMNS * things, "battery": 1, "rewards": rewards}
    return doubles, {"held": 1, "touching": 1}


def beginning(columns: Columns, world: RecordedWorld | None) -> Chunk:
    """The row of tick 0, in which nothing has been read, thought or sent."""
    doubles = np.full((1, columns.width(DOUBLE_BLOCK)), np.nan)
    singles = np.zeros((1, columns.kept_singles), np.float32)
    for group in (columns.groups[name] for name in UNKNOWN_AT_FIRST if name in columns.groups):
        singles[0, group.first : group.first + group.count] = np.nan
    if world is not None:
        begin = np.array(world.begin, np.float64)  # None becomes NaN
        values = (*begin, np.nan, *np.zeros(world.rewards))
        doubles[0, columns["robot"].first :][: len(values)] = values
        singles[0, columns["held"].first] = NOTHING_HELD
    return Chunk(doubles, singles)


def blocks(rows: Rows, columns: Columns, readings: Singles) -> tuple[Doubles, Singles]:
    """Both blocks [ticks, columns] of rows whose readings are these; `flow` is not kept."""
    values: dict[int, list[NDArray[Any]]] = {DOUBLE_BLOCK: [], SINGLE_BLOCK: []}
    for name, group in columns.groups.items():
        if name != FLOW:
            values[group.block].append(_value(name, rows, readings).reshape(len(rows), group.count))
    singles = [each.astype(np.float32) for each in values[SINGLE_BLOCK]]  # bits of readings stay what they are
    return np.concatenate(values[DOUBLE_BLOCK], axis=1), np.concatenate(singles, axis=1)


def _value(name: str, rows: Rows, readings: Singles) -> NDArray[Any]:
    match name:
        case "readings":
            return readings
        case "robot":
            return rows["world"]["pose"]
        case "things":
            return _shown(rows["world"]["things"])
        case "battery" | "rewards" | "held" | "touching":
            return rows["world"][name]
    return rows[name]


def _shown(things: Doubles) -> Doubles:
    """Things [ticks, things, 4] without those of no size, which nobody could draw: they are nowhere."""
    has_size = (things[:, :, 2] >= 0) & np.isfinite(things[:, :, 2])
    return np.where(has_size[:, :, None], things, np.nan)
