"""The reward of a Gymnasium environment, as a measure."""

from mindrun.kinds.measures.measure import MeasureKind
from mindrun.kinds.registry import kind


@kind("measure", "its reward")
class ItsReward(MeasureKind):
    """The reward that the Gymnasium environment gave for this step."""

    is_outside = True
