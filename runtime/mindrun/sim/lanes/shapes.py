"""The shapes of solids: circles, and quadrangles that turn; where their corners are, and the rectangles around them."""

import numpy as np

from mindrun.numbers.arithmetic import ANGLE
from mindrun.sim.c_library import COSINE, SINE
from mindrun.sim.state import HELD, ROBOT
from mindrun.sim.units import call_double


def put_corners(corners, left, low, right, top):
    """Write the corners of a rectangle."""
    corners[0].x, corners[0].y = left, low
    corners[1].x, corners[1].y = right, low
    corners[2].x, corners[2].y = right, top
    corners[3].x, corners[3].y = left, top


def turn(tables, solid, angle):
    """Note to which angle a solid is turned, with its sine and cosine by C."""
    if solid.turned != angle:
        solid.sine = call_double(tables.library[SINE], angle)
        solid.cosine = call_double(tables.library[COSINE], angle)
        solid.turned = angle


def put_shape(solid, x, y):
    """Write where the corners of a solid are, or its middle, and its sides."""
    if solid.is_round:
        radius = solid.radius
        solid.corners[0].x, solid.corners[0].y = x, y
        solid.left, solid.right, solid.low, solid.high = x - radius, x + radius, y - radius, y + radius
        return
    cosine, sine, left, right, low, high = solid.cosine, solid.sine, np.inf, -np.inf, np.inf, -np.inf
    for i in range(4):
        own = solid.own_corners[i]
        at_x, at_y = cosine * own.x + -sine * own.y + x, sine * own.x + cosine * own.y + y
        solid.corners[i].x, solid.corners[i].y = at_x, at_y
        left, right = left if left < at_x else at_x, right if right > at_x else at_x
        low, high = low if low < at_y else at_y, high if high > at_y else at_y
    solid.left, solid.right, solid.low, solid.high = left, right, low, high


def put_held(tables, world, contact, thing, radius, lane):
    """Write the circle of a thing in the claw, which turns with the robot."""
    robot, held, hold = contact.solids[lane, ROBOT], contact.solids[lane, HELD], tables.things[thing].hold
    turn(tables, robot, world.body[ANGLE, lane])
    held.radius, held.middle_x, held.middle_y = radius, robot.middle_x, robot.middle_y
    put_shape(held, robot.cosine * hold + robot.middle_x, robot.sine * hold + robot.middle_y)


def overlap(a, b):
    """True if the rectangles along the axes around two solids meet."""
    return a.left <= b.right and b.left <= a.right and a.low <= b.high and b.low <= a.high
