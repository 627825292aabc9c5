"""The procedures of tour.mind: plain functions of the readings."""


def toward(bearing: float) -> tuple[float, float]:
    """The commands of the left and the right wheel that turn the robot to a bearing, 0.5 being straight ahead."""
    turn = bearing - 0.5
    return 0.8 + turn, 0.8 - turn
