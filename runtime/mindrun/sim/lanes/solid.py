"""Collision tests of straight ways, and the rules by which nothing passes anything within a tick.

A lane in which something is so swift that a tick takes it by more than SWIFT_SHARE of its least half side makes its
tick in several **strides**: in each everything moves by at most STRIDE_SHARE of that, or by what is free around it.

Chipmunk's solver lets what is pressed between heavy things give way by and by. What a step of it has brought through
something solid is **held back**: it goes back to where it was, and stands. And what goes round a corner within one tick
is stopped there: the straight way of a middle from tick to tick never leads through what is solid.
"""

import numpy as np

from mindrun.numbers.arithmetic import *
from mindrun.sim.codes import AWAY, FAR, HALF_DIAGONAL, Tables
from mindrun.sim.state import ROBOT, ROBOT_SOLIDS, WorldState
from mindrun.sim.units import seldom, unit_where

CLOSED_UNITS = 1e-6  # so much larger is everything here: what stands corner to corner leaves no way between
SWIFT_SHARE, STRIDE_SHARE = 0.75, 0.5  # of a least half side: beyond which there are strides, and how far one may go
MOST_STRIDES = 100  # in one tick; what time is left then is lost
DEEPEST_SHARE = 0.5  # of the smaller's half side: so deep in one another come two that move


def first_loose(tables):
    """The number of the first loose solid."""
    return ROBOT + ROBOT_SOLIDS * len(tables.robots)


def own_solid(robot):
    """The solid of a robot, behind which stands that of what it holds."""
    return ROBOT + ROBOT_SOLIDS * robot


def within(x, y, angle):
    """True if a place is one at which Chipmunk can compute: none of its numbers is NaN or beyond FAR."""
    return (abs(x) <= FAR) & (abs(y) <= FAR) & (abs(angle) <= FAR)


def is_lost(body, lane):
    """True if a lane's robot is beyond all places."""
    x, y, angle = pose_of(body, lane)
    return not within(x, y, angle)


def put_box(boxes, b, x, y, wide, high):
    """Write box b of a lane: its middle, and half of its sides."""
    box = BOX_COLUMNS * b
    boxes[box + X], boxes[box + Y], boxes[box + HALF_X], boxes[box + HALF_Y] = x, y, wide, high


def count_of(boxes):
    """The number of boxes of a lane."""
    return boxes.shape[1] // BOX_COLUMNS


def remove_box(boxes, b):
    """Let box b of a lane be none."""
    put_box(boxes, b, AWAY, AWAY, 0.0, 0.0)


def is_clear(boxes, x, y, margin, lane):
    """True if no obstacle comes within `margin` of a point, along the axes."""
    for b in range(count_of(boxes)):
        its_x, its_y, wide, high = box_of(boxes, b, lane)
        if abs(its_x - x) < wide + margin and abs(its_y - y) < high + margin:
            return False
    return True


def is_free(tables, world, x, y, half, lane):
    """True if a square of half side `half` around a point meets no wall and no obstacle."""
    half_x, half_y = tables.world[0].half_x, tables.world[0].half_y
    return half_x - abs(x) >= half and half_y - abs(y) >= half and is_clear(world.boxes, x, y, half, lane)


def drift_of(loose, i, lane):
    """The velocity along x and y, and the spin, of loose thing i."""
    row = LOOSE_ROWS * i
    return loose[row + PUSHED_X, lane], loose[row + PUSHED_Y, lane], loose[row + PUSHED_SPIN, lane]


def turn_of(loose, i, lane):
    """The angle by which loose thing i has turned."""
    return loose[LOOSE_ROWS * i + TURN, lane]


def loose_place(tables, world, i, lane):
    """The x and y of loose thing i."""
    return place_of(world.things, tables.loose[i].thing, lane)


def loose_size(tables, world, i, lane):
    """The side or the diameter of loose thing i."""
    return size_of(world.things, tables.loose[i].thing, lane)


def extent_of(tables, world, i, lane):
    """The radius of a circle around loose thing i, however it is turned."""
    return loose_size(tables, world, i, lane) * (0.5 if tables.loose[i].is_round else HALF_DIAGONAL)


