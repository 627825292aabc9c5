"""Physics of contacts by Chipmunk: a Space for each lane in which something could touch, and the ticks that it makes.

The robot's body with its shapes, the loose things, and the boxes and walls of one lane, live in a Space of the lane's
own, opened when something could touch for the first time. `chipmunk_internals` has the library's functions.

A tick is one step, or several strides where something in the lane is swift. In all of them everything moves on with the
speeds that the tick has begun with, until it meets something; the force of the tick acts at its end.
"""

import numpy as np

from mindrun.numbers.arithmetic import (
    ANGLE,
    BOX_COLUMNS,
    LOOSE_ROWS,
    PUSHED_SPIN,
    PUSHED_X,
    PUSHED_Y,
    SPEED_X,
    SPEED_Y,
    SPIN,
    TURN,
    X,
    Y,
    place_of,
    put_thing,
    size_of,
)
from mindrun.sim import chipmunk_internals as cp
from mindrun.sim.chipmunk_internals import count_address
from mindrun.sim.codes import FORCE_X, FORCE_Y, TORQUE
from mindrun.sim.lanes.disc import SOLVER_ITERATIONS, sides_of, step_disc
from mindrun.sim.lanes.loose import OF_LOOSE, SETTLED_TICKS, is_at_rest, put_motion
from mindrun.sim.lanes.placement import ENDLESS_UNITS
from mindrun.sim.lanes.solid import MOST_STRIDES, hold_back, note_before, note_begin, stride, within
from mindrun.sim.state import SECONDS, ContactState, WorldState
from mindrun.sim.tables import Tables
from mindrun.sim.units import call, unit, unit_where

HASH_COUNT = 20
GONE_UNITS, APART_UNITS = 1e8, 1e4  # where a Space keeps what is gone, each far from the others


@unit
def make_tick(tables: Tables, world: WorldState, contact: ContactState, lane: int) -> int:
    """Make one tick of a lane in its Space; return how often its robot has run into what never moves."""
    dt, is_swift, touching = tables.world[0].dt, contact.swift[lane] > 0, 0
    contact.swift[lane] = 0
    left = dt
    note_begin(tables, world, contact.ways[lane], lane)
    for number in range(MOST_STRIDES):
        most = stride(tables, world, lane) if is_swift else dt
        is_last = most >= left or number == MOST_STRIDES - 1
        seconds = min(most, left) if is_last else min(most, left / 2)
        if is_swift and not glides(world.body, seconds, lane):
            break
        note_before(tables, world, contact.ways[lane], lane)
        share = dt / seconds if is_last else 0.0
        if tables.world[0].is_alone:
            if contact.disc[lane, SECONDS] == 0.0 or seconds > contact.last[lane]:
                contact.disc[lane] = 0.0  # it would remember impulses, and give more than these
            touched = step_disc(tables, world, contact, seconds, share, lane)
        else:
            touched = step_in_space(tables, world, contact, seconds, share, lane)
        touching += touched
        could_pass = touching > 0 or len(tables.loose) > 0
        if could_pass:
            hold_back(tables, world, contact.ways[lane], lane)
        contact.last[lane] = seconds if could_pass else np.inf
        left -= seconds
        if is_last:
            break
    return touching


@unit_where(lambda tables: not tables.world[0]["is_alone"])
def step_in_space(
    tables: Tables, world: WorldState, contact: ContactState, seconds: float, share: float, lane: int
) -> int:
    """Make a step of a lane in its Space, which is opened; return how often its robot has run into what never moves."""
    if contact.handles[lane, cp.SPACE] != 0 and seconds > contact.last[lane]:
        close_space(tables, contact, lane)  # which remembers impulses, and would give more than these
    if contact.handles[lane, cp.SPACE] == 0:
        open_space(tables, world, contact, lane)
    push_body(tables, world, contact, share, lane)
    touched: int = step_space(tables, world, contact, seconds, lane)
    return touched


def glides(body, seconds, lane):
    """True if a robot stays where worlds are; else it is moved on without Chipmunk, and its run ends."""
    x, y = body[X, lane] + body[SPEED_X, lane] * seconds, body[Y, lane] + body[SPEED_Y, lane] * seconds
    angle = body[ANGLE, lane] + body[SPIN, lane] * seconds
    if within(x, y, angle):
        return True
    body[X, lane], body[Y, lane], body[ANGLE, lane] = x, y, angle
    return False


