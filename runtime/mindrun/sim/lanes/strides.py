"""Ticks in which something could touch: one step, or several strides where something in the lane is swift.

In all of them everything moves on with the speeds that the tick has begun with, until it meets something; the force of
the tick acts at its end. A step is what `cpSpaceStep` of Chipmunk would make of the lane, operation by operation, so
the bits are Chipmunk's (`tests/sim`); no library is asked.
"""

import numpy as np

from mindrun.numbers.arithmetic import ANGLE, SPEED_X, SPEED_Y, SPIN, X, Y
from mindrun.sim.c_library import POWER
from mindrun.sim.codes import Tables
from mindrun.sim.lanes.impulses import COLLISION_BIAS, solve
from mindrun.sim.lanes.meeting import forget_old, let_go, touch_fixed, touch_movers
from mindrun.sim.lanes.solid import MOST_STRIDES, hold_back, note_before, note_begin, stride, within
from mindrun.sim.lanes.solids import gather, move_loose, move_robot, open_space, take_loose, take_robot
from mindrun.sim.state import ROBOT, ContactState, WorldState
from mindrun.sim.units import call_double, unit


@unit
def make_tick(tables: Tables, world: WorldState, contact: ContactState, lane: int) -> int:
    """Make one tick of a lane; return how often its robot has run into what never moves."""
    dt, is_swift, touching = tables.world[0].dt, contact.swift[lane] > 0, 0
    contact.swift[lane] = 0
    left = dt
    note_begin(tables, world, contact.solids[lane], lane)
    for number in range(MOST_STRIDES):
        most = stride(tables, world, lane) if is_swift else dt
        is_last = most >= left or number == MOST_STRIDES - 1
        seconds = min(most, left) if is_last else min(most, left / 2)
        if is_swift and not glides(world.body, seconds, lane):
            break
        note_before(tables, world, contact.solids[lane], lane)
        touching += make_step(tables, world, contact, seconds, dt / seconds if is_last else 0.0, lane)
        could_pass = touching > 0 or len(tables.loose) > 0
        if could_pass:
            hold_back(tables, world, contact.solids[lane], lane)
        contact.last[lane] = seconds if could_pass else np.inf
        left -= seconds
        if is_last:
            break
    return touching


def glides(body, seconds, lane):
    """True if a robot stays where worlds are; else it is moved on without contacts, and its run ends."""
    x, y = body[X, lane] + body[SPEED_X, lane] * seconds, body[Y, lane] + body[SPEED_Y, lane] * seconds
    angle = body[ANGLE, lane] + body[SPIN, lane] * seconds
    if within(x, y, angle):
        return True
    body[X, lane], body[Y, lane], body[ANGLE, lane] = x, y, angle
    return False


def make_step(tables, world, contact, seconds, share, lane):
    """Move a lane on by some seconds with a share of its force; return how often its robot touches what never moves."""
    space = contact.space[lane]
    if space.seconds == 0.0 or seconds > contact.last[lane]:
        open_space(tables, world, contact, lane)  # what is remembered are impulses, of which more would act
    space.steps += 1
    space.run_into, space.in_claw = 0, world.held[lane]
    forget_old(space, contact.pairs[lane], contact.order[lane])
    move_robot(tables, world, contact, seconds, share, lane)
    if len(tables.loose) > 0:
        move_loose(tables, world, contact, seconds, lane)
    gather(tables, world, contact, lane)
    if len(tables.loose) > 0:
        touch_movers(tables, world, contact, lane)
    touch_fixed(tables, world, contact, lane)
    let_go(tables, world, contact, lane)
    if seconds != space.seconds:
        space.take_back = 1.0 - call_double(tables.library[POWER], COLLISION_BIAS, seconds)
    if space.touching > 0:
        solve(contact, tables.world[0].slop, seconds, lane)
    take_robot(world, contact.solids[lane, ROBOT], lane)
    if len(tables.loose) > 0:
        take_loose(tables, world, contact, lane)
    space.seconds = seconds
    return space.run_into
