"""Strides: for how long a lane may go on at once so that nothing in it passes anything.

A lane in which something is so swift that a tick takes it by more than SWIFT_SHARE of its least half side makes its
tick in several strides: in each everything moves by at most STRIDE_SHARE of that, or by what is free around it.
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
    SPIN,
    THING_ROWS,
    X,
    Y,
)
from mindrun.sim.compiling import compiled
from mindrun.sim.lanes.loose import HALF_DIAGONAL, extent_of
from mindrun.sim.strides import STRIDE_SHARE, SWIFT_SHARE


@compiled
def find_swift(tables, world, swift, lanes):
    """In how many lanes something may be swift; which of them have to make strides into `swift`, where any may be.

    Who makes a lane's tick sets it back to 0.
    """
    body, held, constants, count = world.body, world.held, tables.world[0], 0
    own_arm, own_least = 0.0 if constants.is_round else constants.radius, min(constants.front, constants.side)
    arm, least, dt = constants.arm, constants.least, constants.dt
    for lane in range(lanes):
        spin = abs(body[SPIN, lane]) * (own_arm if held[lane] < 0 else arm)
        speed = abs(body[SPEED_X, lane]) + abs(body[SPEED_Y, lane]) + spin
        count += speed * dt > SWIFT_SHARE * (own_least if held[lane] < 0 else least)
    for i in range(len(tables.loose)):
        row, place = LOOSE_ROWS * i, THING_ROWS * tables.loose[i].thing
        of_size = 0.0 if tables.loose[i].is_round else HALF_DIAGONAL
        for lane in range(lanes):
            size = world.things[place + SIZE, lane]
            speed = abs(world.loose[row + PUSHED_X, lane]) + abs(world.loose[row + PUSHED_Y, lane])
            speed += abs(world.loose[row + PUSHED_SPIN, lane]) * (size * of_size)
            count += speed * dt > SWIFT_SHARE * size / 2
    for lane in range(lanes if count > 0 else 0):
        swift[lane] = 1 if stride(tables, world, lane) < dt else 0
    return count


@compiled
def stride(tables, world, lane):
    """For how many seconds a lane may go on at once; infinitely many where nothing in it is swift."""
    body, constants, held = world.body, tables.world[0], world.held[lane]
    half, reach = min(constants.front, constants.side), constants.radius
    arm = 0.0 if constants.is_round else reach
    if held >= 0:
        own, hold = world.things[THING_ROWS * held + SIZE, lane] / 2, tables.things[held].hold
        half, arm, reach = min(half, own), max(arm, hold), max(reach, hold + own)
    x, y, longest = body[X, lane], body[Y, lane], np.inf
    speed = abs(body[SPEED_X, lane]) + abs(body[SPEED_Y, lane]) + abs(body[SPIN, lane]) * arm
    if speed * constants.dt > SWIFT_SHARE * half:
        longest = max(STRIDE_SHARE * half, room_around(tables, world, x, y, reach, -1, lane)) / speed
    for i in range(len(tables.loose)):
        longest = min(longest, stride_of(tables, world, i, x, y, reach, lane))
    return longest


@compiled
def stride_of(tables, world, i, x, y, reach, lane):
    """For how many seconds loose thing i may go on at once beside a robot that reaches so far around its middle."""
    row, place = LOOSE_ROWS * i, THING_ROWS * tables.loose[i].thing
    half, extent = world.things[place + SIZE, lane] / 2, extent_of(tables, world, i, lane)
    speed = abs(world.loose[row + PUSHED_X, lane]) + abs(world.loose[row + PUSHED_Y, lane])
    speed += 0.0 if tables.loose[i].is_round else abs(world.loose[row + PUSHED_SPIN, lane]) * extent
    if not speed * tables.world[0].dt > SWIFT_SHARE * half:
        return np.inf
    its_x, its_y = world.things[place + X, lane], world.things[place + Y, lane]
    room = room_around(tables, world, its_x, its_y, extent, i, lane)
    room = min(room, (max(abs(its_x - x), abs(its_y - y)) - reach - extent) / 2)
    return max(STRIDE_SHARE * half, room) / speed


@compiled
def room_around(tables, world, x, y, extent, but, lane):
    """How far what reaches so far around a point may move in any direction before it meets something.

    Of what is free between it and a loose thing, thing number `but` aside, half is its own.
    """
    boxes, constants = world.boxes, tables.world[0]
    room = min(constants.half_x - abs(x), constants.half_y - abs(y)) - extent
    for b in range(boxes.shape[1] // BOX_COLUMNS):
        box = BOX_COLUMNS * b
        aside = abs(boxes[lane, box + X] - x) - boxes[lane, box + HALF_X]
        room = min(room, max(aside, abs(boxes[lane, box + Y] - y) - boxes[lane, box + HALF_Y]) - extent)
    for j in range(len(tables.loose)):
        place = THING_ROWS * tables.loose[j].thing
        its_x, its_y = world.things[place + X, lane], world.things[place + Y, lane]
        if j != but and not np.isnan(its_x):
            far = max(abs(its_x - x), abs(its_y - y)) - extent_of(tables, world, j, lane)
            room = min(room, (far - extent) / 2)
    return room
