"""The change of the distance to a thing: three kinds that differ in which direction counts."""

from math import inf
from typing import Annotated

from mindrun.kinds.measures.measure import MeasureKind
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import THING


@kind("measure", "progress")
class Progress(MeasureKind):
    """Distance to the thing's centre closed in this tick, in world units; negative when moving away."""

    toward: Annotated[str, THING]


@kind("measure", "advance")
class Advance(MeasureKind):
    """The progress toward the thing where it is positive, else 0."""

    toward: Annotated[str, THING]

    interval = (0.0, inf)


@kind("measure", "retreat")
class Retreat(MeasureKind):
    """The distance to the thing gained in this tick where it grew, else 0."""

    from_: Annotated[str, THING]

    interval = (0.0, inf)
