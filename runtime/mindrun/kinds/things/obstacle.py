"""Solid squares that stand in the way."""

from collections.abc import Iterable
from dataclasses import replace
from itertools import product
from typing import Annotated

from mindrun.kinds.registry import kind, left_out
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.kinds.things.thing import (
    DEFAULT_DISTANCE,
    DEFAULT_SIZE,
    MAX_OBSTACLES,
    Alternatives,
    Rectangle,
    Row,
    ThingKind,
    ThingMistake,
)
from mindrun.numbers.quantity import Length, Lengths, Place, Places, Quantity

COUNT = Quantity("a whole number", {"": 1.0}, low=0, high=1000, whole=True)
MIDDLE_UNITS: tuple[Place, ...] = ((0.0, 0.0),)  # of a grid
MAX_GRID_LINES = 1e9  # lines of a grid, far more than can be


@kind("content", "obstacle")
class Obstacle(ThingKind):
    """Solid squares of side `size`: `count` of them anywhere, one `at` a place, or one at each point of a `grid`.

    Each stands up to `jitter` off its point, both ways along both axes.
    """

    size: Lengths = DEFAULT_SIZE
    grid: Length = 0.0
    jitter: Length = 0.0
    count: Annotated[int, COUNT] = 0
    away: Lengths = DEFAULT_DISTANCE
    at: Places = ()
    or_: Alternatives = left_out(())

    unplaceable = "Write a count of as many as the map draws, and neither a place nor a grid."
    is_obstacle = True
    is_solid = True
    least_distance = 0.0

    def grid_lines(self, scene: SceneKind | None) -> tuple[int, int]:
        """The columns and rows of its grid in a scene, none of them on its walls; (0, 0) without a grid or walls."""
        if scene and scene.is_bounded and self.grid:
            columns, rows = (max(0, round(min(side / self.grid, MAX_GRID_LINES)) - 1) for side in scene.sides)
            return columns, rows
        return 0, 0

    def obstacles(self, scene: SceneKind | None) -> int:
        columns, rows = self.grid_lines(scene)
        return columns * rows if self.grid else self.count or len(self.at)

    def standing(self, scene: SceneKind | None, may: bool = False) -> Iterable[Rectangle]:
        least, most = sorted((self.size.first, self.size.last))
        half = most / 2 + self.jitter if may else least / 2 - self.jitter
        columns, rows = self.grid_lines(scene) if self.grid else (1, 1)
        if half <= 0 or not (self.grid or self.at) or columns * rows > MAX_OBSTACLES:
            return
        places = (self.spots if may else self.places) if self.at else MIDDLE_UNITS
        for (x, y), column, row in product(places, range(columns), range(rows)):
            yield Rectangle(
                x + (column - (columns - 1) / 2) * self.grid, y + (row - (rows - 1) / 2) * self.grid, half, half
            )

    def at_places(self, places: tuple[Place, ...]) -> "Obstacle | None":
        return None if self.spots or self.grid or self.count != len(places) else replace(self, at=places, count=0)

    def rows(self, scene: SceneKind) -> Iterable[Row]:
        columns, rows = (1, 1) if self.at else self.grid_lines(scene)
        count = 0 if self.grid or self.at else self.count
        grid = {"grid": self.grid, "jitter": self.jitter, "columns": columns, "rows": rows, "count": count}
        if self.or_:
            return [{**grid, "options": len(self.options)}]
        return [{**grid, "x": x, "y": y} for x, y in self.at or MIDDLE_UNITS]

    def mistake(self, scene: SceneKind | None) -> ThingMistake | None:
        if self.spots and (self.grid or self.count):
            hint = "Write at and its place, or a count, or a grid."
            return ThingMistake("place-for-many", "Several things cannot stand at one place.", hint)
        if self.size.by is not None:
            small, large = sorted((self.size.first, self.size.last))
            hint = f"Write size {small:g} to {large:g}: a size between the two is drawn for each."
            return ThingMistake("fixed-schedule", "An obstacle never moves, so its size has no schedule.", hint)
        if self.grid and self.away != DEFAULT_DISTANCE:
            hint = "Leave away out: what stands in a grid is as far away as that is."
            return ThingMistake("place-and-distance", "It says where it is, and how far away.", hint)
        if self.grid and scene and not scene.is_bounded:
            hint = "Write in arena size 100, or count 10 instead of the grid."
            return ThingMistake("endless-grid", "In a plain scene a grid of obstacles would never end.", hint)
        if (made := self.obstacles(scene)) > MAX_OBSTACLES:
            hint = f"A world takes {MAX_OBSTACLES}: space it out."
            return ThingMistake("too-many-obstacles", f"That is a grid of {made} obstacles.", hint)
        if not self.grid and not self.count and not self.at:
            return ThingMistake("no-obstacles", "That makes no obstacle.", "Add grid 20, or count 10, or at 30 -20.")
        return ThingKind.mistake(self, scene)
