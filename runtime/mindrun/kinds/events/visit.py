"""The robot comes where it has not been."""

from math import ceil
from typing import Annotated

from mindrun.kinds.events.event import EventKind, Hindrance, Row, TaskWorld
from mindrun.kinds.registry import kind
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.numbers.quantity import Quantity, Reference

PATCH = Quantity("a length in world units", {"": 1.0}, low=0.1, high=1e5)


@kind("event", "visit")
class Visit(EventKind):
    """The robot's centre enters a square patch of the arena, of side `size`, for the first time."""

    of: Annotated[str, Reference("place", ("patch",))]
    size: Annotated[float, PATCH] = 4.0

    needs_walls = True

    def missing(self, task: TaskWorld) -> Hindrance | None:
        """A hindrance where the scene has no walls, and so no end of patches."""
        if task.scene is None or task.scene.is_bounded:
            return None
        return Hindrance("A plain scene has no patches to visit.", "Patches are of an arena: write in arena size 100.")

    def row(self, scene: SceneKind) -> Row:
        """The number of patches along each axis, rounded up, and their side in world units."""
        width, depth = scene.sides
        return {"columns": ceil(width / self.size), "rows": ceil(depth / self.size), "patch": self.size}
