"""Outlines on the floor, and whether two of them are in one another."""

from collections.abc import Iterator, Sequence
from math import cos, hypot, inf, sin
from typing import NamedTuple

from mindrun.kinds.scenes.scene import TOUCHING_UNITS
from mindrun.kinds.things.thing import Rectangle
from mindrun.numbers.quantity import Place


class Outline(NamedTuple):
    """A convex shape: all that is no farther than `rim` from its corners and what lies between them."""

    corners: tuple[Place, ...]
    rim: float = 0.0

    @property
    def ends(self) -> tuple[float, float, float, float]:
        """The least x and y of the shape, then the greatest."""
        xs, ys = zip(*self.corners, strict=True)
        return min(xs) - self.rim, min(ys) - self.rim, max(xs) + self.rim, max(ys) + self.rim


def disc(place: Place, radius: float) -> Outline:
    """All that is so near to a place."""
    return Outline((place,), radius)


def rectangle(of: Rectangle) -> Outline:
    """What a rectangle along the axes covers."""
    left, right, low, high = of.x - of.half_x, of.x + of.half_x, of.y - of.half_y, of.y + of.half_y
    return Outline(((left, low), (right, low), (right, high), (left, high)))


def turned(place: Place, angle: float, corners: Sequence[Place]) -> Outline:
    """A body with those corners around a place, turned counterclockwise by an angle in radians."""
    c, s = cos(angle), sin(angle)
    return Outline(tuple((place[0] + c * x - s * y, place[1] + s * x + c * y) for x, y in corners))


def meet(one: Outline, other: Outline) -> bool:
    """Whether two are in one another: along no line can they be told apart."""
    ends, others = one.ends, other.ends
    if not all(_cover((ends[i], ends[i + 2]), (others[i], others[i + 2])) for i in (0, 1)):
        return False
    return all(_cover(_span(one, axis), _span(other, axis)) for axis in _axes(one, other))


def _axes(one: Outline, other: Outline) -> Iterator[Place]:
    """Directions of length 1, along one of which any two that are apart are apart: across sides, between corners."""
    for of in (one, other):
        for (x, y), (to_x, to_y) in zip(of.corners, (*of.corners[1:], of.corners[0]), strict=True):
            yield from _direction(y - to_y, to_x - x)
    if one.rim or other.rim:
        for x, y in one.corners:
            for to_x, to_y in other.corners:
                yield from _direction(to_x - x, to_y - y)


def _direction(x: float, y: float) -> Iterator[Place]:
    if 0 < (length := hypot(x, y)) < inf:
        yield x / length, y / length


def _cover(one: Place, other: Place) -> bool:
    """Whether two stretches of a line, from low to high, have more in common than an end; a point is a stretch, too."""
    return one[0] < other[1] - TOUCHING_UNITS and other[0] < one[1] - TOUCHING_UNITS


def _span(of: Outline, axis: Place) -> tuple[float, float]:
    along = [x * axis[0] + y * axis[1] for x, y in of.corners]
    return min(along) - of.rim, max(along) + of.rim
