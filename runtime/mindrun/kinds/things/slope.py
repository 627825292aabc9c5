"""Steep squares on the floor."""

from dataclasses import replace
from math import pi
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.kinds.things.thing import SPEED, Placed
from mindrun.numbers.quantity import ANGLE, POSITIVE, Place
from mindrun.numbers.trigonometry import cosine, sine

PULL = replace(POSITIVE, name="a force", low=0.0)


@kind("content", "slope")
class Slope(Placed):
    """A steep square of side `size` on the floor: down is where it is `facing`.

    An item on it that no claw holds slides down, at `slides` units per second, until its middle has left the square;
    and a force `pull` draws a robot down whose middle is on it. `reached` is as for a zone.
    """

    facing: Annotated[float, ANGLE] = -pi / 2
    slides: Annotated[float, SPEED] = 5.0
    pull: Annotated[float, PULL] = 0.0

    is_area = True
    is_steep = True

    @property
    def down(self) -> Place:
        """The direction in which it leads down, of length 1."""
        return cosine(self.facing), sine(self.facing)
