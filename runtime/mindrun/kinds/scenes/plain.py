"""A scene without walls."""

from mindrun.kinds.registry import kind
from mindrun.kinds.scenes.scene import SceneKind

MIN_DISTANCE_UNITS, MAX_DISTANCE_UNITS = 10.0, 40.0  # units from the robot


@kind("task", "plain")
class Plain(SceneKind):
    """A world without borders; the robot starts in its origin."""

    def distances(self, least: float) -> tuple[float, float]:
        """The least and the greatest distance, so that the robot can find the thing."""
        return MIN_DISTANCE_UNITS, MAX_DISTANCE_UNITS
