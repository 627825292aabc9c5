"""A rectangular body that drives on wheels."""

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
from mindrun.numbers.quantity import Extent


@kind("body", "box")
class Box(Rectangular):
    """A rectangular body, `size` being its length and its width, or both, with wheels at its sides, or thrusters.

    Every tick of length dt its velocity is divided by 1 + dt·damping.
    """

    size: Annotated[Extent, DIAMETER] = (3.0, 2.0)
    density: Annotated[float, DENSITY] = 2.0
    friction: Annotated[float, FRICTION] = FRICTION_COEFFICIENT
    linear_damping: Annotated[float, DAMPING] = LINEAR_DAMPING
    angular_damping: Annotated[float, DAMPING] = ANGULAR_DAMPING

    drives = ("wheel", "thruster")
