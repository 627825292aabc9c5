"""Ticks in which something could touch: one step, or several strides where something in the lane is swift.

In all of them everything moves on with the speeds that the tick has begun with, until it meets something; the force of
the tick acts at its end. A step is what `cpSpaceStep` of Chipmunk would make of the lane, operation by operation, so
the bits are Chipmunk's (`tests/sim`); no library is asked. Its solver goes through the contacts in the order in which
they were found: sequential impulses part what overlaps, and take the speed at which things run into each other.
"""

import math

import numpy as np

from mindrun.numbers.arithmetic import *
from mindrun.sim.c_library import POWER
from mindrun.sim.codes import Tables
from mindrun.sim.lanes.meeting import forget_old, let_go, touch_fixed, touch_movers
from mindrun.sim.lanes.solid import MOST_STRIDES, hold_back, note_before, note_begin, own_solid, stride, within
from mindrun.sim.lanes.solids import gather, move_loose, move_robot, open_space, take_loose, take_robot
from mindrun.sim.state import ContactState, WorldState
from mindrun.sim.units import call_double, unit

SOLVER_ITERATIONS = 8
COLLISION_BIAS = math.pow(float(F(1) - F(0.1)), 60.0)  # what is left of an overlap after a second


def solve(contact, slop, seconds, lane):
    """Let the pairs that touch act on each other, as long as any does."""
    space, solids, pairs, order = contact.space[lane], contact.solids[lane], contact.pairs[lane], contact.order[lane]
    count, before = space.touching, seconds / space.seconds  # in the first step all pairs are new, and nobody asks
    for i in range(count):
        prepare(solids, pairs[order[i]], slop, space.take_back, seconds)
    for i in range(count):
        if not pairs[order[i]].is_first:
            push_again(solids, pairs[order[i]], before)
    for _ in range(SOLVER_ITERATIONS):
        acting = 0
        for i in range(count):
            acting += act(solids, pairs[order[i]])
        if acting == 0:  # nor is anything in any further round
            break


def prepare(solids, pair, slop, take_back, seconds):
    """Compute how heavy both are at each contact, along the normal and across, and how fast to part what overlaps."""
    own, other, nx, ny = solids[pair.own], solids[pair.other], pair.normal_x, pair.normal_y
    apart_x, apart_y = other.middle_x - own.middle_x, other.middle_y - own.middle_y
    for k in range(pair.count):
        c = pair.contacts[k]
        c.mass_along = 1.0 / (ease(own, c.x * ny - c.y * nx) + ease(other, c.its_x * ny - c.its_y * nx))
        c.mass_across = 1.0 / (ease(own, c.x * nx - c.y * -ny) + ease(other, c.its_x * nx - c.its_y * -ny))
        depth = (((c.its_x - c.x) + apart_x) * nx + ((c.its_y - c.y) + apart_y) * ny) + slop
        c.bias = -take_back * (0.0 if depth > 0.0 else depth) / seconds
        c.parting = 0.0


def ease(solid, arm):
    """How much an impulse moves a solid, at an arm."""
    return solid.mass_inv + solid.moment_inv * arm * arm


def push_again(solids, pair, before):
    """Begin with a share of the impulses of the last step."""
    own, other, nx, ny = solids[pair.own], solids[pair.other], pair.normal_x, pair.normal_y
    for k in range(pair.count):
        c = pair.contacts[k]
        jx, jy = (nx * c.along - ny * c.across) * before, (nx * c.across + ny * c.along) * before
        push_apart(own, own.velocity, other, other.velocity, c, jx, jy)


def act(solids, pair):
    """Give both solids of a pair the impulses that are still wanted at each contact; return at how many any is."""
    own, other, nx, ny, acting = solids[pair.own], solids[pair.other], pair.normal_x, pair.normal_y, 0
    for k in range(pair.count):
        c = pair.contacts[k]
        x, y = velocity_at(own.bias, c.x, c.y)
        its_x, its_y = velocity_at(other.bias, c.its_x, c.its_y)
        more = part(c, (its_x - x) * nx + (its_y - y) * ny)
        x, y = velocity_at(own.velocity, c.x, c.y)
        its_x, its_y = velocity_at(other.velocity, c.its_x, c.its_y)
        x, y = (its_x - x) + 0.0, (its_y - y) + 0.0
        along, across = bounce(c, pair.friction, x * nx + y * ny, x * -ny + y * nx)
        acting += more != 0.0 or along != 0.0 or across != 0.0
        jx, jy = nx * more, ny * more
        push_apart(own, own.bias, other, other.bias, c, jx, jy)
        jx, jy = nx * along - ny * across, nx * across + ny * along
        push_apart(own, own.velocity, other, other.velocity, c, jx, jy)
    return acting


def velocity_at(motion, x, y):
    """The velocity of a place of a solid that has a motion."""
    return motion.x + -y * motion.spin, motion.y + x * motion.spin


def push_apart(own, motion, other, its_motion, c, jx, jy):
    """Change a motion of both solids by an impulse at a contact, each the other way."""
    push(own, motion, c.x, c.y, -jx, -jy)
    push(other, its_motion, c.its_x, c.its_y, jx, jy)


