"""Loose things in the Space of their lane, where Chipmunk steps them with the robot."""

import numpy as np

from mindrun.numbers.arithmetic import LOOSE_ROWS, PUSHED_SPIN, PUSHED_X, PUSHED_Y, SIZE, THING_ROWS, TURN, X, Y
from mindrun.sim.chipmunk_internals import (
    ARRAY_NUMBERS,
    BODY_FREE,
    BODY_GET,
    BODY_MASS,
    BODY_MOMENT,
    BODY_NEW,
    BODY_SET,
    CIRCLE_NEW,
    CIRCLE_RADIUS,
    EMPTY_ARRAY,
    FLOAT_FORCE_X,
    FLOAT_FORCE_Y,
    FLOAT_TORQUE,
    GET_BATCH,
    LOOSE_BODY,
    LOOSE_HANDLES,
    LOOSE_SHAPE,
    POLY_CORNERS,
    POLY_NEW,
    SET_BATCH,
    SHAPE_FREE,
    SHAPE_FRICTION,
    SPACE_ADD_BODY,
    SPACE_ADD_SHAPE,
    SPACE_REMOVE_BODY,
    SPACE_REMOVE_SHAPE,
    call,
)
from mindrun.sim.compiling import compiled
from mindrun.sim.lanes.loose import SETTLED_TICKS, is_at_rest

GONE_UNITS, APART_UNITS = 1e8, 1e4  # where a Space keeps what is gone, each far from the others
FLOAT_X, FLOAT_Y, FLOAT_ANGLE, FLOAT_SPEED_X, FLOAT_SPEED_Y, FLOAT_SPIN = range(6)


@compiled
def add_loose(tables, world, space, contact, lane):
    """The loose things into a new Space, after its robot; of which size each is, is said when it is put."""
    library, handles, corners = tables.library, contact.loose[lane], contact.floats[lane]
    for i in range(len(tables.loose)):
        body = call(library[BODY_NEW], 1.0, 1.0)
        call(library[SPACE_ADD_BODY], space, body)
        if tables.loose[i].is_round:
            shape = call(library[CIRCLE_NEW], body, 1.0, 0.0, 0.0)
        else:
            put_corners(corners, 1.0)
            shape = call(library[POLY_NEW], body, 4, corners.ctypes.data, 0.0)
        call(library[SHAPE_FRICTION], shape, world.numbers[tables.loose[i].friction, lane])
        call(library[SPACE_ADD_SHAPE], space, shape)
        handles[LOOSE_HANDLES * i + LOOSE_BODY], handles[LOOSE_HANDLES * i + LOOSE_SHAPE] = body, shape
        contact.sizes[lane, i], contact.placed[lane, i] = 0.0, 0


@compiled
def put_corners(corners, half):
    """The corners of a square about its middle, into room for eight floats."""
    corners[0], corners[1], corners[2], corners[3] = -half, -half, half, -half
    corners[4], corners[5], corners[6], corners[7] = half, half, -half, half


@compiled
def remove_loose(tables, space, contact, lane):
    """The loose things out of a Space that is given up."""
    library, handles = tables.library, contact.loose[lane]
    for i in range(len(tables.loose)):
        body, shape = handles[LOOSE_HANDLES * i + LOOSE_BODY], handles[LOOSE_HANDLES * i + LOOSE_SHAPE]
        call(library[SPACE_REMOVE_SHAPE], space, shape)
        call(library[SHAPE_FREE], shape)
        call(library[SPACE_REMOVE_BODY], space, body)
        call(library[BODY_FREE], body)