def open_space(tables, world, contact, lane):
    """Open a Space with a lane's obstacles, walls, robot with the circles that it can hold, and loose things."""
    library, constants, handles = tables.library, tables.world[0], contact.handles[lane]
    space = call(library[cp.SPACE_NEW])
    call(library[cp.SPACE_ITERATIONS], space, SOLVER_ITERATIONS)
    call(library[cp.SPACE_SLOP], space, constants.slop)
    call(library[cp.SPACE_HASH], space, constants.cell, HASH_COUNT)
    add_boxes(tables, world, space, handles, contact.floats[lane], lane)
    mass, moment = world.numbers[constants.mass, lane], world.numbers[constants.moment, lane]
    body = call(library[cp.BODY_NEW], mass, moment)
    call(library[cp.SPACE_ADD_BODY], space, body)
    for circle in range(cp.ROBOT, cp.FIRST_HELD + len(tables.things)):
        if handles[circle] != 0:
            call(library[cp.SHAPE_BODY], handles[circle], body)
            call(library[cp.SPACE_ADD_SHAPE], space, handles[circle])
    call(library[cp.SHAPE_FRICTION], handles[cp.ROBOT], world.numbers[constants.friction, lane])
    handles[cp.SPACE], handles[cp.BODY] = space, body
    contact.tally[lane, cp.FIXED_BODY] = call(library[cp.SPACE_STATIC], space)
    contact.last[lane] = np.inf
    if len(tables.loose) > 0:
        add_loose(tables, world, space, contact, lane)


def add_boxes(tables, world, space, handles, corners, lane):
    """Add the obstacles of a lane and the walls of an arena; their shapes go to `handles`, after the things'."""
    library, constants = tables.library, tables.world[0]
    static = call(library[cp.SPACE_STATIC], space)
    count, shape = world.boxes.shape[1] // BOX_COLUMNS, cp.FIRST_HELD + len(tables.things)
    for b in range(count + (cp.WALL_COUNT if constants.half_x < ENDLESS_UNITS else 0)):
        left, low, right, top = sides_of(tables, world, b, lane)
        handles[shape + b] = add_box(library, space, static, corners, left, low, right, top)


def add_box(library, space, static, corners, left, low, right, high):
    """Add a solid rectangle that never moves; return its shape. `corners` is room for eight floats."""
    put_corners(corners, left, low, right, high)
    shape = call(library[cp.POLY_NEW], static, 4, corners.ctypes.data, 0.0)
    call(library[cp.SHAPE_FRICTION], shape, 1.0)
    call(library[cp.SPACE_ADD_SHAPE], space, shape)
    return shape


@unit
def close_space(tables: Tables, contact: ContactState, lane: int) -> None:
    """Free a lane's Space; its circles, the robot's and those of the things, stay for the next."""
    library, handles, things = tables.library, contact.handles[lane], len(tables.things)
    space, body = handles[cp.SPACE], handles[cp.BODY]
    if space == 0:
        return
    for shape in range(cp.ROBOT, len(handles)):
        if handles[shape] != 0:
            call(library[cp.SPACE_REMOVE_SHAPE], space, handles[shape])
            if shape < cp.FIRST_HELD + things:
                call(library[cp.SHAPE_BODY], handles[shape], 0)
            else:
                call(library[cp.SHAPE_FREE], handles[shape])
                handles[shape] = 0
    for i in range(len(tables.loose)):
        loose = contact.loose[lane, cp.LOOSE_HANDLES * i : cp.LOOSE_HANDLES * (i + 1)]
        call(library[cp.SPACE_REMOVE_SHAPE], space, loose[cp.LOOSE_SHAPE])
        call(library[cp.SHAPE_FREE], loose[cp.LOOSE_SHAPE])
        call(library[cp.SPACE_REMOVE_BODY], space, loose[cp.LOOSE_BODY])
        call(library[cp.BODY_FREE], loose[cp.LOOSE_BODY])
    call(library[cp.SPACE_REMOVE_BODY], space, body)
    call(library[cp.BODY_FREE], body)
    call(library[cp.SPACE_FREE], space)
    handles[cp.SPACE], handles[cp.BODY] = 0, 0


