"""Rows that have come so far, kept in the parts in which they came."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Doubles = NDArray[np.float64]
Singles = NDArray[np.float32]
TickNumbers = NDArray[np.int64]
Number = TypeVar("Number", np.float64, np.float32)

MERGED_ROWS = 256


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
