"""What every kind of body says of itself: the rest of the program asks, and knows no kind by name."""

from dataclasses import dataclass
from math import cos, hypot, pi, sin
from typing import Annotated, Literal

from mindrun.kinds.registry import base
from mindrun.numbers.quantity import Extent, Quantity

DIAMETER = Quantity("a length in world units", {"": 1.0}, low=0.01, high=1000.0)
DENSITY = Quantity("a density", {"": 1.0}, low=1e-3, high=1e6)
FRICTION = Quantity("a coefficient of friction", {"": 1.0}, low=0.0, high=100.0)
DAMPING = Quantity("a damping", {"": 1.0}, low=0.0, high=1e6)
FRICTION_COEFFICIENT = 0.2  # Box2D's default; elasticity is 0 in both engines
LINEAR_DAMPING, ANGULAR_DAMPING = 5.0, 20.0  # per second
LEAST_COSINE = 1e-9  # of a direction that meets a side

Drive = Literal["wheel", "motor", "steering", "thruster"]  # what an actuator does to a body
Point = tuple[float, float]  # x ahead of the middle, y to its left


@base("body")
class BodyKind:
    """A solid body that looks along its x axis; a kind says what is different about it.

    Every kind has the arguments `density`, `friction` (against what it touches), `linear_damping` and
    `angular_damping`: every tick of length dt its velocity is divided by 1 + dt·damping.
    """

    __slots__ = ()

    density: float
    friction: float
    linear_damping: float
    angular_damping: float

    # The arguments that can differ from run to run.
    varying: tuple[str, ...] = ("density", "friction", "linear_damping", "angular_damping")
    drives: tuple[Drive, ...] = ()  # what can move it

    @property
    def outline(self) -> tuple[Point, ...]:
        """Its corners, counterclockwise; none where it is round."""
        return ()

    @property
    def axle_distance(self) -> float:
        """How far apart two axles are that do not slip sideways; 0 where it has none."""
        return 0.0

    @property
    def radius(self) -> float:
        """The radius of the circle around it."""
        raise NotImplementedError

    @property
    def front(self) -> float:
        """How far ahead of its middle it ends."""
        return self.radius

    @property
    def side(self) -> float:
        """How far beside its middle it ends, where its wheels are."""
        return self.radius

    @property
    def area(self) -> tuple[float, float]:
        """Two numbers whose product is its area."""
        raise NotImplementedError

    @property
    def gyration(self) -> tuple[float, float]:
        """Two numbers whose quotient is its moment of inertia about its middle for each unit of mass."""
        raise NotImplementedError

    @property
    def mass(self) -> float:
        """Density times area."""
        return self.density * self.area[0] * self.area[1]

    @property
    def moment(self) -> float:
        """The moment of inertia about its middle."""
        return self.mass * self.gyration[0] / self.gyration[1]

    def rim(self, angle: float) -> float:
        """How far from its middle it ends in a direction, counterclockwise from straight ahead."""
        return self.radius


@dataclass(frozen=True, slots=True)
class Round(BodyKind):
    """A disc of diameter `size`."""

    size: Annotated[float, DIAMETER] = 2.0
    density: Annotated[float, DENSITY] = 2.0
    friction: Annotated[float, FRICTION] = FRICTION_COEFFICIENT
    linear_damping: Annotated[float, DAMPING] = LINEAR_DAMPING
    angular_damping: Annotated[float, DAMPING] = ANGULAR_DAMPING

    @property
    def radius(self) -> float:
        """Half of its size."""
        return self.size / 2

    @property
    def area(self) -> tuple[float, float]:
        """Of a disc: π·r²."""
        return pi, self.radius**2

    @property
    def gyration(self) -> tuple[float, float]:
        """Of a disc: r² / 2."""
        return self.radius**2, 2.0


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
