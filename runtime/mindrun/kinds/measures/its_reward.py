"""What an environment pays."""

from dataclasses import dataclass

from mindrun.kinds.measures.measure import MeasureKind
from mindrun.kinds.registry import kind


@kind("measure", "its reward")
@dataclass(frozen=True, slots=True)
class ItsReward(MeasureKind):
    """The reward that the Gymnasium environment gave for this step."""

    is_outside = True
