"""Loose: boxes and balls while nothing touches them. They slide, turn, slow down and rest.

A thing is **settled** when it has not moved for SETTLED_TICKS: nothing looks at it again until the robot, or something
else that moves, comes near. Where all are, a lane has nothing to do. Contacts that are still there do not change any
more by then: what Chipmunk remembers of them has become too small to move anything.
"""

import numpy as np

from mindrun.numbers.arithmetic import (
    BOX_COLUMNS,
    HALF_X,
    HALF_Y,
    LOOSE_ROWS,
    PUSHED_SPIN,
    PUSHED_X,
    PUSHED_Y,
    SIZE,
    SPEED_X,
    SPEED_Y,
    THING_ROWS,
    TURN,
    X,
    Y,
)
from mindrun.sim.compiling import compiled
from mindrun.sim.lanes.places import within

REST_SPEED = 1e-3  # units and radians per second: what is slower stands still
SETTLED_TICKS = 32
HALF_DIAGONAL = 0.7072  # of a square with side 1, and a little more
LOOSE_MARGIN_UNITS = 0.01  # beyond the rounding of any distance here


@compiled
def slow_down(tables, world, placed, lane):
    """Damp what has not settled, v / (1 + dt·c), and let it rest where it is slow enough.

    Its body in the Space has to be `placed` again: it may have appeared elsewhere, and settles there without a contact.
    """
    loose, dt, restless = world.loose, tables.world[0].dt, 0
    for i in range(len(tables.loose)):
        if world.still[i, lane] < SETTLED_TICKS:
            placed[lane, i] = 0
            row, place = LOOSE_ROWS * i, THING_ROWS * tables.loose[i].thing
            slower = world.numbers[tables.loose[i].slower, lane]
            vx, vy = loose[row + PUSHED_X, lane] * slower, loose[row + PUSHED_Y, lane] * slower
            spin = loose[row + PUSHED_SPIN, lane] * slower
            x, y = world.things[place + X, lane], world.things[place + Y, lane]
            there = within(x + vx * dt, y + vy * dt, loose[row + TURN, lane] + spin * dt)
            if not there:  # gone, or beyond all places
                world.things[place + X, lane], world.things[place + Y, lane] = np.nan, np.nan
            rests = is_at_rest(vx, vy, spin) or not there
            loose[row + PUSHED_X, lane] = 0.0 if rests else vx
            loose[row + PUSHED_Y, lane] = 0.0 if rests else vy
            loose[row + PUSHED_SPIN, lane] = 0.0 if rests else spin
            world.still[i, lane] = (world.still[i, lane] + 1 if there else SETTLED_TICKS) if rests else 0
            restless += 1
    world.restless[lane] = restless


@compiled
def is_at_rest(vx, vy, spin):
    """Whether something moves and turns so slowly that it rests."""
    return abs(vx) < REST_SPEED and abs(vy) < REST_SPEED and abs(spin) < REST_SPEED


@compiled
def could_touch(tables, world, lane):
    """Whether something that has not settled could touch anything but the robot after this tick."""
    dt = tables.world[0].dt
    for i in range(len(tables.loose)):
        if world.still[i, lane] < SETTLED_TICKS:
            row, place = LOOSE_ROWS * i, THING_ROWS * tables.loose[i].thing
            x = world.things[place + X, lane] + world.loose[row + PUSHED_X, lane] * dt
            y = world.things[place + Y, lane] + world.loose[row + PUSHED_Y, lane] * dt
            extent = extent_of(tables, world, i, lane) + LOOSE_MARGIN_UNITS
            if meets_fixed(tables, world, x, y, extent, lane) or meets_loose(tables, world, i, x, y, extent, lane):
                return True
    return False


@compiled
def extent_of(tables, world, i, lane):
    """How far loose thing i reaches from its middle."""
    body = tables.loose[i]
    return world.things[THING_ROWS * body.thing + SIZE, lane] * (0.5 if body.is_round else HALF_DIAGONAL)


@compiled
def meets_fixed(tables, world, x, y, extent, lane):
    """Whether walls or obstacles come within `extent` of a point, along the axes."""
    boxes = world.boxes
    if tables.world[0].half_x - abs(x) < extent or tables.world[0].half_y - abs(y) < extent:
        return True
    for b in range(boxes.shape[1] // BOX_COLUMNS):
        box = BOX_COLUMNS * b
        wide, high = boxes[lane, box + HALF_X] + extent, boxes[lane, box + HALF_Y] + extent
        if abs(boxes[lane, box + X] - x) < wide and abs(boxes[lane, box + Y] - y) < high:
            return True
    return False


@compiled
def meets_loose(tables, world, i, x, y, extent, lane):
    """Whether another loose thing could come within `extent` of a point in this tick."""
    dt = tables.world[0].dt
    for j in range(len(tables.loose)):
        if j != i:
            row, place = LOOSE_ROWS * j, THING_ROWS * tables.loose[j].thing
            dx = world.things[place + X, lane] + world.loose[row + PUSHED_X, lane] * dt - x
            dy = world.things[place + Y, lane] + world.loose[row + PUSHED_Y, lane] * dt - y
            gap = extent_of(tables, world, j, lane) + extent
            if dx * dx + dy * dy < gap * gap:
                return True
    return False


@compiled
def approach_loose(tables, world, gap, lanes):
    """`gap` lowered to the distance between the robot's next centre and each loose thing."""
    body, loose, things, dt = world.body, world.loose, world.things, tables.world[0].dt
    for i in range(len(tables.loose)):
        row, place = LOOSE_ROWS * i, THING_ROWS * tables.loose[i].thing
        of_size = 0.5 if tables.loose[i].is_round else HALF_DIAGONAL
        for lane in range(lanes):
            dx = things[place + X, lane] + loose[row + PUSHED_X, lane] * dt - (body[X, lane] + body[SPEED_X, lane] * dt)
            dy = things[place + Y, lane] + loose[row + PUSHED_Y, lane] * dt - (body[Y, lane] + body[SPEED_Y, lane] * dt)
            far = np.sqrt(dx * dx + dy * dy) - of_size * things[place + SIZE, lane]
            gap[lane] = far if far < gap[lane] else gap[lane]


@compiled
def slide(tables, world, lane):
    """Chipmunk's step of what touches nothing."""
    loose, dt = world.loose, tables.world[0].dt
    for i in range(len(tables.loose)):
        if world.still[i, lane] == 0:
            row, place = LOOSE_ROWS * i, THING_ROWS * tables.loose[i].thing
            world.things[place + X, lane] = world.things[place + X, lane] + loose[row + PUSHED_X, lane] * dt
            world.things[place + Y, lane] = world.things[place + Y, lane] + loose[row + PUSHED_Y, lane] * dt
            loose[row + TURN, lane] = loose[row + TURN, lane] + loose[row + PUSHED_SPIN, lane] * dt


@compiled
def stand(world, i, lane):
    """Loose thing i stands straight and still where it has been placed; it may have been placed against something."""
    world.loose[LOOSE_ROWS * i : LOOSE_ROWS * (i + 1), lane] = 0.0
    world.still[i, lane], world.restless[lane] = 0, 1
