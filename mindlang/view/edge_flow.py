"""What each edge of a hierarchy transmits in given ticks, computed from their rows by the engine's own functions."""

from __future__ import annotations

from collections.abc import Callable, Container

import numpy as np
from mindrun.functions.function import Stateful
from mindrun.think import Hierarchy, Ready, values
from numpy.typing import NDArray

from mindlang.run.edge_flow import transmitted
from mindlang.view.row_blocks import Singles, TickNumbers

Sent = tuple[np.float32 | None, ...]
Rows = Callable[[TickNumbers], tuple[Singles, Singles]]  # the readings and the influence of ticks
REPLAYED_TICKS = 1024  # that a skill with a memory is computed through at once


class EdgeFlow:
    """The edges of the skills that a master reaches, in the order of the graph; `rows` are asked for as needed.

    `begins` are the ticks in which the mind was begun anew. A function that remembers has to be computed from there on:
    what it sent is kept.
    """

    def __init__(self, hierarchy: Hierarchy, rows: Rows, begins: Container[int] = (1,)) -> None:
        self._hierarchy, self._rows, self._begins = hierarchy, rows, begins
        self._kept: dict[int, list[Sent]] = {
            skill.index: [()] for skill in hierarchy.skills if isinstance(skill.compute, Stateful)
        }
        self.edges = sum(len(skill.edges) for skill in hierarchy.skills)

    def at(self, ticks: TickNumbers) -> Singles:
        """What each edge transmits [ticks, edges], 0 to 1; tick 0 is the beginning, when nothing flows."""
        found = np.zeros((len(ticks), self.edges), np.float32)
        readings, influence = self._rows(ticks)
        with np.errstate(all="ignore"):
            for row, tick in enumerate(ticks.tolist()):
                if tick:
                    self._fill(found[row], tick, readings[row], influence[row])
        return found

    def _fill(self, flow: NDArray[np.float32], tick: int, readings: Singles, influence: Singles) -> None:
        first = 0
        for skill in self._hierarchy.skills:
            own = influence[skill.index]
            if own != 0:
                sent = self._sent(skill, tick, readings)
                for number, (edge, value) in enumerate(zip(skill.edges, sent, strict=True), first):
                    flow[number] = transmitted(edge, value, own)
            first += len(skill.edges)

    def _sent(self, skill: Ready, tick: int, readings: Singles) -> Sent:
        """What an influenced skill sends in a tick."""
        kept = self._kept.get(skill.index)
        if kept is None:
            return tuple(values(skill, readings))
        while len(kept) <= tick:
            self._replay(skill, kept, np.arange(len(kept), min(tick + 1, len(kept) + REPLAYED_TICKS)))
        return kept[tick]

    def _replay(self, skill: Ready, kept: list[Sent], ticks: TickNumbers) -> None:
        """Go on with a function that remembers: like the engine, it computes only where it is influenced."""
        for tick, readings, influence in zip(ticks.tolist(), *self._rows(ticks), strict=True):
            if tick in self._begins and isinstance(skill.compute, Stateful):
                skill.compute.reset()
            kept.append(tuple(values(skill, readings)) if influence[skill.index] != 0 else ())
