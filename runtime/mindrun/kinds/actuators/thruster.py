"""A force on a point of the body."""

from typing import Annotated

from mindrun.kinds.actuators.actuator import THRUST, Pushing
from mindrun.kinds.bodies.body import BodyKind, Point
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import ANGLE, RATIO, TICKS, Place, Quantity
from mindrun.numbers.trigonometry import cosine, sine

PLACE = Quantity("a place on the body in world units", {"": 1.0}, low=-1000.0, high=1000.0)


@kind("actuator", "thruster")
class Thruster(Pushing):
    """A force (2v − 1)·thrust `at` a point of the body, x ahead of its middle and y to its left: 0.5 is none.

    It pushes the body to where it is `facing`, counterclockwise from straight ahead. A command acts `delay` ticks after
    the tick that computed it, with up to `noise` more or less; up to `slip` of the force is lost, anew in every tick.
    """

    neutral: Annotated[float, RATIO]
    at: Annotated[Place, PLACE] = (0.0, 0.0)
    facing: Annotated[float, ANGLE] = 0.0
    thrust: Annotated[float, THRUST] = 80.0
    delay: Annotated[int, TICKS] = 0
    noise: Annotated[float, RATIO] = 0.0
    slip: Annotated[float, RATIO] = 0.0

    drive = "thruster"

    def place(self, body: BodyKind) -> Point:
        """The point of the body that its argument `at` names."""
        return self.at

    @property
    def direction(self) -> Point:
        """The vector of length 1 at the angle that its argument `facing` says."""
        return cosine(self.facing), sine(self.facing)

    def push(self, body: BodyKind) -> tuple[Point, Point]:
        """The place of a thruster on the body, and the direction in which it pushes."""
        return self.at, self.direction
