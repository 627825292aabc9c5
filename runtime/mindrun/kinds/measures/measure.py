"""The base class of measures: the rest of the program asks a kind for these, and knows none by name."""

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
        """The number of ticks whose changes of commands the lanes keep for it."""
        return 0

    def row(self) -> Row:
        """Its columns of the lanes' table beside its thing: the share `beyond` which it counts."""
        return {}
