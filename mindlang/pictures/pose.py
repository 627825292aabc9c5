"""Where points of the robot are in the world."""

from math import cos, sin

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


def placed(points: ArrayLike, pose: Floats) -> Floats:
    """Points [n, 2] of a body in the world, where it stands at x, y and is turned by an angle."""
    x, y, angle = pose
    turned = np.asarray(points, float) @ np.array([(cos(angle), sin(angle)), (-sin(angle), cos(angle))])
    there: Floats = turned + np.array([x, y])
    return there
