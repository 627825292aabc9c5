"""A solid rectangle along the axes, as walls and obstacles are."""

from typing import NamedTuple

from mindrun.numbers.quantity import Place


class Rectangle(NamedTuple):
    """Its middle, and half of its sides along x and y."""

    x: float
    y: float
    half_x: float
    half_y: float

    def holds(self, place: Place) -> bool:
        """Whether a place is inside it."""
        x, y = place
        return abs(x - self.x) < self.half_x and abs(y - self.y) < self.half_y
