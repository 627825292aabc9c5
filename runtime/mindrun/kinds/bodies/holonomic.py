"""A round body that is pushed in any direction."""

from mindrun.kinds.bodies.body import Round
from mindrun.kinds.registry import kind


@kind("body", "holonomic")
class Holonomic(Round):
    """A round body of diameter `size` that three thrusters or more push in any direction, and turn.

    Every tick of length dt its velocity is divided by 1 + dt·damping.
    """

    drives = ("thruster",)
