"""The shapes of solids: circles, and quadrangles that turn; where their corners are, and the rectangles around them."""

import numpy as np

from mindrun.numbers.arithmetic import ANGLE
from mindrun.sim.c_library import COSINE, SINE
from mindrun.sim.state import (
    CORNER,
    CORNERS,
    COSINE_OF,
    HELD,
    HIGH,
    LEFT,
    LOW,
    MIDDLE_X,
    MIDDLE_Y,
    OWN_CORNER,
    RADIUS,
    RIGHT,
    ROBOT,
    SINE_OF,
    SOLID_COLUMNS,
    TURNED,
)  # fmt: skip
from mindrun.sim.units import call_double


def put_corners(solids, at, left, low, right, top):
    """Write the corners of a rectangle into eight columns."""
    solids[at], solids[at + 1], solids[at + 2], solids[at + 3] = left, low, right, low
    solids[at + 4], solids[at + 5], solids[at + 6], solids[at + 7] = right, top, left, top


def turn(tables, solids, p, angle):
    """Note to which angle a solid is turned, with its sine and cosine by C."""
    if solids[p + TURNED] != angle:
        solids[p + SINE_OF] = call_double(tables.library[SINE], angle)
        solids[p + COSINE_OF] = call_double(tables.library[COSINE], angle)
        solids[p + TURNED] = angle


def put_shape(solids, p, x, y):
    """Write where the corners of a solid are, or its middle, and its sides."""
    if solids[p + CORNERS] == 1.0:
        radius = solids[p + RADIUS]
        solids[p + CORNER], solids[p + CORNER + 1] = x, y
        solids[p + LEFT], solids[p + RIGHT], solids[p + LOW], solids[p + HIGH] = (
            x - radius,
            x + radius,
            y - radius,
            y + radius,
        )
        return
    cosine, sine, left, right, low, high = solids[p + COSINE_OF], solids[p + SINE_OF], np.inf, -np.inf, np.inf, -np.inf
    for column in range(0, 8, 2):
        own_x, own_y = solids[p + OWN_CORNER + column], solids[p + OWN_CORNER + column + 1]
        at_x, at_y = cosine * own_x + -sine * own_y + x, sine * own_x + cosine * own_y + y
        solids[p + CORNER + column], solids[p + CORNER + column + 1] = at_x, at_y
        left, right = left if left < at_x else at_x, right if right > at_x else at_x
        low, high = low if low < at_y else at_y, high if high > at_y else at_y
    solids[p + LEFT], solids[p + RIGHT], solids[p + LOW], solids[p + HIGH] = left, right, low, high


def put_held(tables, world, contact, thing, radius, lane):
    """Write the circle of a thing in the claw, which turns with the robot."""
    solids, p, q, hold = contact.solids[lane], SOLID_COLUMNS * ROBOT, SOLID_COLUMNS * HELD, tables.things[thing].hold
    turn(tables, solids, p, world.body[ANGLE, lane])
    x, y = solids[p + COSINE_OF] * hold + solids[p + MIDDLE_X], solids[p + SINE_OF] * hold + solids[p + MIDDLE_Y]
    solids[q + RADIUS], solids[q + MIDDLE_X], solids[q + MIDDLE_Y] = radius, solids[p + MIDDLE_X], solids[p + MIDDLE_Y]
    put_shape(solids, q, x, y)


def overlap(solids, a, b):
    """True if the rectangles along the axes around two solids meet."""
    a, b = SOLID_COLUMNS * a, SOLID_COLUMNS * b
    return (
        solids[a + LEFT] <= solids[b + RIGHT]
        and solids[b + LEFT] <= solids[a + RIGHT]
        and solids[a + LOW] <= solids[b + HIGH]
        and solids[b + LOW] <= solids[a + HIGH]
    )
