"""A round thing that can be pushed."""

from typing import Annotated

from mindrun.kinds.bodies.body import DAMPING, DENSITY
from mindrun.kinds.registry import kind
from mindrun.kinds.things.thing import Loose


@kind("content", "ball")
class Ball(Loose):
    """A solid disc of diameter `size` that can be pushed, and rolls on for a while; all else is as of a box."""

    density: Annotated[float, DENSITY] = 0.2
    damping: Annotated[float, DAMPING] = 1.0

    is_round = True
