"""Scenes, and what the rest of the program asks of each: it knows none by name."""

from math import hypot, inf
from typing import Annotated

from mindrun.kinds.registry import base, kind
from mindrun.numbers.quantity import Extent, Place, Quantity, Reference

TOUCHING_UNITS = 1e-6  # what is so little beyond something, or in it, only touches it: sums of decimals are rounded

DISTANCE_SHARE = 1 / 3  # of the way from corner to corner: no farther from the robot is what does not say so


@base("task")
class SceneKind:
    """A world without borders; a kind says what is different about it."""

    __slots__ = ()
    environment = ""  # that is this world; empty where the lanes simulate it
    sides = inf, inf  # its lengths along x and y in world units, infinite without walls; the origin is its middle

    @property
    def is_bounded(self) -> bool:
        """True if walls stand around it."""
        return self.sides[0] < inf

    def has_room(self, place: Place, extent: float) -> bool:
        """True if something of half size `extent` at a place is inside the walls, or touches them."""
        return all(abs(at) + extent <= side / 2 + TOUCHING_UNITS for at, side in zip(place, self.sides, strict=True))

    def distances(self, least: float) -> tuple[float, float]:
        """The least and the greatest distance from the robot of a thing that does not say its own.

        `least` is that of such a thing where walls keep it near, if they leave so much room.
        """
        return min(least, hypot(*self.sides) * DISTANCE_SHARE), inf


MIN_DISTANCE_UNITS, MAX_DISTANCE_UNITS = 10.0, 40.0  # units from the robot


@kind("task", "plain")
class Plain(SceneKind):
    """A world without borders; the robot starts in its origin."""

    def distances(self, least: float) -> tuple[float, float]:
        return MIN_DISTANCE_UNITS, MAX_DISTANCE_UNITS


SIDE = Quantity("a length in world units", {"": 1.0}, low=0.01, high=1e5)


@kind("task", "arena")
class Arena(SceneKind):
    """A square world of side `size` with walls, or one of that width and depth; the robot starts anywhere in it."""

    size: Annotated[Extent, SIDE] = 100.0

    @property
    def sides(self) -> tuple[float, float]:  # type: ignore[override]
        return self.size if isinstance(self.size, tuple) else (self.size, self.size)


@kind("task", "gymnasium")
class Gymnasium(SceneKind):
    """The environment of Gymnasium with that name: each tick is one of its steps, and it says how a run begins."""

    gymnasium: Annotated[str, Reference("environment")]

    @property
    def environment(self) -> str:  # type: ignore[override]
        return self.gymnasium