def push(solid, motion, x, y, jx, jy):
    """Change a motion of a solid by an impulse at a place, unless nothing moves it."""
    if solid.mass_inv > 0.0:
        motion.x += jx * solid.mass_inv
        motion.y += jy * solid.mass_inv
        motion.spin += solid.moment_inv * (x * jy - y * jx)


def part(contact, speed):
    """The impulse that is still wanted to part what overlaps and parts with that speed."""
    before = contact.parting
    now = before + (contact.bias - speed) * contact.mass_along
    contact.parting = now if now > 0.0 else 0.0
    return contact.parting - before


def bounce(contact, friction, speed_along, speed_across):
    """The impulses that are still wanted along the normal and, by friction, across it."""
    along, across = contact.along, contact.across
    now = along + -speed_along * contact.mass_along
    contact.along = now if now > 0.0 else 0.0
    most = friction * contact.along
    now = across + -speed_across * contact.mass_across
    now = now if now > -most else -most
    contact.across = now if now < most else most
    return contact.along - along, contact.across - across


@unit
def make_tick(tables: Tables, world: WorldState, contact: ContactState, lane: int) -> int:
    """Make one tick of a world, whose first lane is given; return how often its robots run into what never moves."""
    dt, is_swift, touching = tables.world[0].dt, contact.swift[lane] > 0, 0
    contact.swift[lane] = 0
    left = dt
    note_begin(tables, world, contact.solids[lane], lane)
    for number in range(MOST_STRIDES):
        most = stride(tables, world, lane) if is_swift else dt
        is_last = most >= left or number == MOST_STRIDES - 1
        seconds = min(most, left) if is_last else min(most, left / 2)
        if is_swift and not all_glide(world.body, contact.near, len(tables.robots), seconds, lane):
            break
        note_before(tables, world, contact.solids[lane], lane)
        touching += make_step(tables, world, contact, seconds, dt / seconds if is_last else 0.0, lane)
        could_pass = touching > 0 or len(tables.loose) > 0 or len(tables.robots) > 1
        if could_pass:
            hold_back(tables, world, contact.solids[lane], lane)
        contact.last[lane] = seconds if could_pass else np.inf
        left -= seconds
        if is_last:
            break
    return touching


def all_glide(body, near, robots, seconds, home):
    """True if all robots of a world that are in the step stay where worlds are."""
    lost = 0
    for lane in range(home, home + robots):
        lost += 1 if near[lane] > 0 and not glides(body, seconds, lane) else 0
    return lost == 0


def glides(body, seconds, lane):
    """True if a robot stays where worlds are; else it is moved on without contacts, and its run ends."""
    x, y = next_middle(body, seconds, lane)
    angle = body[ANGLE, lane] + body[SPIN, lane] * seconds
    if within(x, y, angle):
        return True
    body[X, lane], body[Y, lane], body[ANGLE, lane] = x, y, angle
    return False


def make_step(tables, world, contact, seconds, share, lane):
    """Move a world on by some seconds with a share of its forces; return how often robots touch what never moves."""
    space, solids, robots = contact.space[lane], contact.solids[lane], len(tables.robots)
    if space.seconds == 0.0 or seconds > contact.last[lane]:
        open_space(tables, world, contact, lane)  # what is remembered are impulses, of which more would act
    space.steps += 1
    for number in range(robots):
        its = contact.space[lane + number]
        its.run_into, its.met, its.in_claw = 0, 0, world.held[lane + number]
    forget_old(space, contact.pairs[lane], contact.order[lane])
    for number in range(robots):  # those that are near to nothing have flown
        a = own_solid(number)
        if contact.near[lane + number] == 0:
            continue
        move_robot(tables, world, solids[a], solids[a + 1], seconds, share, lane + number)
    if len(tables.loose) > 0:
        move_loose(tables, world, contact, seconds, share, lane)
    gather(world, contact, lane)
    if len(tables.loose) > 0 or len(tables.robots) > 1:
        touch_movers(tables, world, contact, lane)
    touch_fixed(tables, world, contact, lane)
    let_go(tables, world, contact, lane)
    if seconds != space.seconds:
        space.take_back = 1.0 - call_double(tables.library[POWER], COLLISION_BIAS, seconds)
    if space.touching > 0:
        solve(contact, tables.world[0].slop, seconds, lane)
    run_into = 0
    for number in range(robots):
        if contact.near[lane + number] > 0:
            take_robot(world, solids[own_solid(number)], lane + number)
        run_into += note_touch(contact, lane + number)
    if len(tables.loose) > 0:
        take_loose(tables, world, contact, lane)
    space.seconds = seconds
    return run_into


def note_touch(contact, lane):
    """Set the bits of what a robot touches in this tick; return how often it is what never moves."""
    space = contact.space[lane]
    contact.touching[lane] |= 1 if space.run_into > 0 else 0
    contact.mates[0, lane] |= space.met
    return space.run_into
