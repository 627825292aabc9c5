"""Rows of a run: which column is what, the parts in which they came, and the frames in which a page gets them.

A row has two blocks, doubles and singles, each of groups side by side.
"""

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindlang.view.messages import AskColumns, AskRows

DOUBLE_BLOCK, SINGLE_BLOCK = 0, 1  # blocks
FLOW = "flow"  # the last group of singles: it is not kept, but computed for the rows that are asked for
Doubles = NDArray[np.float64]
Singles = NDArray[np.float32]
TickNumbers = NDArray[np.int64]
HEADER = struct.Struct("<6I")
ROWS_KIND, COLUMNS_KIND = 1, 2
MAX_FRAME_BYTES = 4 << 20
DOUBLE_BYTES, SINGLE_BYTES = 8, 4


@dataclass(frozen=True, slots=True)
class Group:
    """Columns side by side: `count` of them from `first` on in a block."""

    block: int
    first: int
    count: int

    @property
    def places(self) -> range:
        return range(self.first, self.first + self.count)

    def column(self, number: int) -> list[int]:
        return [self.block, self.first + number]


class Columns(dict[str, Group]):
    """The groups of a row by their names."""

    @classmethod
    def of(cls, doubles: Mapping[str, int], singles: Mapping[str, int]) -> "Columns":
        """Groups of so many columns each, in this order; `flow` is the last of the singles."""
        found = cls()
        for block, counts in ((DOUBLE_BLOCK, doubles), (SINGLE_BLOCK, singles)):
            first = 0
            for name, count in counts.items():
                found[name] = Group(block, first, count)
                first += count
        return found

    def width(self, block: int) -> int:
        return sum(group.count for group in self.values() if group.block == block)

    @property
    def kept_singles(self) -> int:
        return self[FLOW].first


@dataclass(slots=True)
class RowBlocks:
    """Rows by their tick, from 0 on. One thread adds rows while others read those that were there before."""

    blocks: list[NDArray[Any]] = field(default_factory=list)  # with room for rows to come
    rows: int = 0
    kept_bytes: int = 0

    def append(self, doubles: Doubles, singles: Singles) -> None:
        """Put rows [rows, columns that are kept] behind all others; they are there when `rows` counts them."""
        end = self.rows + len(doubles)
        parts: list[NDArray[Any]] = [doubles, singles]
        self.blocks = self.blocks or [part[:0] for part in parts]
        for block, part in enumerate(parts):
            if end > len(self.blocks[block]):
                larger = np.empty((2 * end, part.shape[1]), part.dtype)
                larger[: self.rows] = self.blocks[block][: self.rows]
                self.blocks[block] = larger
            self.blocks[block][self.rows : end] = part
            self.kept_bytes += part.nbytes
        self.rows = end

    def ticks(self, first: int, below: int, every: int, most: int) -> TickNumbers:
        """The ticks first, first + every … that are below `below` and known, and of these no more than `most`."""
        return np.arange(first, min(below, self.rows, first + every * most), every, dtype=np.int64)

    def kept(self, block: int, ticks: TickNumbers, columns: Sequence[int] | None = None) -> NDArray[Any]:
        """The rows [ticks, columns] of a block, of ticks in rising order; of `columns` alone, or of all."""
        here = self.blocks[block]
        return here[ticks] if columns is None else here[ticks[:, None], np.asarray(columns, np.intp)]


def rows_per_frame(doubles: int, singles: int) -> int:
    """How many rows of so many columns a frame can hold, at least one."""
    size = DOUBLE_BYTES * doubles + SINGLE_BYTES * singles
    return max(1, (MAX_FRAME_BYTES - HEADER.size) // max(1, size))


def rows_frame(asked: AskRows, doubles: Doubles, singles: Singles) -> bytes:
    """Rows: the doubles [rows, columns], row after row, then the singles."""
    return _header(ROWS_KIND, asked, len(doubles)) + doubles.astype("<f8").tobytes() + singles.astype("<f4").tobytes()


def columns_frame(asked: AskColumns, values: Doubles) -> bytes:
    """Columns `values` [rows, columns], one after the other, all as doubles."""
    return _header(COLUMNS_KIND, asked, len(values)) + values.astype("<f8").tobytes(order="F")


def _header(kind: int, asked: AskRows | AskColumns, rows: int) -> bytes:
    return HEADER.pack(kind, asked.fork, asked.first, asked.every, rows, asked.ask)
