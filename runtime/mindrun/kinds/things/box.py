"""A square thing that can be pushed."""

from mindrun.kinds.registry import kind
from mindrun.kinds.things.thing import Loose


@kind("content", "box")
class LooseBox(Loose):
    """A solid square of side `size` that can be pushed, and turns as it is pushed.

    Each tick of length dt divides its velocity and its spin by 1 + dt·damping. `friction` multiplies with that of what
    it touches: the robot's is 0.2, a wall's and an obstacle's 1. It is `reached` when the claw could take it if it were
    an item, and `delivered` when its middle is pushed into a zone: it stays, moves elsewhere or vanishes.
    """
