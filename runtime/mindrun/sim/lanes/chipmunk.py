"""Chipmunk from compiled code: a Space for each lane in which something could touch.

The robot's body with its shapes, and the boxes and walls of one lane, live in a Space of the lane's own, opened when
something could touch for the first time. `chipmunk_internals` has what is known of the library.
"""

import numpy as np

from mindrun.numbers.arithmetic import BOX_COLUMNS, HALF_X, HALF_Y, SIZE, THING_ROWS, X, Y
from mindrun.sim.chipmunk_internals import (
    ARRAY_NUMBERS,
    BODY,
    BODY_FREE,
    BODY_GET,
    BODY_NEW,
    BODY_SET,
    CIRCLE_RADIUS,
    COUNT,
    EACH_ARBITER,
    EMPTY_ARRAY,
    FIRST_HELD,
    FIXED_BODY,
    FLOAT_FORCE_X,
    FLOAT_FORCE_Y,
    FLOAT_TORQUE,
    GET_BATCH,
    MOTION_FLOATS,
    POLY_NEW,
    ROBOT,
    SET_BATCH,
    SHAPE_BODY,
    SHAPE_FREE,
    SHAPE_FRICTION,
    SHAPE_SENSOR,
    SPACE,
    SPACE_ADD_BODY,
    SPACE_ADD_SHAPE,
    SPACE_FREE,
    SPACE_HASH,
    SPACE_ITERATIONS,
    SPACE_NEW,
    SPACE_REMOVE_BODY,
    SPACE_REMOVE_SHAPE,
    SPACE_SLOP,
    SPACE_STATIC,
    SPACE_STEP,
    TALLIED,
    call,
)
from mindrun.sim.codes import FORCE_X, FORCE_Y, TORQUE
from mindrun.sim.compiling import compiled
from mindrun.sim.lanes.loose_space import add_loose, push_loose, remove_loose, take_loose
from mindrun.sim.lanes.placement import ENDLESS_UNITS

SOLVER_ITERATIONS = 8
HALF_WALL_UNITS = 1.0  # half the thickness of a wall, outside the arena
HASH_COUNT = 20


@compiled
def open_space(tables, world, contact, lane):
    """A Space with a lane's obstacles and walls, and its robot with the circles that it can hold."""
    library, constants, handles = tables.library, tables.world[0], contact.handles[lane]
    space = call(library[SPACE_NEW])
    call(library[SPACE_ITERATIONS], space, SOLVER_ITERATIONS)
    call(library[SPACE_SLOP], space, constants.slop)
    call(library[SPACE_HASH], space, constants.cell, HASH_COUNT)
    add_boxes(library, space, world.boxes[lane], constants, handles, len(tables.things), contact.floats[lane])
    mass, moment = world.numbers[constants.mass, lane], world.numbers[constants.moment, lane]
    body = call(library[BODY_NEW], mass, moment)
    call(library[SPACE_ADD_BODY], space, body)
    for circle in range(ROBOT, FIRST_HELD + len(tables.things)):
        if handles[circle] != 0:
            call(library[SHAPE_BODY], handles[circle], body)
            call(library[SPACE_ADD_SHAPE], space, handles[circle])
    call(library[SHAPE_FRICTION], handles[ROBOT], world.numbers[constants.friction, lane])
    handles[SPACE], handles[BODY] = space, body
    contact.tally[lane, FIXED_BODY] = call(library[SPACE_STATIC], space)
    contact.last[lane] = np.inf
    add_loose(tables, world, space, contact, lane)


