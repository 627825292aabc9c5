"""What is round, and is pushed in any direction."""

from typing import Annotated

from mindrun.kinds.bodies.body import (
    ANGULAR_DAMPING,
    DAMPING,
    DENSITY,
    DIAMETER,
    FRICTION,
    FRICTION_COEFFICIENT,
    LINEAR_DAMPING,
)
from mindrun.kinds.bodies.round import Round
from mindrun.kinds.registry import kind


@kind("body", "holonomic")
class Holonomic(Round):
    """A round body of diameter `size` that three thrusters or more push in any direction, and turn.

    Every tick of length dt its velocity is divided by 1 + dt·damping.
    """

    size: Annotated[float, DIAMETER] = 2.0
    density: Annotated[float, DENSITY] = 2.0
    friction: Annotated[float, FRICTION] = FRICTION_COEFFICIENT
    linear_damping: Annotated[float, DAMPING] = LINEAR_DAMPING
    angular_damping: Annotated[float, DAMPING] = ANGULAR_DAMPING

    drives = ("thruster",)
