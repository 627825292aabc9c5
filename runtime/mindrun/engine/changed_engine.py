"""A mind that runs with changes: the engine, in whose ticks readings, influence and memory cells can be replaced."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mindrun.engine.changes import Changed
from mindrun.engine.engine import Engine
from mindrun.engine.think import Thought, think
from mindrun.numbers.arrays import Reader, Readings

UNCHANGED = Changed()


class ChangedEngine(Engine):
    """As Engine; `tick_with` makes changes as `mindrun.sim.changed_ticks` makes them in the lanes, bit for bit."""

    def reset(self) -> None:
        """Back to the state before the first tick."""
        super().reset()
        self._made = UNCHANGED
        self._virtual = tuple((place, self._replacing(place, read)) for place, read in self._virtual)

    def tick_with(self, readings: ArrayLike, made: Changed | None) -> NDArray[np.float32]:
        """Commands [actuators] for readings [graph.width] in a tick in which so much is changed."""
        self._made = made or UNCHANGED
        for number, memory in enumerate(self.graph.memories):
            if memory.start in self._made.memory:
                self._cells[number] = self._made.memory[memory.start]
        return self.tick(readings)

    def _filled(self, now: NDArray[np.float32]) -> NDArray[np.float32]:
        for row, value in self._made.reading.items():
            now[row] = value
        return super()._filled(now)

    def _replacing(self, place: slice, read: Reader) -> Reader:
        """What a virtual sensor says, or what it is made to say."""

        def replacing(number: int, now: Readings, before: Readings | None) -> Readings:
            now[place] = read(number, now, before)
            for row in range(place.start, place.stop):
                if row in self._made.reading:
                    now[row] = self._made.reading[row]
            return now[place]

        return replacing

    def _thought(self) -> Thought:
        return think(self._hierarchy, self.readings, self._made.influence)