def push_body(tables, world, contact, share, lane):
    """Write a lane's state, and a share of its force and torque, into its body; what the claw holds becomes solid, what
    it dropped does not.
    """
    library, floats, batch, handles = tables.library, contact.floats[lane], contact.batch[lane], contact.handles[lane]
    for i in range(cp.MOTION_FLOATS):
        floats[i] = world.body[i, lane]
    floats[cp.FLOAT_FORCE_X] = world.push[FORCE_X, lane] * share
    floats[cp.FLOAT_FORCE_Y] = world.push[FORCE_Y, lane] * share
    floats[cp.FLOAT_TORQUE] = world.push[TORQUE, lane] * share
    batch[cp.ARRAY_NUMBERS] = cp.EMPTY_ARRAY
    call(library[cp.BODY_SET], handles[cp.BODY], batch[cp.SET_BATCH :].ctypes.data)
    for i in range(len(tables.things)):
        circle, is_held = handles[cp.FIRST_HELD + i], world.held[lane] == i
        if circle != 0:
            call(library[cp.SHAPE_SENSOR], circle, 0 if is_held else 1)
            if is_held:
                call(library[cp.CIRCLE_RADIUS], circle, size_of(world.things, i, lane) / 2)
    if len(tables.loose) > 0:
        push_loose(tables, world, contact, lane)


def step_space(tables, world, contact, seconds, lane):
    """Step a lane's Space by some seconds, take the state of its bodies back, and count what its robot runs into."""
    library, batch, handles = tables.library, contact.batch[lane], contact.handles[lane]
    call(library[cp.SPACE_STEP], handles[cp.SPACE], seconds)
    batch[cp.ARRAY_NUMBERS] = cp.EMPTY_ARRAY
    call(library[cp.BODY_GET], handles[cp.BODY], batch[cp.GET_BATCH :].ctypes.data)
    for i in range(cp.MOTION_FLOATS):
        world.body[i, lane] = contact.floats[lane, i]
    if len(tables.loose) > 0:
        take_loose(tables, world, contact, lane)
    tally = contact.tally[lane]
    tally[cp.TALLIED] = 0
    call(library[cp.EACH_ARBITER], handles[cp.BODY], count_address(), tally.ctypes.data)
    return tally[cp.TALLIED]


@OF_LOOSE
def add_loose(tables: Tables, world: WorldState, space: int, contact: ContactState, lane: int) -> None:
    """Add the loose things to a new Space, after its robot; `push_loose` gives them their sizes."""
    library, handles, corners = tables.library, contact.loose[lane], contact.floats[lane]
    for i in range(len(tables.loose)):
        body = call(library[cp.BODY_NEW], 1.0, 1.0)
        call(library[cp.SPACE_ADD_BODY], space, body)
        if tables.loose[i].is_round:
            shape = call(library[cp.CIRCLE_NEW], body, 1.0, 0.0, 0.0)
        else:
            put_corners(corners, -1.0, -1.0, 1.0, 1.0)
            shape = call(library[cp.POLY_NEW], body, 4, corners.ctypes.data, 0.0)
        call(library[cp.SHAPE_FRICTION], shape, world.numbers[tables.loose[i].friction, lane])
        call(library[cp.SPACE_ADD_SHAPE], space, shape)
        handles[cp.LOOSE_HANDLES * i + cp.LOOSE_BODY], handles[cp.LOOSE_HANDLES * i + cp.LOOSE_SHAPE] = body, shape
        contact.sizes[lane, i], contact.placed[lane, i] = 0.0, 0


def put_corners(corners, left, low, right, high):
    """Write the corners of a rectangle into room for eight floats."""
    corners[0], corners[1], corners[2], corners[3] = left, low, right, low
    corners[4], corners[5], corners[6], corners[7] = right, high, left, high


