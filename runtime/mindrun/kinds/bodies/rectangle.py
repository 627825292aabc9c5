"""What rectangular bodies have in common."""

from math import cos, hypot, sin

from mindrun.kinds.bodies.body import BodyKind, Point
from mindrun.numbers.quantity import Extent

LEAST_COSINE = 1e-9  # of a direction that meets a side


class Rectangle(BodyKind):
    """A rectangle as long and as wide as its two sizes say."""

    __slots__ = ()

    size: Extent

    @property
    def sides(self) -> Point:
        """Its length and its width."""
        return self.size if isinstance(self.size, tuple) else (self.size, self.size)

    @property
    def outline(self) -> tuple[Point, ...]:
        """Its corners, counterclockwise from the right one behind."""
        x, y = self.front, self.side
        return (-x, -y), (x, -y), (x, y), (-x, y)

    @property
    def radius(self) -> float:
        """Half of its diagonal."""
        return hypot(*self.sides) / 2

    @property
    def front(self) -> float:
        """Half of its length."""
        return self.sides[0] / 2

    @property
    def side(self) -> float:
        """Half of its width."""
        return self.sides[1] / 2

    @property
    def area(self) -> tuple[float, float]:
        """Its sides."""
        return self.sides

    @property
    def gyration(self) -> tuple[float, float]:
        """Of a rectangle: (a² + b²) / 12."""
        return self.sides[0] * self.sides[0] + self.sides[1] * self.sides[1], 12.0

    def rim(self, angle: float) -> float:
        """Where a ray from the middle leaves it."""
        ahead, aside = max(abs(cos(angle)), LEAST_COSINE), max(abs(sin(angle)), LEAST_COSINE)
        return min(self.front / ahead, self.side / aside)
