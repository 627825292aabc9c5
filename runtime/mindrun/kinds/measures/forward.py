"""Whether the robot moves ahead."""

from dataclasses import dataclass

from mindrun.kinds.measures.measure import MeasureKind
from mindrun.kinds.registry import kind


@kind("measure", "forward")
@dataclass(frozen=True, slots=True)
class Forward(MeasureKind):
    """1 while the robot moves forward, else 0."""

    interval = (0.0, 1.0)
