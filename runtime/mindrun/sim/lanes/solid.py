"""Solid: whether a straight way leads through what stands in it."""

from mindrun.numbers.arithmetic import BOX_COLUMNS, HALF_X, HALF_Y, SIZE, THING_ROWS, X, Y
from mindrun.sim.compiling import compiled

CLOSED_UNITS = 1e-6  # so much larger is everything here: what stands corner to corner leaves no way between


@compiled
def is_barred(boxes, constants, x, y, to_x, to_y, half, lane):
    """Whether something of that half size meets an obstacle or the border on its way between two places.

    What it stands in when it begins bars nothing: it may get out.
    """
    wide, high = constants.half_x - half, constants.half_y - half
    if (abs(to_x) > wide and abs(x) <= wide) or (abs(to_y) > high and abs(y) <= high):
        return True
    dx, dy = to_x - x, to_y - y
    for b in range(boxes.shape[1] // BOX_COLUMNS):
        box = BOX_COLUMNS * b
        wide, high = boxes[lane, box + HALF_X] + half, boxes[lane, box + HALF_Y] + half
        if meets(boxes[lane, box + X] - x, boxes[lane, box + Y] - y, dx, dy, wide, high):
            return True
    return False


@compiled
def is_walled(boxes, x, y, to_x, to_y, lane):
    """Whether an obstacle lies wholly within the way between two places: neither is in it."""
    dx, dy = to_x - x, to_y - y
    for b in range(boxes.shape[1] // BOX_COLUMNS):
        box = BOX_COLUMNS * b
        wide, high = boxes[lane, box + HALF_X], boxes[lane, box + HALF_Y]
        ends_in = abs(boxes[lane, box + X] - to_x) < wide and abs(boxes[lane, box + Y] - to_y) < high
        if not ends_in and meets(boxes[lane, box + X] - x, boxes[lane, box + Y] - y, dx, dy, wide, high):
            return True
    return False


@compiled
def is_blocked(tables, world, x, y, to_x, to_y, lane):
    """Whether the way between two places leads through a loose thing, as large as half its least side around it."""
    for i in range(len(tables.loose)):
        place = THING_ROWS * tables.loose[i].thing
        half, dx, dy = world.things[place + SIZE, lane] / 2, to_x - x, to_y - y
        if meets(world.things[place + X, lane] - x, world.things[place + Y, lane] - y, dx, dy, half, half):
            return True
    return False


@compiled
def meets(x, y, dx, dy, wide, high):
    """Whether a way by (dx, dy) that begins outside meets a rectangle around (x, y): no axis keeps them apart."""
    if abs(x) < wide and abs(y) < high:
        return False
    beside = abs(x - dx / 2) < wide + abs(dx) / 2 and abs(y - dy / 2) < high + abs(dy) / 2
    return beside and abs(x * dy - y * dx) < wide * abs(dy) + high * abs(dx)
