"""What every kind of scene says of itself: the rest of the program asks, and knows no kind by name."""

from math import inf

from mindrun.registry import base


@base("task")
class SceneKind:
    """A world without borders; a kind says what is different about it."""

    __slots__ = ()

    @property
    def side(self) -> float:
        """The length of each of its walls in world units; infinite where it has none. The origin is its middle."""
        return inf

    @property
    def is_bounded(self) -> bool:
        """Whether walls stand around it."""
        return self.side < inf

    def distances(self, least: float) -> tuple[float, float]:
        """How near to the robot and how far from it a thing is placed that does not say so.

        `least` is how far away such a thing is where walls keep it near.
        """
        return least, inf