def is_barred(boxes, constants, x, y, to_x, to_y, half, lane):
    """True if something of half size `half` meets an obstacle or the border on its way between two places.

    What it stands in when it begins bars nothing: it may get out.
    """
    wide, high = constants.half_x - half, constants.half_y - half
    if (abs(to_x) > wide and abs(x) <= wide) or (abs(to_y) > high and abs(y) <= high):
        return True
    dx, dy = to_x - x, to_y - y
    for b in range(count_of(boxes)):
        its_x, its_y, wide, high = box_of(boxes, b, lane)
        if meets(its_x - x, its_y - y, dx, dy, wide + half, high + half):
            return True
    return False


def is_walled(boxes, x, y, to_x, to_y, lane):
    """True if the way between two places leads through an obstacle that neither of them is in."""
    dx, dy = to_x - x, to_y - y
    for b in range(count_of(boxes)):
        its_x, its_y, wide, high = box_of(boxes, b, lane)
        ends_in = abs(its_x - to_x) < wide and abs(its_y - to_y) < high
        if not ends_in and meets(its_x - x, its_y - y, dx, dy, wide, high):
            return True
    return False


def is_blocked(tables, world, x, y, to_x, to_y, lane):
    """True if the way between two places leads through the square around a loose thing, which does not turn with it."""
    for i in range(len(tables.loose)):
        its_x, its_y = loose_place(tables, world, i, lane)
        half = loose_size(tables, world, i, lane) / 2
        if meets(its_x - x, its_y - y, to_x - x, to_y - y, half, half):
            return True
    return False


def meets(x, y, dx, dy, wide, high):
    """True if a way by (dx, dy) that begins outside meets a rectangle around (x, y): no axis keeps them apart."""
    if abs(x) < wide and abs(y) < high:
        return False
    beside = abs(x - dx / 2) < wide + abs(dx) / 2 and abs(y - dy / 2) < high + abs(dy) / 2
    return beside and abs(x * dy - y * dx) < wide * abs(dy) + high * abs(dx)


def find_swift(tables, world, swift, lanes):
    """Set `swift` of a world's first lane to 1 where it has to make strides, if anything may be swift.

    Return how many may be.
    """
    body, held, constants, count = world.body, world.held, tables.world[0], 0
    own_arm, own_least = 0.0 if constants.is_round else constants.radius, min(constants.front, constants.side)
    arm, least, dt = constants.arm, constants.least, constants.dt
    for lane in range(lanes):
        speed = top_speed(motion_of(body, lane), own_arm if held[lane] < 0 else arm)
        count += speed * dt > SWIFT_SHARE * (own_least if held[lane] < 0 else least)
    for i in range(len(tables.loose)):
        for lane in range(lanes):
            size = loose_size(tables, world, i, lane)
            count += speed_of_loose(tables, world, i, lane) * dt > SWIFT_SHARE * size / 2
    robots = len(tables.robots)
    for home in range(0, lanes if count > 0 else 0, robots):
        swift[home] = 1 if stride(tables, world, home) < dt else 0
    return count


def speed_of_loose(tables, world, i, lane):
    """An upper bound of the speed of any point of loose thing i, in units per second."""
    arm = 0.0 if tables.loose[i].is_round else extent_of(tables, world, i, lane)
    return top_speed(drift_of(world.loose, i, lane), arm)


def top_speed(motion, arm):
    """An upper bound of the speed of any point that is by `arm` from the middle of what moves and spins."""
    vx, vy, spin = motion
    return abs(vx) + abs(vy) + abs(spin) * arm


@unit_where(seldom)
def stride(tables: Tables, world: WorldState, lane: int) -> float:
    """The seconds for which a world may go on at once; infinite where nothing in it is swift."""
    longest = np.inf
    for number in range(len(tables.robots)):
        longest = min(longest, stride_of_robot(tables, world, number, lane))
    for i in range(len(tables.loose)):
        longest = min(longest, stride_of(tables, world, i, lane))
    return longest


