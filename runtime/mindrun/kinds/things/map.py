"""Walls drawn in characters."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.kinds.things.thing import Rectangle, ThingKind, ThingMistake
from mindrun.numbers.quantity import LENGTH, Place, Reference

WALL, FLOOR, START = "#", ".", "S"
MAX_MAP_CELLS = 40_000  # 200 by 200
CELL = replace(LENGTH, low=0.01, high=1000.0)

Lines = tuple[str, ...]


@kind("content", "map")
class Map(ThingKind):
    """Walls drawn in a text file: `#` is wall, `.` is floor, each a square of side `cell`; its middle is the world's.

    A letter is floor on which a thing stands when a run begins: the one of that name, or whose name begins with it, a
    capital like a small one. `S` is floor where the robot starts, unless the task says `starts at`.
    """

    from_: Annotated[Lines, Reference("text file")]
    cell: Annotated[float, CELL] = 4.0

    is_obstacle = True
    is_solid = True
    unplaceable = "Draw walls with #, and write another letter for what stands there."

    def obstacles(self, scene: SceneKind | None) -> int:
        return len(_rectangles(self.from_))

    @property
    def walls(self) -> tuple[Rectangle, ...]:  # type: ignore[override]
        found = []
        for column, row, wide, high in _rectangles(self.from_):
            (x, y), (to_x, to_y) = self._place(column, row), self._place(column + wide - 1, row + high - 1)
            sides = self.cell * wide / 2, self.cell * high / 2
            found.append(Rectangle((x + to_x) / 2, (y + to_y) / 2, *sides))
        return tuple(found)

    @property
    def drawing(self) -> Lines:  # type: ignore[override]
        return self.from_

    @property
    def letters(self) -> Mapping[str, tuple[Place, ...]]:  # type: ignore[override]
        found: dict[str, list[Place]] = {}
        for row, line in enumerate(self.from_):
            for column, letter in enumerate(line):
                if letter not in (WALL, FLOOR):
                    found.setdefault(letter, []).append(self._place(column, row))
        return {letter: tuple(places) for letter, places in found.items()}

    def _place(self, column: int, row: int) -> Place:
        """The middle of a square; the first line is the farthest along y."""
        columns, rows = max(map(len, self.from_)), len(self.from_)
        return self.cell * (column - (columns - 1) / 2), self.cell * ((rows - 1) / 2 - row)

    def mistake(self, scene: SceneKind | None) -> ThingMistake | None:
        columns = max(map(len, self.from_), default=0)
        for number, line in enumerate(self.from_, 1):
            if len(line) != columns:
                long = f"Line {number} has {len(line)} characters, the longest has {columns}"
                hint = f"{long}: fill it up with {FLOOR} or {WALL}."
                return ThingMistake("ragged-map", "The lines of this map are of different lengths.", hint)
        if columns * len(self.from_) > MAX_MAP_CELLS:
            hint = f"A map has up to {MAX_MAP_CELLS} squares: draw it coarser, with a larger cell."
            return ThingMistake("map-too-large", f"This map has {columns * len(self.from_)} squares.", hint)
        if not any(letter != WALL for line in self.from_ for letter in line):
            return ThingMistake("map-without-floor", "This map has no floor.", f"Draw {FLOOR} where the robot can be.")
        half_x, half_y = self.cell * columns / 2, self.cell * len(self.from_) / 2
        if scene is None or scene.has_room((half_x, half_y), 0.0):
            return None
        hint = f"It is {2 * half_x:g} wide and {2 * half_y:g} deep: write a smaller cell or a larger arena."
        return ThingMistake("outside-arena", "This map is larger than the arena.", hint)


@lru_cache(64)
def _rectangles(lines: Lines) -> Sequence[tuple[int, int, int, int]]:
    """Column, row, width and height of rectangles that cover the walls, few and none twice: wide ones, then high."""
    if sum(map(len, lines)) > MAX_MAP_CELLS:
        return ()
    left = {(column, row) for row, line in enumerate(lines) for column, mark in enumerate(line) if mark == WALL}
    found = []
    for column, row in sorted(left, key=lambda cell: cell[::-1]):
        if (column, row) not in left:
            continue
        wide, high = 1, 1
        while (column + wide, row) in left:
            wide += 1
        while all((column + i, row + high) in left for i in range(wide)):
            high += 1
        left -= {(column + i, row + k) for i in range(wide) for k in range(high)}
        found.append((column, row, wide, high))
    return found
