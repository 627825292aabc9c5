"""Places where nothing is put when a run begins: in the robot, or where it would have been reached before it moved."""

HALF_DIAGONAL = 0.7072  # of a square with side 1, and a little more


def meets_robot(
    is_area: bool, is_round: bool, is_goal: bool, size: float, dx: float, dy: float, radius: float, reach: float
) -> bool:
    """True if a thing (dx, dy) from the robot's middle overlaps the robot, or is a goal that it has reached already.

    On what lies on the floor, an area, the robot may begin, unless that is a goal. `radius` is that of the circle
    around the robot, `reach` how far from its middle the claw's place reaches, whichever way it faces.
    """
    if is_area:
        return is_goal and max(abs(dx), abs(dy)) <= size / 2
    gap = radius + (size / 2 if is_round else size * HALF_DIAGONAL)
    if is_goal:
        gap = max(gap, reach + size / 2)
    return dx * dx + dy * dy < gap * gap
