"""What goes straight to something, or away from it: walkers step so, and loose things drive themselves."""

import numpy as np

from mindrun.numbers.arithmetic import X, Y, place_of


def seek(world, row, x, y, lane):
    """The way along x and y that something at a place wants to go in this tick, as its row of a table says.

    It leads straight towards the nearest that it seeks and not past that, or away from what it flees. It is no number
    where that is too far away, or where there is no direction away from it.
    """
    dx, dy, far = 0.0, 0.0, np.inf
    if row.afters == 0:
        dx, dy = world.body[X, lane] - x, world.body[Y, lane] - y
        far = np.sqrt(dx * dx + dy * dy)
    for other in range(row.after, row.after + row.afters):
        its_x, its_y = place_of(world.things, other, lane)
        away = np.sqrt((its_x - x) * (its_x - x) + (its_y - y) * (its_y - y))
        if other != row.thing and away < far:  # one that has vanished is no number away
            dx, dy, far = its_x - x, its_y - y, away
    if not far <= row.range or (far == 0.0 and row.aim < 0):
        return np.nan, np.nan
    share = row.aim * world.numbers[row.step, lane] / far if far > 0.0 else 0.0
    share = min(share, 1.0)
    return dx * share, dy * share
