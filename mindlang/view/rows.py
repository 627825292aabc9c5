"""Rows of a run: which column is what, the parts in which they came, and the frames in which a page gets them.

A row has two blocks, doubles and singles, each of groups side by side.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any, TypeVar

import numpy as np
from mindrun.graph.recording_header import POSE_COLUMNS, THING_COLUMNS, RecordedWorld
from numpy.typing import NDArray

DOUBLE_BLOCK, SINGLE_BLOCK = 0, 1  # blocks
FLOW = "flow"  # the last group of singles: it is not kept, but computed for the rows that are asked for
Doubles = NDArray[np.float64]
Singles = NDArray[np.float32]
TickNumbers = NDArray[np.int64]
Number = TypeVar("Number", np.float64, np.float32)
MERGED_ROWS = 256
HEADER = struct.Struct("<6I")
ROWS_KIND, COLUMNS_KIND = 1, 2
MAX_FRAME_BYTES = 4 << 20
DOUBLE_BYTES, SINGLE_BYTES = 8, 4
Rows = NDArray[Any]
NOTHING_HELD = -1
UNKNOWN_AT_FIRST = "readings", "commands", "sent"


@dataclass(frozen=True, slots=True)
class Group:
    """Columns side by side: `count` of them from `first` on in a block."""

    block: int
    first: int
    count: int

    def column(self, number: int) -> list[int]:
        """The address of one of its columns."""
        return [self.block, self.first + number]


@dataclass(frozen=True, slots=True)
class Columns:
    """The groups of a row by their names."""

    groups: Mapping[str, Group]

    @classmethod
    def of(cls, doubles: Mapping[str, int], singles: Mapping[str, int]) -> Columns:
        """Groups of so many columns each, in this order; `flow`, where there is one, is the last of the singles."""
        groups: dict[str, Group] = {}
        for block, counts in ((DOUBLE_BLOCK, doubles), (SINGLE_BLOCK, singles)):
            first = 0
            for name, count in counts.items():
                groups[name] = Group(block, first, count)
                first += count
        return cls(groups)

    def __getitem__(self, name: str) -> Group:
        return self.groups[name]

    def width(self, block: int) -> int:
        """How many columns a block has."""
        return sum(group.count for group in self.groups.values() if group.block == block)

    @property
    def kept_singles(self) -> int:
        """How many columns of the singles are kept."""
        return self.width(SINGLE_BLOCK) - (self.groups[FLOW].count if FLOW in self.groups else 0)


@dataclass(frozen=True, slots=True)
class Chunk:
    """Some ticks, one after the other: `doubles` [ticks, columns], `singles` [ticks, columns that are kept].

    `happened` has pairs of a tick and the number of an event, `stops` of a tick and the breakpoint that holds there;
    `ended_by` is what ended the run, in the last chunk of all.
    """

    doubles: Doubles
    singles: Singles
    happened: tuple[tuple[int, int], ...] = ()
    ended_by: str | None = None
    is_last: bool = False
    stops: tuple[tuple[int, str], ...] = ()


@dataclass(slots=True)
class RowBlocks:
    """Rows by their tick, from 0 on. One thread adds rows while others read those that were there before."""

    chunks: list[Chunk] = field(default_factory=list)
    firsts: list[int] = field(default_factory=list)  # the tick of the first row of each chunk
    rows: int = 0
    kept_bytes: int = 0

    def append(self, chunk: Chunk) -> None:
        """Put a chunk behind all others; its rows are there when `rows` counts them.

        Small ones become one: of what is seen live, each tick is a chunk.
        """
        if not len(chunk.doubles):
            return
        if self.chunks and len(self.chunks[-1].doubles) + len(chunk.doubles) <= MERGED_ROWS:
            last = self.chunks[-1]
            doubles, singles = ((last.doubles, chunk.doubles), (last.singles, chunk.singles))
            self.chunks[-1] = Chunk(np.concatenate(doubles), np.concatenate(singles))
        else:
            self.chunks.append(chunk)
            self.firsts.append(self.rows)
        self.kept_bytes += chunk.doubles.nbytes + chunk.singles.nbytes
        self.rows += len(chunk.doubles)

    def ticks(self, first: int, below: int, every: int, most: int) -> TickNumbers:
        """The ticks first, first + every … that are below `below` and known, and of these no more than `most`."""
        return np.arange(first, min(below, self.rows, first + every * most), every, dtype=np.int64)

    def doubles(self, ticks: TickNumbers, columns: Sequence[int] | None = None) -> Doubles:
        """The doubles [ticks, columns] of ticks in rising order; of `columns` alone, or of all."""
        parts = [_part(self.chunks[chunk].doubles, rows, columns) for chunk, rows in self._places(ticks)]
        return np.concatenate(parts) if parts else _part(self.chunks[0].doubles, ticks, columns)

    def singles(self, ticks: TickNumbers, columns: Sequence[int] | None = None) -> Singles:
        """The singles [ticks, columns] that are kept, in the same way."""
        parts = [_part(self.chunks[chunk].singles, rows, columns) for chunk, rows in self._places(ticks)]
        return np.concatenate(parts) if parts else _part(self.chunks[0].singles, ticks, columns)

    def _places(self, ticks: TickNumbers) -> list[tuple[int, TickNumbers]]:
        """For each chunk with some of the ticks: its number, and their rows in it."""
        firsts = np.array(self.firsts)
        of_chunk = np.searchsorted(firsts, ticks, side="right") - 1
        bounds = np.flatnonzero(np.diff(of_chunk, prepend=-1, append=len(firsts)))
        return [(of_chunk[row], ticks[row:below] - firsts[of_chunk[row]]) for row, below in pairwise(bounds.tolist())]


def _part(block: NDArray[Number], rows: TickNumbers, columns: Sequence[int] | None) -> NDArray[Number]:
    return block[rows] if columns is None else block[rows[:, None], np.asarray(columns)]


def rows_that_fit(doubles: int, singles: int) -> int:
    """How many rows of so many columns a frame can hold, at least one."""
    size = DOUBLE_BYTES * doubles + SINGLE_BYTES * singles
    return max(1, (MAX_FRAME_BYTES - HEADER.size) // max(1, size))


def rows_frame(fork: int, ask: int, first: int, every: int, doubles: Doubles, singles: Singles) -> bytes:
    """Rows: the doubles [rows, columns], row after row, then the singles."""
    header = HEADER.pack(ROWS_KIND, fork, first, every, len(doubles), ask)
    return b"".join((header, doubles.astype("<f8").tobytes(), singles.astype("<f4").tobytes()))


def columns_frame(fork: int, ask: int, first: int, every: int, values: Doubles) -> bytes:
    """Columns `values` [rows, columns], one after the other, all as doubles."""
    header = HEADER.pack(COLUMNS_KIND, fork, first, every, len(values), ask)
    return header + values.astype("<f8").tobytes(order="F")


def unpacked(data: bytes, doubles: int, singles: int) -> tuple[int, int, TickNumbers, Doubles, Singles]:
    """The fork, what was asked, the ticks and both blocks of a frame of rows; ValueError where it is none."""
    if len(data) < HEADER.size or HEADER.unpack_from(data)[0] != ROWS_KIND:
        raise ValueError("this is no frame of rows")
    _, fork, first, every, rows, ask = HEADER.unpack_from(data)
    middle = HEADER.size + DOUBLE_BYTES * doubles * rows
    if len(data) != middle + SINGLE_BYTES * singles * rows:
        raise ValueError(f"a frame of {rows} rows has another length than {len(data)} bytes")
    wide = np.frombuffer(data[HEADER.size : middle], "<f8").reshape(rows, doubles)
    narrow = np.frombuffer(data[middle:], "<f4").reshape(rows, singles)
    return fork, ask, first + every * np.arange(rows), wide, narrow


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
