"""A measure of whether the robot moves ahead."""

from mindrun.kinds.measures.measure import MeasureKind
from mindrun.kinds.registry import kind


@kind("measure", "forward")
class Forward(MeasureKind):
    """1 while the robot moves forward, else 0."""

    interval = (0.0, 1.0)
