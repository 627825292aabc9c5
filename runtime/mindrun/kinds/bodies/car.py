"""A rectangular body that is steered."""

from typing import Annotated

from mindrun.kinds.bodies.body import (
    ANGULAR_DAMPING,
    DAMPING,
    DENSITY,
    DIAMETER,
    FRICTION,
    FRICTION_COEFFICIENT,
    LINEAR_DAMPING,
    Rectangular,
)
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import Extent, Quantity

WHEELBASE = Quantity("a share of its length", {"": 1.0, "%": 0.01}, low=0.01, high=1.0)


@kind("body", "car")
class Car(Rectangular):
    """A rectangular body with a motor and a steering, `size` its length and its width, or both: the bicycle model.

    Its two axles, `wheelbase` of its length apart, do not slip sideways: with the steering at δ, a speed of v along its
    heading goes with v·tan δ / 2 to the left and a turn of v·tan δ / distance of the axles. What a push or a turn of
    the steering has left of other motion is lost, as to forces that act on the axles and do no work.
    """

    size: Annotated[Extent, DIAMETER] = (3.0, 2.0)
    wheelbase: Annotated[float, WHEELBASE] = 0.6
    density: Annotated[float, DENSITY] = 2.0
    friction: Annotated[float, FRICTION] = FRICTION_COEFFICIENT
    linear_damping: Annotated[float, DAMPING] = LINEAR_DAMPING
    angular_damping: Annotated[float, DAMPING] = ANGULAR_DAMPING

    drives = ("motor", "steering")

    @property
    def axle_distance(self) -> float:
        """The share of its length."""
        return self.wheelbase * self.sides[0]