@compiled
def push_loose(tables, world, contact, lane):
    """Where each loose thing of a lane is and how it moves, into its body."""
    library, floats, batch, handles = tables.library, contact.floats[lane], contact.batch[lane], contact.loose[lane]
    for i in range(len(tables.loose)):
        if world.still[i, lane] >= SETTLED_TICKS:
            if contact.placed[lane, i] == 1:
                continue  # its body knows
            contact.placed[lane, i] = 1
        row, place = LOOSE_ROWS * i, THING_ROWS * tables.loose[i].thing
        size, is_gone = world.things[place + SIZE, lane], np.isnan(world.things[place + X, lane])
        if contact.sizes[lane, i] != size:
            resize(tables, world, contact, i, size, lane)
        floats[FLOAT_X] = GONE_UNITS + APART_UNITS * i if is_gone else world.things[place + X, lane]
        floats[FLOAT_Y] = GONE_UNITS if is_gone else world.things[place + Y, lane]
        floats[FLOAT_ANGLE] = world.loose[row + TURN, lane]
        floats[FLOAT_SPEED_X] = world.loose[row + PUSHED_X, lane]
        floats[FLOAT_SPEED_Y] = world.loose[row + PUSHED_Y, lane]
        floats[FLOAT_SPIN] = world.loose[row + PUSHED_SPIN, lane]
        floats[FLOAT_FORCE_X], floats[FLOAT_FORCE_Y], floats[FLOAT_TORQUE] = 0.0, 0.0, 0.0
        batch[ARRAY_NUMBERS] = EMPTY_ARRAY
        call(library[BODY_SET], handles[LOOSE_HANDLES * i + LOOSE_BODY], batch[SET_BATCH:].ctypes.data)


@compiled
def resize(tables, world, contact, i, size, lane):
    """Loose thing i has another size, and with it another mass and moment of inertia."""
    library, handles, half = tables.library, contact.loose[lane], size / 2
    body, shape = handles[LOOSE_HANDLES * i + LOOSE_BODY], handles[LOOSE_HANDLES * i + LOOSE_SHAPE]
    density = world.numbers[tables.loose[i].density, lane]
    if tables.loose[i].is_round:
        call(library[CIRCLE_RADIUS], shape, half)
        mass = density * np.pi * (half * half)
        moment = mass * (half * half) / 2.0
    else:
        put_corners(contact.floats[lane], half)
        call(library[POLY_CORNERS], shape, 4, contact.floats[lane].ctypes.data)
        mass = density * (size * size)
        moment = mass * (size * size + size * size) / 12.0
    call(library[BODY_MASS], body, mass)
    call(library[BODY_MOMENT], body, moment)
    contact.sizes[lane, i] = size


@compiled
def take_loose(tables, world, contact, lane):
    """Where the loose things are after a step; what has moved has not settled."""
    library, floats, batch, handles = tables.library, contact.floats[lane], contact.batch[lane], contact.loose[lane]
    for i in range(len(tables.loose)):
        row, place = LOOSE_ROWS * i, THING_ROWS * tables.loose[i].thing
        if np.isnan(world.things[place + X, lane]):
            continue
        batch[ARRAY_NUMBERS] = EMPTY_ARRAY
        call(library[BODY_GET], handles[LOOSE_HANDLES * i + LOOSE_BODY], batch[GET_BATCH:].ctypes.data)
        x, y, angle = floats[FLOAT_X], floats[FLOAT_Y], floats[FLOAT_ANGLE]
        vx, vy, spin = floats[FLOAT_SPEED_X], floats[FLOAT_SPEED_Y], floats[FLOAT_SPIN]
        stood = world.things[place + X, lane] == x and world.things[place + Y, lane] == y
        rests = is_at_rest(vx, vy, spin)
        if not (rests and stood and world.loose[row + TURN, lane] == angle):
            world.still[i, lane], world.restless[lane] = 0, 1
        if world.still[i, lane] < SETTLED_TICKS or vx != 0.0 or vy != 0.0 or spin != 0.0:
            contact.placed[lane, i] = 0
        world.things[place + X, lane], world.things[place + Y, lane] = x, y
        world.loose[row + TURN, lane] = angle
        world.loose[row + PUSHED_X, lane], world.loose[row + PUSHED_Y, lane] = (
            0.0 if rests else vx,
            0.0 if rests else vy,
        )
        world.loose[row + PUSHED_SPIN, lane] = 0.0 if rests else spin
