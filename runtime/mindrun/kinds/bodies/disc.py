"""What is round, and drives on wheels."""

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


@kind("body", "disc")
class Disc(Round):
    """A round body of diameter `size` with wheels on its rim, or thrusters.

    Every tick of length dt its velocity is divided by 1 + dt·damping.
    """

    size: Annotated[float, DIAMETER] = 2.0
    density: Annotated[float, DENSITY] = 2.0
    friction: Annotated[float, FRICTION] = FRICTION_COEFFICIENT
    linear_damping: Annotated[float, DAMPING] = LINEAR_DAMPING
    angular_damping: Annotated[float, DAMPING] = ANGULAR_DAMPING

    drives = ("wheel", "thruster")
