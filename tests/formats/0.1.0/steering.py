"""How Home steers."""


def toward(bearing: float) -> tuple[float, float]:
    """Wheels that turn the robot to a bearing."""
    return 0.5 + bearing / 4, 0.75 - bearing / 4
