"""Chipmunk's solver: sequential impulses part what overlaps, and take the speed at which things run into each other.

It goes through the contacts in the order in which they were found, and changes the velocities of both solids at once.
"""

import math

from mindrun.numbers.arithmetic import F

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
        push(own, own.velocity, c.x, c.y, -jx, -jy)
        push(other, other.velocity, c.its_x, c.its_y, jx, jy)


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
        push(own, own.bias, c.x, c.y, -jx, -jy)
        push(other, other.bias, c.its_x, c.its_y, jx, jy)
        jx, jy = nx * along - ny * across, nx * across + ny * along
        push(own, own.velocity, c.x, c.y, -jx, -jy)
        push(other, other.velocity, c.its_x, c.its_y, jx, jy)
    return acting


def velocity_at(motion, x, y):
    """The velocity of a place of a solid that has a motion."""
    return motion.x + -y * motion.spin, motion.y + x * motion.spin


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
