"""A round body that drives on wheels."""

from mindrun.kinds.bodies.body import Round
from mindrun.kinds.registry import kind


@kind("body", "disc")
class Disc(Round):
    """A round body of diameter `size` with wheels on its rim, or thrusters.

    Every tick of length dt its velocity is divided by 1 + dt·damping.
    """

    drives = ("wheel", "thruster")