@OF_LOOSE
def push_loose(tables: Tables, world: WorldState, contact: ContactState, lane: int) -> None:
    """Write the place and the motion of each loose thing of a lane into its body."""
    library, floats, batch, handles = tables.library, contact.floats[lane], contact.batch[lane], contact.loose[lane]
    for i in range(len(tables.loose)):
        if world.still[i, lane] >= SETTLED_TICKS:
            if contact.placed[lane, i] == 1:
                continue  # its body knows
            contact.placed[lane, i] = 1
        row, size = LOOSE_ROWS * i, size_of(world.things, tables.loose[i].thing, lane)
        x, y = place_of(world.things, tables.loose[i].thing, lane)
        if contact.sizes[lane, i] != size:
            resize(tables, world, contact, i, size, lane)
        is_gone = np.isnan(x)
        floats[X], floats[Y] = GONE_UNITS + APART_UNITS * i if is_gone else x, GONE_UNITS if is_gone else y
        floats[ANGLE], floats[SPIN] = world.loose[row + TURN, lane], world.loose[row + PUSHED_SPIN, lane]
        floats[SPEED_X], floats[SPEED_Y] = world.loose[row + PUSHED_X, lane], world.loose[row + PUSHED_Y, lane]
        floats[cp.FLOAT_FORCE_X], floats[cp.FLOAT_FORCE_Y], floats[cp.FLOAT_TORQUE] = 0.0, 0.0, 0.0
        batch[cp.ARRAY_NUMBERS] = cp.EMPTY_ARRAY
        call(library[cp.BODY_SET], handles[cp.LOOSE_HANDLES * i + cp.LOOSE_BODY], batch[cp.SET_BATCH :].ctypes.data)


def resize(tables, world, contact, i, size, lane):
    """Give loose thing i another size, and with it another mass and moment of inertia."""
    library, handles, half = tables.library, contact.loose[lane], size / 2
    body, shape = handles[cp.LOOSE_HANDLES * i + cp.LOOSE_BODY], handles[cp.LOOSE_HANDLES * i + cp.LOOSE_SHAPE]
    density = world.numbers[tables.loose[i].density, lane]
    if tables.loose[i].is_round:
        call(library[cp.CIRCLE_RADIUS], shape, half)
        mass = density * np.pi * (half * half)
        moment = mass * (half * half) / 2.0
    else:
        put_corners(contact.floats[lane], -half, -half, half, half)
        call(library[cp.POLY_CORNERS], shape, 4, contact.floats[lane].ctypes.data)
        mass = density * (size * size)
        moment = mass * (size * size + size * size) / 12.0
    call(library[cp.BODY_MASS], body, mass)
    call(library[cp.BODY_MOMENT], body, moment)
    contact.sizes[lane, i] = size


@OF_LOOSE
def take_loose(tables: Tables, world: WorldState, contact: ContactState, lane: int) -> None:
    """Read the places and motions of the loose things after a step; what has moved has not settled."""
    library, floats, batch, handles = tables.library, contact.floats[lane], contact.batch[lane], contact.loose[lane]
    for i in range(len(tables.loose)):
        row, thing = LOOSE_ROWS * i, tables.loose[i].thing
        stood_x, stood_y = place_of(world.things, thing, lane)
        if np.isnan(stood_x):
            continue
        batch[cp.ARRAY_NUMBERS] = cp.EMPTY_ARRAY
        call(library[cp.BODY_GET], handles[cp.LOOSE_HANDLES * i + cp.LOOSE_BODY], batch[cp.GET_BATCH :].ctypes.data)
        x, y, angle, vx, vy, spin = floats[X], floats[Y], floats[ANGLE], floats[SPEED_X], floats[SPEED_Y], floats[SPIN]
        rests = is_at_rest(vx, vy, spin)
        if not (rests and stood_x == x and stood_y == y and world.loose[row + TURN, lane] == angle):
            world.still[i, lane], world.restless[lane] = 0, 1
        if world.still[i, lane] < SETTLED_TICKS or vx != 0.0 or vy != 0.0 or spin != 0.0:
            contact.placed[lane, i] = 0
        put_thing(world.things, thing, x, y, lane)
        world.loose[row + TURN, lane] = angle
        put_motion(world.loose, row, vx, vy, spin, rests, lane)