def stride_of_robot(tables, world, number, lane):
    """The seconds for which the robot with a number may go on at once; infinite where it is not swift."""
    constants, own_lane = tables.world[0], lane + number
    held, half, reach = world.held[own_lane], min(constants.front, constants.side), reach_of(tables, world, own_lane)
    arm = 0.0 if constants.is_round else constants.radius
    if held >= 0:
        half, arm = min(half, size_of(world.things, held, own_lane) / 2), max(arm, tables.things[held].hold)
    (x, y), speed = middle_of(world.body, own_lane), top_speed(motion_of(world.body, own_lane), arm)
    if not speed * constants.dt > SWIFT_SHARE * half:
        return np.inf
    room = room_around(tables, world, x, y, reach, -1, lane)
    return max(STRIDE_SHARE * half, min(room, room_beside(tables, world, x, y, reach, number, lane))) / speed


def reach_of(tables, world, lane):
    """The radius of a circle around the robot of a lane and what it holds."""
    held, radius = world.held[lane], tables.world[0].radius
    return radius if held < 0 else max(radius, tables.things[held].hold + size_of(world.things, held, lane) / 2)


def stride_of(tables, world, i, lane):
    """The seconds for which loose thing i may go on at once beside the robots of a world."""
    speed, half = speed_of_loose(tables, world, i, lane), loose_size(tables, world, i, lane) / 2
    extent = extent_of(tables, world, i, lane)
    if not speed * tables.world[0].dt > SWIFT_SHARE * half:
        return np.inf
    x, y = loose_place(tables, world, i, lane)
    room = room_around(tables, world, x, y, extent, i, lane)
    return max(STRIDE_SHARE * half, min(room, room_beside(tables, world, x, y, extent, -1, lane))) / speed


def room_beside(tables, world, x, y, extent, but, lane):
    """Half of the gap between something of radius `extent` at a point and the nearest robot but number `but`."""
    room = np.inf
    for number in range(len(tables.robots)):
        if number != but:
            its_x, its_y = middle_of(world.body, lane + number)
            far = max(abs(its_x - x), abs(its_y - y)) - reach_of(tables, world, lane + number)
            room = min(room, (far - extent) / 2)
    return room


def room_around(tables, world, x, y, extent, but, lane):
    """The distance that something of radius `extent` at a point may move in any direction before it meets something.

    Of the gap to a loose thing, thing number `but` aside, half counts: the other half is that one's.
    """
    boxes, constants = world.boxes, tables.world[0]
    room = min(constants.half_x - abs(x), constants.half_y - abs(y)) - extent
    for b in range(count_of(boxes)):
        its_x, its_y, wide, high = box_of(boxes, b, lane)
        room = min(room, max(abs(its_x - x) - wide, abs(its_y - y) - high) - extent)
    for j in range(len(tables.loose)):
        its_x, its_y = loose_place(tables, world, j, lane)
        if j != but and not np.isnan(its_x):
            far = max(abs(its_x - x), abs(its_y - y)) - extent_of(tables, world, j, lane)
            room = min(room, (far - extent) / 2)
    return room


def note_begin(tables, world, solids, lane):
    """Note where everything that moves is as a tick begins, and half of its least side."""
    constants = tables.world[0]
    for number in range(len(tables.robots)):
        a, own_lane = own_solid(number), lane + number
        solids[a].begin.x, solids[a].begin.y = middle_of(world.body, own_lane)
        solids[a].half = min(constants.front, constants.side)
        if world.held[own_lane] >= 0:  # not yet in the claw, where it has just been taken
            note_thing(world, solids[a + 1], world.held[own_lane], own_lane)
    for i in range(len(tables.loose)):
        note_thing(world, solids[first_loose(tables) + i], tables.loose[i].thing, lane)


def note_thing(world, solid, thing, lane):
    """Note where a thing is as a tick begins, and half of its size."""
    solid.begin.x, solid.begin.y = place_of(world.things, thing, lane)
    solid.half = size_of(world.things, thing, lane) / 2


