"""A square on which the battery charges."""

from mindrun.kinds.registry import kind
from mindrun.kinds.things.thing import Placed


@kind("content", "power")
class Power(Placed):
    """A square of side `size` on the floor, or `count` of them, in which the battery charges.

    `reached` is as for a zone.
    """

    is_area = True
    charges = True
