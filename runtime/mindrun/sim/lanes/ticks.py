"""Ticks of the lanes that Chipmunk steps: at one stride, or at several where something in the lane is swift.

In all of them everything moves on with the speeds that the tick has begun with, until it meets something; the force of
the tick acts at its end, as it does where a tick is one stride.
"""

import numpy as np

from mindrun.numbers.arithmetic import ANGLE, SPEED_X, SPEED_Y, SPIN, X, Y
from mindrun.sim.chipmunk_internals import SPACE
from mindrun.sim.compiling import compiled
from mindrun.sim.lanes.chipmunk import close_space, open_space, push_body, step_space
from mindrun.sim.lanes.hold_back import hold_back, note_before, note_begin
from mindrun.sim.lanes.places import within
from mindrun.sim.lanes.strides import stride
from mindrun.sim.strides import MOST_STRIDES


@compiled
def make_tick(tables, world, contact, lane):
    """One tick of a lane in its Space; how often its robot has run into what never moves."""
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
        if contact.handles[lane, SPACE] != 0 and seconds > contact.last[lane]:
            close_space(tables, contact, lane)  # which remembers impulses, and would give more than these
        if contact.handles[lane, SPACE] == 0:
            open_space(tables, world, contact, lane)
        note_before(tables, world, contact.ways[lane], lane)
        push_body(tables, world, contact, dt / seconds if is_last else 0.0, lane)
        touched = step_space(tables, world, contact, seconds, lane)
        touching += touched
        could_pass = touching > 0 or len(tables.loose) > 0
        if could_pass:
            hold_back(tables, world, contact.ways[lane], lane)
        contact.last[lane] = seconds if could_pass else np.inf
        left -= seconds
        if is_last:
            break
    return touching


@compiled
def glides(body, seconds, lane):
    """Whether a robot stays where worlds are; one that does not goes there by itself, and its run ends."""
    x, y = body[X, lane] + body[SPEED_X, lane] * seconds, body[Y, lane] + body[SPEED_Y, lane] * seconds
    angle = body[ANGLE, lane] + body[SPIN, lane] * seconds
    if within(x, y, angle):
        return True
    body[X, lane], body[Y, lane], body[ANGLE, lane] = x, y, angle
    return False
