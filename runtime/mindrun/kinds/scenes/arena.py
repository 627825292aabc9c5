"""A scene with walls around it."""

from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.numbers.quantity import Extent, Quantity

SIDE = Quantity("a length in world units", {"": 1.0}, low=0.01, high=1e5)


@kind("task", "arena")
class Arena(SceneKind):
    """A square world of side `size` with walls, or one of that width and depth; the robot starts anywhere in it."""

    size: Annotated[Extent, SIDE] = 100.0

    @property
    def sides(self) -> tuple[float, float]:
        """Its lengths along x and y; a size of one number is both."""
        return self.size if isinstance(self.size, tuple) else (self.size, self.size)
