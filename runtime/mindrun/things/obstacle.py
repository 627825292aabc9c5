"""What stands in the way."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.quantity import LENGTH, Quantity, Span
from mindrun.registry import kind
from mindrun.scenes import SceneKind
from mindrun.things.thing import DEFAULT_DISTANCE, DEFAULT_SIZE, MAX_OBSTACLES, Mistake, Row, ThingKind

COUNT = Quantity("a whole number", {"": 1.0}, low=0, high=1000, whole=True)
MAX_GRID_LINES = 1e9  # lines of a grid, far more than can be


@kind("content", "obstacle")
@dataclass(frozen=True, slots=True)
class Obstacle(ThingKind):
    """Solid squares of side `size`: `count` of them anywhere, or one at each point of a `grid` of that spacing.

    Each stands up to `jitter` off its point, both ways along both axes.
    """

    size: Annotated[Span, LENGTH] = DEFAULT_SIZE
    grid: Annotated[float, LENGTH] = 0.0
    jitter: Annotated[float, LENGTH] = 0.0
    count: Annotated[int, COUNT] = 0
    away: Annotated[Span, LENGTH] = DEFAULT_DISTANCE

    is_obstacle = True
    is_solid = True
    least_distance = 0.0

    def grid_lines(self, scene: SceneKind | None) -> int:
        """How many lines of its grid cross a scene, none on its walls; there is no grid without walls."""
        if scene and scene.is_bounded and self.grid:
            return max(0, round(min(scene.side / self.grid, MAX_GRID_LINES)) - 1)
        return 0

    def obstacles(self, scene: SceneKind | None) -> int:
        """One at each point of its grid, or its count."""
        return self.grid_lines(scene) ** 2 if self.grid else self.count

    def row(self, scene: SceneKind) -> Row:
        """A grid or a count."""
        lines, count = self.grid_lines(scene), 0 if self.grid else self.count
        return {"grid": self.grid, "jitter": self.jitter, "lines": lines, "count": count}

    def mistake(self, scene: SceneKind | None) -> Mistake | None:
        """A grid needs the borders of an arena and must not be too close; without one it needs a count."""
        if self.grid and scene and not scene.is_bounded:
            hint = "Write in arena size 100, or count 10 instead of the grid."
            return Mistake("endless-grid", "In a plain scene a grid of obstacles would never end.", hint)
        if (made := self.obstacles(scene)) > MAX_OBSTACLES:
            hint = f"A world takes {MAX_OBSTACLES}: space it out."
            return Mistake("too-many-obstacles", f"That is a grid of {made} obstacles.", hint)
        if not self.grid and not self.count:
            return Mistake("no-obstacles", "That makes no obstacle.", "Add grid 20, or count 10.")
        return None
