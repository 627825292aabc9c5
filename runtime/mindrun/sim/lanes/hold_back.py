"""Hold back: what a step of Chipmunk has brought through something solid goes back to where it was, and stands.

Its solver lets what is pressed between heavy things give way by and by. And what goes round a corner within one tick is
stopped there: the straight way of a middle from tick to tick never leads through what is solid. `ways` has the middle
of everything that moves: the robot, what it holds, each loose thing.
"""

import numpy as np

from mindrun.numbers.arithmetic import ANGLE, LOOSE_ROWS, SIZE, SPEED_X, SPEED_Y, SPIN, THING_ROWS, TURN, X, Y
from mindrun.sim.arithmetic import sine_cosine
from mindrun.sim.compiling import compiled, part_of_tick
from mindrun.sim.lanes.solid import CLOSED_UNITS, is_barred
from mindrun.sim.state import BEGIN_X, BEGIN_Y, FROM_ANGLE, FROM_X, FROM_Y, HALF, TO_X, TO_Y, WAY

HELD, FIRST_LOOSE = WAY, 2 * WAY  # where they stand in `ways`; the robot comes first
DEEPEST_SHARE = 0.5  # of the smaller's half side: so deep in one another come two that move


@part_of_tick
def note_begin(tables, world, ways, lane):
    """Where everything that moves is when a tick begins, and half its least side; NaN where nothing is held."""
    constants, held = tables.world[0], world.held[lane]
    ways[BEGIN_X], ways[BEGIN_Y] = world.body[X, lane], world.body[Y, lane]
    ways[HALF] = min(constants.front, constants.side)
    if held >= 0:
        place = THING_ROWS * held  # not yet in the claw, where it has just been taken
        ways[HELD + BEGIN_X], ways[HELD + BEGIN_Y] = world.things[place + X, lane], world.things[place + Y, lane]
        ways[HELD + HALF] = world.things[place + SIZE, lane] / 2
    for i in range(len(tables.loose)):
        way, place = FIRST_LOOSE + WAY * i, THING_ROWS * tables.loose[i].thing
        ways[way + BEGIN_X], ways[way + BEGIN_Y] = world.things[place + X, lane], world.things[place + Y, lane]
        ways[way + HALF] = world.things[place + SIZE, lane] / 2


@part_of_tick
def note_places(tables, world, ways, x, y, lane):
    """Where everything that moves is before a step of Chipmunk, or after it: into columns `x` and `y` of its way."""
    ways[x], ways[y] = world.body[X, lane], world.body[Y, lane]
    ways[HELD + x], ways[HELD + y] = np.nan, np.nan
    if world.held[lane] >= 0:
        hold = tables.things[world.held[lane]].hold
        sine, cosine = sine_cosine(world.body[ANGLE, lane])
        ways[HELD + x], ways[HELD + y] = ways[x] + cosine * hold, ways[y] + sine * hold
    for i in range(len(tables.loose)):
        way, place = FIRST_LOOSE + WAY * i, THING_ROWS * tables.loose[i].thing
        ways[way + x], ways[way + y] = world.things[place + X, lane], world.things[place + Y, lane]


@part_of_tick
def note_before(tables, world, ways, lane):
    """Where everything that moves is before a step, and how it is turned."""
    note_places(tables, world, ways, FROM_X, FROM_Y, lane)
    ways[FROM_ANGLE] = world.body[ANGLE, lane]
    for i in range(len(tables.loose)):
        ways[FIRST_LOOSE + WAY * i + FROM_ANGLE] = world.loose[LOOSE_ROWS * i + TURN, lane]


@compiled
def hold_back(tables, world, ways, lane):
    """Put back what has passed something since the tick began, and then what passes that."""
    note_places(tables, world, ways, TO_X, TO_Y, lane)
    way, last = 0, FIRST_LOOSE + WAY * len(tables.loose)
    while way < last:
        if passes(tables, world, ways, way, last, lane):
            put_back(tables, world, ways, way, lane)
            way = 0
        else:
            way += WAY


@compiled
def passes(tables, world, ways, way, last, lane):
    """Whether something that this step has moved has come through what never moves, or through what does."""
    x, y, to_x, to_y = ways[way + BEGIN_X], ways[way + BEGIN_Y], ways[way + TO_X], ways[way + TO_Y]
    if np.isnan(to_x) or (to_x == ways[way + FROM_X] and to_y == ways[way + FROM_Y]):
        return False
    if is_barred(world.boxes, tables.world[0], x, y, to_x, to_y, CLOSED_UNITS, lane):
        return True
    for other in range(FIRST_LOOSE if way < FIRST_LOOSE else 0, last, WAY):
        if other != way and not np.isnan(ways[other + TO_X]):
            near = ways[way + HALF] + ways[other + HALF] - DEEPEST_SHARE * min(ways[way + HALF], ways[other + HALF])
            its_dx, its_dy = ways[other + TO_X] - ways[other + BEGIN_X], ways[other + TO_Y] - ways[other + BEGIN_Y]
            dx, dy = to_x - x - its_dx, to_y - y - its_dy
            if comes_nearer(ways[other + BEGIN_X] - x, ways[other + BEGIN_Y] - y, dx, dy, near):
                return True
    return False


@compiled
def comes_nearer(x, y, dx, dy, near):
    """Whether a way by (dx, dy) leads nearer to a place (x, y) than that, and than where it begins."""
    along, length = x * dx + y * dy, dx * dx + dy * dy
    if along <= 0.0 or length == 0.0:
        return False
    share = min(1.0, along / length)
    aside_x, aside_y = x - share * dx, y - share * dy
    return aside_x * aside_x + aside_y * aside_y < near * near


@compiled
def put_back(tables, world, ways, way, lane):
    """Something, the robot with what it holds, to where it was before the step, without any speed."""
    if way < FIRST_LOOSE:
        world.body[X, lane], world.body[Y, lane], world.body[ANGLE, lane] = ways[FROM_X], ways[FROM_Y], ways[FROM_ANGLE]
        world.body[SPEED_X, lane], world.body[SPEED_Y, lane], world.body[SPIN, lane] = 0.0, 0.0, 0.0
        for each in (0, HELD):
            ways[each + TO_X], ways[each + TO_Y] = ways[each + FROM_X], ways[each + FROM_Y]
        return
    i = (way - FIRST_LOOSE) // WAY
    row, place = LOOSE_ROWS * i, THING_ROWS * tables.loose[i].thing
    ways[way + TO_X], ways[way + TO_Y] = ways[way + FROM_X], ways[way + FROM_Y]
    world.things[place + X, lane], world.things[place + Y, lane] = ways[way + FROM_X], ways[way + FROM_Y]
    world.loose[row : row + LOOSE_ROWS, lane] = 0.0
    world.loose[row + TURN, lane] = ways[way + FROM_ANGLE]