@compiled
def add_boxes(library, space, boxes, constants, handles, things, corners):
    """The obstacles of a lane, and the walls of an arena; their shapes into `handles`, after those of the things."""
    static = call(library[SPACE_STATIC], space)
    count, shape = len(boxes) // BOX_COLUMNS, FIRST_HELD + things
    for b in range(count):
        box = BOX_COLUMNS * b
        x, y, wide, high = boxes[box + X], boxes[box + Y], boxes[box + HALF_X], boxes[box + HALF_Y]
        handles[shape + b] = add_box(library, space, static, corners, x - wide, y - high, x + wide, y + high)
    shape += count
    x, y = constants.half_x, constants.half_y
    if x < ENDLESS_UNITS:
        far_x, far_y = x + 2 * HALF_WALL_UNITS, y + 2 * HALF_WALL_UNITS
        handles[shape] = add_box(library, space, static, corners, -far_x, -far_y, -x, far_y)
        handles[shape + 1] = add_box(library, space, static, corners, x, -far_y, far_x, far_y)
        handles[shape + 2] = add_box(library, space, static, corners, -far_x, -far_y, far_x, -y)
        handles[shape + 3] = add_box(library, space, static, corners, -far_x, y, far_x, far_y)


@compiled
def add_box(library, space, static, corners, left, low, right, high):
    """A solid rectangle that never moves; its shape. `corners` is room for eight floats."""
    corners[0], corners[1], corners[2], corners[3] = left, low, right, low
    corners[4], corners[5], corners[6], corners[7] = right, high, left, high
    shape = call(library[POLY_NEW], static, 4, corners.ctypes.data, 0.0)
    call(library[SHAPE_FRICTION], shape, 1.0)
    call(library[SPACE_ADD_SHAPE], space, shape)
    return shape


@compiled
def close_space(tables, contact, lane):
    """Free a lane's Space; its circles, the robot's and those of the things, stay for the next."""
    library, handles, things = tables.library, contact.handles[lane], len(tables.things)
    space, body = handles[SPACE], handles[BODY]
    if space == 0:
        return
    for shape in range(ROBOT, len(handles)):
        if handles[shape] != 0:
            call(library[SPACE_REMOVE_SHAPE], space, handles[shape])
            if shape < FIRST_HELD + things:
                call(library[SHAPE_BODY], handles[shape], 0)
            else:
                call(library[SHAPE_FREE], handles[shape])
                handles[shape] = 0
    remove_loose(tables, space, contact, lane)
    call(library[SPACE_REMOVE_BODY], space, body)
    call(library[BODY_FREE], body)
    call(library[SPACE_FREE], space)
    handles[SPACE], handles[BODY] = 0, 0


@compiled
def push_body(tables, world, contact, share, lane):
    """A lane's state, a share of its force and torque into its body; what the claw holds becomes solid, what it dropped
    does not.
    """
    library, floats, batch, handles = tables.library, contact.floats[lane], contact.batch[lane], contact.handles[lane]
    for i in range(MOTION_FLOATS):
        floats[i] = world.body[i, lane]
    floats[FLOAT_FORCE_X], floats[FLOAT_FORCE_Y] = world.push[FORCE_X, lane] * share, world.push[FORCE_Y, lane] * share
    floats[FLOAT_TORQUE] = world.push[TORQUE, lane] * share
    batch[ARRAY_NUMBERS] = EMPTY_ARRAY
    call(library[BODY_SET], handles[BODY], batch[SET_BATCH:].ctypes.data)
    for i in range(len(tables.things)):
        circle, is_held = handles[FIRST_HELD + i], world.held[lane] == i
        if circle != 0:
            call(library[SHAPE_SENSOR], circle, 0 if is_held else 1)
            if is_held:
                call(library[CIRCLE_RADIUS], circle, world.things[THING_ROWS * i + SIZE, lane] / 2)
    push_loose(tables, world, contact, lane)


@compiled
def step_space(tables, world, contact, seconds, lane):
    """Step a lane's Space by some seconds, take the state of its bodies back, and count what its robot runs into."""
    library, batch, handles = tables.library, contact.batch[lane], contact.handles[lane]
    call(library[SPACE_STEP], handles[SPACE], seconds)
    batch[ARRAY_NUMBERS] = EMPTY_ARRAY
    call(library[BODY_GET], handles[BODY], batch[GET_BATCH:].ctypes.data)
    for i in range(MOTION_FLOATS):
        world.body[i, lane] = contact.floats[lane, i]
    take_loose(tables, world, contact, lane)
    tally = contact.tally[lane]
    tally[TALLIED] = 0
    call(library[EACH_ARBITER], handles[BODY], library[COUNT], tally.ctypes.data)
    return tally[TALLIED]
