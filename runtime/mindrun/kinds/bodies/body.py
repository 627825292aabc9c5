"""Bodies, and what the rest of the program asks of each: it knows none by name."""

from dataclasses import dataclass
from math import cos, hypot, pi, sin
from typing import Annotated, Literal

from mindrun.kinds.registry import base, kind
from mindrun.numbers.quantity import Extent, Quantity

DIAMETER = Quantity("a length in world units", {"": 1.0}, low=0.01, high=1000.0)
Density = Annotated[float, Quantity("a density", {"": 1.0}, low=1e-3, high=1e6)]
Friction = Annotated[float, Quantity("a coefficient of friction", {"": 1.0}, low=0.0, high=100.0)]
Damping = Annotated[float, Quantity("a damping", {"": 1.0}, low=0.0, high=1e6)]
FRICTION_COEFFICIENT = 0.2  # Box2D's default; elasticity is 0 in both engines
LINEAR_DAMPING, ANGULAR_DAMPING = 5.0, 20.0  # per second
LEAST_COSINE = 1e-9  # of a direction that meets a side

Drive = Literal["wheel", "motor", "steering", "thruster"]  # what an actuator does to a body
Point = tuple[float, float]  # x ahead of the middle, y to its left


@base("body")
@dataclass(frozen=True, slots=True, kw_only=True)
class BodyKind:
    """A solid body that looks along its x axis, with what any has: every tick it loses motion, as the dampings say."""

    density: Density = 2.0
    friction: Friction = FRICTION_COEFFICIENT
    linear_damping: Damping = LINEAR_DAMPING
    angular_damping: Damping = ANGULAR_DAMPING

    varying = ("density", "friction", "linear_damping", "angular_damping")  # that can differ from run to run
    drives = tuple[Drive, ...]()  # what can move it
    outline = tuple[Point, ...]()  # the corners in the body's frame, counterclockwise; none where it is round
    axle_distance = 0.0  # between two axles that do not slip sideways; 0 where it has none

    @property
    def radius(self) -> float:
        """The radius of the circle around it."""
        raise NotImplementedError

    @property
    def front(self) -> float:
        """The distance from its middle to its front end."""
        return self.radius

    @property
    def side(self) -> float:
        """The distance from its middle to its side, where its wheels are."""
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
    def moment(self) -> float:
        """The moment of inertia about its middle; the mass is density times area."""
        mass = self.density * self.area[0] * self.area[1]
        return mass * self.gyration[0] / self.gyration[1]

    def rim(self, angle: float) -> float:
        """The distance from its middle to its rim in a direction, counterclockwise from straight ahead."""
        return self.radius


@dataclass(frozen=True, slots=True)
class Round(BodyKind):
    """A disc of diameter `size`."""

    size: Annotated[float, DIAMETER] = 2.0

    @property
    def radius(self) -> float:
        return self.size / 2

    @property
    def area(self) -> tuple[float, float]:
        return pi, self.radius**2

    @property
    def gyration(self) -> tuple[float, float]:
        """r² / 2, the squared radius of gyration of a disc, as (numerator, denominator)."""
        return self.radius**2, 2.0


@dataclass(frozen=True, slots=True)
class Rectangular(BodyKind):
    """A rectangle as long and as wide as its two sizes say."""

    size: Annotated[Extent, DIAMETER] = (3.0, 2.0)

    @property
    def sides(self) -> Point:
        """The length and the width; one number stands for both."""
        return self.size if isinstance(self.size, tuple) else (self.size, self.size)

    @property
    def outline(self) -> tuple[Point, ...]:  # type: ignore[override]
        x, y = self.front, self.side
        return (-x, -y), (x, -y), (x, y), (-x, y)

    @property
    def radius(self) -> float:
        return hypot(*self.sides) / 2

    @property
    def front(self) -> float:
        return self.sides[0] / 2

    @property
    def side(self) -> float:
        return self.sides[1] / 2

    @property
    def area(self) -> tuple[float, float]:
        return self.sides

    @property
    def gyration(self) -> tuple[float, float]:
        """(a² + b²) / 12, the squared radius of gyration of a rectangle, as (numerator, denominator)."""
        return self.sides[0] * self.sides[0] + self.sides[1] * self.sides[1], 12.0

    def rim(self, angle: float) -> float:
        ahead, aside = max(abs(cos(angle)), LEAST_COSINE), max(abs(sin(angle)), LEAST_COSINE)
        return min(self.front / ahead, self.side / aside)


@kind("body", "disc")
class Disc(Round):
    """A round body of diameter `size` with wheels on its rim, or thrusters.

    Every tick of length dt its velocity is divided by 1 + dt·damping.
    """

    drives = ("wheel", "thruster")


@kind("body", "holonomic")
class Holonomic(Round):
    """A round body of diameter `size` that three thrusters or more push in any direction, and turn.

    Every tick of length dt its velocity is divided by 1 + dt·damping.
    """

    drives = ("thruster",)


@kind("body", "box")
class Box(Rectangular):
    """A rectangular body, `size` being its length and its width, or both, with wheels at its sides, or thrusters.

    Every tick of length dt its velocity is divided by 1 + dt·damping.
    """

    drives = ("wheel", "thruster")


WHEELBASE = Quantity("a share of its length", {"": 1.0, "%": 0.01}, low=0.01, high=1.0)


@kind("body", "car")
class Car(Rectangular):
    """A rectangular body with a motor and a steering, `size` its length and its width, or both: the bicycle model.

    Its two axles, `wheelbase` of its length apart, do not slip sideways: with the steering at δ, a speed of v along its
    heading goes with v·tan δ / 2 to the left and a turn of v·tan δ / distance of the axles. What a push or a turn of
    the steering has left of other motion is lost, as to forces that act on the axles and do no work.
    """

    wheelbase: Annotated[float, WHEELBASE] = 0.6

    drives = ("motor", "steering")

    @property
    def axle_distance(self) -> float:  # type: ignore[override]
        return self.wheelbase * self.sides[0]
