"""What every kind of measure says of itself: the rest of the program asks, and knows no kind by name."""

from collections.abc import Mapping
from math import inf

from mindrun.kinds.registry import base
from mindrun.kinds.things.thing import AboutThing

Row = Mapping[str, float]  # columns of the lanes' table of measures


@base("measure")
class MeasureKind(AboutThing):
    """A measure that can be any number; a kind says what is different about it."""

    __slots__ = ()

    is_outside = False  # whether an environment says what it is
    interval = (-inf, inf)  # its least and its greatest value

    @property
    def remembered(self) -> int:
        """Of how many ticks the lanes remember what it is made of."""
        return 0

    def row(self) -> Row:
        """What the lanes are told of it beside its thing: the share `beyond` which it counts."""
        return {}
