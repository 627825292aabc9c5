"""The measures of bodies, computed the obvious way."""

import math

from mindrun.kinds.bodies.body import Box, Car, Disc, Holonomic


def sides_of(body):
    """How long and how wide a rectangle is."""
    return body.size if isinstance(body.size, tuple) else (body.size, body.size)


def front_of(body):
    """How far ahead of its middle a body ends."""
    return sides_of(body)[0] / 2 if isinstance(body, Box | Car) else body.size / 2


def side_of(body):
    """How far beside its middle a body ends."""
    return sides_of(body)[1] / 2 if isinstance(body, Box | Car) else body.size / 2


def radius_of(body):
    """The radius of the circle around a body."""
    return math.hypot(*sides_of(body)) / 2 if isinstance(body, Box | Car) else body.size / 2


def rim_of(body, angle):
    """How far from its middle a body ends in a direction."""
    if isinstance(body, Disc | Holonomic):
        return body.size / 2
    ahead, aside = abs(math.cos(angle)), abs(math.sin(angle))
    ways = [half / way for half, way in zip(sides_of(body), (2 * ahead, 2 * aside), strict=True) if way > 1e-9]
    return min(ways)
