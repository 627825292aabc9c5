"""What each skill of a hierarchy sends in any row of a run, computed by the engine's own functions."""

from __future__ import annotations

from collections.abc import Callable, Container

import numpy as np
from mindrun.engine.think import Hierarchy, Ready, values
from mindrun.kinds.functions.function import Stateful
from numpy.typing import NDArray

Singles = NDArray[np.float32]
Places = NDArray[np.int64]  # of rows, the first of which is 0
Rows = Callable[[Places], tuple[Singles, Singles]]  # their readings [rows, width] and their influence [rows, skills]
BLOCK_ROWS = 1024  # that are kept together
NAN = np.float32(np.nan)


class SentValues:
    """The values over the edges of all skills, in their order: as they are before the clamp, NaN where none is sent.

    In the rows of `begins` the mind was begun anew. A function that remembers is computed from there on, like the
    engine only where it is influenced, and what it has sent is kept: four bytes for each edge and row.
    """

    def __init__(self, mind: Hierarchy, rows: Rows, begins: Container[int] = ()) -> None:
        self._skills = mind.skills
        self._indices = np.array([skill.index for skill in mind.skills], np.intp)
        self._edges = np.array([len(skill.edges) for skill in mind.skills], np.intp)
        self._kept = {
            skill.index: _Kept(skill, rows, begins) for skill in mind.skills if isinstance(skill.compute, Stateful)
        }

    def over(self, rows: Places, readings: Singles, influence: Singles) -> Singles:
        """The values [rows, edges] in rows that have these readings and this influence."""
        is_influenced = influence[:, self._indices] != 0
        sent: list[np.float32] = []
        for row, place in np.argwhere(is_influenced).tolist():
            skill = self._skills[place]
            kept = self._kept.get(skill.index)
            sent += _numbers(skill, readings[row]) if kept is None else kept.at(int(rows[row]))
        is_computed = np.repeat(is_influenced, self._edges, axis=1)
        found = np.full(is_computed.shape, NAN)
        found[is_computed] = sent
        return found

    @property
    def kept_bytes(self) -> int:
        """Of what was sent by functions that remember."""
        return sum(kept.bytes for kept in self._kept.values())

    def go_on(self, end: int) -> None:
        """Compute what remembers up to the row `end`, so that no row before it is needed any more."""
        for kept in self._kept.values():
            kept.go_on(end)


class _Kept:
    """What a skill that remembers has sent so far."""

    def __init__(self, skill: Ready, rows: Rows, begins: Container[int]) -> None:
        self._skill, self._rows, self._begins = skill, rows, begins
        self._blocks: list[Singles] = []  # [BLOCK_ROWS, edges] each
        self._known = 0  # how many rows are computed

    @property
    def bytes(self) -> int:
        """Of the blocks so far."""
        return sum(block.nbytes for block in self._blocks)

    def at(self, row: int) -> list[np.float32]:
        """What it sent in a row."""
        self.go_on(row + 1)
        return [*self._blocks[row // BLOCK_ROWS][row % BLOCK_ROWS]]

    def go_on(self, end: int) -> None:
        """Compute the rows before `end` that are not computed yet."""
        while self._known < end:
            if self._known == len(self._blocks) * BLOCK_ROWS:
                self._blocks.append(np.full((BLOCK_ROWS, len(self._skill.edges)), NAN))
            self._fill(self._blocks[-1], np.arange(self._known, min(end, len(self._blocks) * BLOCK_ROWS)))

    def _fill(self, block: Singles, rows: Places) -> None:
        for row, readings, influence in zip(rows.tolist(), *self._rows(rows), strict=True):
            if row in self._begins and isinstance(self._skill.compute, Stateful):
                self._skill.compute.reset()
            if influence[self._skill.index] != 0:
                block[row % BLOCK_ROWS] = _numbers(self._skill, readings)
            self._known = row + 1


def _numbers(skill: Ready, readings: Singles) -> list[np.float32]:
    return [NAN if value is None else value for value in values(skill, readings)]