def note_after(tables, world, solids, lane):
    """Note where everything that moves is after a step; NaN where nothing is held."""
    for number in range(len(tables.robots)):
        own_lane, robot, held = lane + number, solids[own_solid(number)].after, solids[own_solid(number) + 1].after
        (robot.x, robot.y), held.x, held.y = middle_of(world.body, own_lane), np.nan, np.nan
        if world.held[own_lane] >= 0:
            hold = tables.things[world.held[own_lane]].hold
            sine, cosine = sine_cosine(world.body[ANGLE, own_lane])
            held.x, held.y = robot.x + cosine * hold, robot.y + sine * hold
    for i in range(len(tables.loose)):
        loose = solids[first_loose(tables) + i].after
        loose.x, loose.y = loose_place(tables, world, i, lane)


def note_before(tables, world, solids, lane):
    """Note where everything that moves is before a step, and how it is turned."""
    note_after(tables, world, solids, lane)
    for a in range(ROBOT, len(solids)):
        solids[a].before.x, solids[a].before.y = solids[a].after.x, solids[a].after.y
    for number in range(len(tables.robots)):
        solids[own_solid(number)].before_angle = world.body[ANGLE, lane + number]
    for i in range(len(tables.loose)):
        solids[first_loose(tables) + i].before_angle = turn_of(world.loose, i, lane)


def hold_back(tables, world, solids, lane):
    """Put back what has passed something since the tick began, and then what passes that."""
    note_after(tables, world, solids, lane)
    a = ROBOT
    while a < len(solids):
        if passes(tables, world, solids, a, lane):
            put_back(tables, world, solids, a, lane)
            a = ROBOT
        else:
            a += 1


def passes(tables, world, solids, a, lane):
    """True if what this step has moved has passed an obstacle, the border or another mover since the tick began."""
    begin, before, after, half = solids[a].begin, solids[a].before, solids[a].after, solids[a].half
    if np.isnan(after.x) or (after.x == before.x and after.y == before.y):
        return False
    if is_barred(world.boxes, tables.world[0], begin.x, begin.y, after.x, after.y, CLOSED_UNITS, lane):
        return True
    for b in range(ROBOT, len(solids)):
        if solids[b].body != solids[a].body and not np.isnan(solids[b].after.x):
            its_begin, its_after, its_half = solids[b].begin, solids[b].after, solids[b].half
            near = half + its_half - DEEPEST_SHARE * min(half, its_half)
            dx = after.x - begin.x - (its_after.x - its_begin.x)
            dy = after.y - begin.y - (its_after.y - its_begin.y)
            if comes_nearer(its_begin.x - begin.x, its_begin.y - begin.y, dx, dy, near):
                return True
    return False


def comes_nearer(x, y, dx, dy, near):
    """True if a way by (dx, dy) comes nearer than `near` to the place (x, y), and nearer than it begins."""
    along, length = x * dx + y * dy, dx * dx + dy * dy
    if along <= 0.0 or length == 0.0:
        return False
    share = min(1.0, along / length)
    aside_x, aside_y = x - share * dx, y - share * dy
    return aside_x * aside_x + aside_y * aside_y < near * near


def put_back(tables, world, solids, a, lane):
    """Put a mover, the robot with what it holds, back to its place before the step, without any speed."""
    solid, body, i = solids[a], world.body, a - first_loose(tables)
    if i < 0:
        own_lane, robot, held = lane + solid.robot, solids[solid.body], solids[solid.body + 1]
        body[X, own_lane], body[Y, own_lane], body[ANGLE, own_lane] = robot.before.x, robot.before.y, robot.before_angle
        body[SPEED_X, own_lane], body[SPEED_Y, own_lane], body[SPIN, own_lane] = 0.0, 0.0, 0.0
        robot.after.x, robot.after.y = robot.before.x, robot.before.y
        held.after.x, held.after.y = held.before.x, held.before.y
        return
    row = LOOSE_ROWS * i
    solid.after.x, solid.after.y = solid.before.x, solid.before.y
    put_thing(world.things, tables.loose[i].thing, solid.before.x, solid.before.y, lane)
    world.loose[row : row + LOOSE_ROWS, lane] = 0.0
    world.loose[row + TURN, lane] = solid.before_angle
