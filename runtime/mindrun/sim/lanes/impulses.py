"""Chipmunk's solver: sequential impulses part what overlaps, and take the speed at which things run into each other.

It goes through the contacts in the order in which they were found, and changes the velocities of both solids at once.
"""

import math

from mindrun.numbers.arithmetic import F
from mindrun.sim.state import (
    ACROSS,
    ALONG,
    AT_X,
    AT_Y,
    AWAY_X,
    CONTACT,
    CONTACT_COLUMNS,
    CONTACTS,
    FIRST,
    FIXED,
    FRICTION,
    ITS_X,
    ITS_Y,
    MASS_ACROSS,
    MASS_ALONG,
    MASS_INV,
    MIDDLE_X,
    MIDDLE_Y,
    MOMENT_INV,
    NORMAL_X,
    NORMAL_Y,
    OTHER,
    OWN,
    PAIR_COLUMNS,
    PARTED,
    PARTING,
    VX,
)

SOLVER_ITERATIONS = 8
NOTHING = FIXED  # the columns of what never moves
COLLISION_BIAS = math.pow(float(F(1) - F(0.1)), 60.0)  # what is left of an overlap after a second


def solve(solids, pairs, count, slop, take_back, seconds, before):
    """Let the pairs that touch act on each other; `before` is how much of their last impulses they begin with."""
    for i in range(count):
        prepare(solids, pairs, PAIR_COLUMNS * i, slop, take_back, seconds)
    for i in range(count):
        pair = PAIR_COLUMNS * i
        if pairs[pair + FIRST] == 0.0:
            push_again(solids, pairs, pair, before)
    for _ in range(SOLVER_ITERATIONS):
        for i in range(count):
            act(solids, pairs, PAIR_COLUMNS * i)


def prepare(solids, pairs, pair, slop, take_back, seconds):
    """Compute how heavy both are at each contact, along the normal and across, and how fast to part what overlaps."""
    a, b, nx, ny = int(pairs[pair + OWN]), int(pairs[pair + OTHER]), pairs[pair + NORMAL_X], pairs[pair + NORMAL_Y]
    apart_x, apart_y = solids[b + MIDDLE_X] - solids[a + MIDDLE_X], solids[b + MIDDLE_Y] - solids[a + MIDDLE_Y]
    for k in range(int(pairs[pair + CONTACTS])):
        c = pair + CONTACT + CONTACT_COLUMNS * k
        ax, ay, bx, by = pairs[c + AT_X], pairs[c + AT_Y], pairs[c + ITS_X], pairs[c + ITS_Y]
        pairs[c + MASS_ALONG] = 1.0 / (ease(solids, a, ax * ny - ay * nx) + ease(solids, b, bx * ny - by * nx))
        pairs[c + MASS_ACROSS] = 1.0 / (ease(solids, a, ax * nx - ay * -ny) + ease(solids, b, bx * nx - by * -ny))
        depth = (((bx - ax) + apart_x) * nx + ((by - ay) + apart_y) * ny) + slop
        pairs[c + PARTING] = -take_back * (0.0 if depth > 0.0 else depth) / seconds
        pairs[c + PARTED] = 0.0


def ease(solids, a, arm):
    """How much an impulse moves a solid, at an arm."""
    return solids[a + MASS_INV] + solids[a + MOMENT_INV] * arm * arm


def push_again(solids, pairs, pair, before):
    """Begin with a share of the impulses of the last step."""
    a, b, nx, ny = int(pairs[pair + OWN]), int(pairs[pair + OTHER]), pairs[pair + NORMAL_X], pairs[pair + NORMAL_Y]
    for k in range(int(pairs[pair + CONTACTS])):
        c = pair + CONTACT + CONTACT_COLUMNS * k
        along, across = pairs[c + ALONG], pairs[c + ACROSS]
        jx, jy = (nx * along - ny * across) * before, (nx * across + ny * along) * before
        push(solids, a, VX, pairs[c + AT_X], pairs[c + AT_Y], -jx, -jy)
        push(solids, b, VX, pairs[c + ITS_X], pairs[c + ITS_Y], jx, jy)


def velocity_at(solids, a, velocity, x, y):
    """The velocity of a solid at a place, by the velocities that begin at a column."""
    if a == NOTHING:
        return 0.0, 0.0
    spin = solids[a + velocity + 2]
    return solids[a + velocity] + -y * spin, solids[a + velocity + 1] + x * spin


def push(solids, a, velocity, x, y, jx, jy):
    """Change the velocities of a solid that begin at a column, by an impulse at a place."""
    if a == NOTHING:
        return
    light = solids[a + MASS_INV]
    solids[a + velocity] += jx * light
    solids[a + velocity + 1] += jy * light
    solids[a + velocity + 2] += solids[a + MOMENT_INV] * (x * jy - y * jx)


def act(solids, pairs, pair):
    """Give both solids of a pair the impulses that are still wanted at each contact."""
    a, b, nx, ny = int(pairs[pair + OWN]), int(pairs[pair + OTHER]), pairs[pair + NORMAL_X], pairs[pair + NORMAL_Y]
    for k in range(int(pairs[pair + CONTACTS])):
        c = pair + CONTACT + CONTACT_COLUMNS * k
        ax, ay, bx, by = pairs[c + AT_X], pairs[c + AT_Y], pairs[c + ITS_X], pairs[c + ITS_Y]
        x, y = velocity_at(solids, a, AWAY_X, ax, ay)
        its_x, its_y = velocity_at(solids, b, AWAY_X, bx, by)
        more = part(pairs, c, (its_x - x) * nx + (its_y - y) * ny)
        x, y = velocity_at(solids, a, VX, ax, ay)
        its_x, its_y = velocity_at(solids, b, VX, bx, by)
        x, y = (its_x - x) + 0.0, (its_y - y) + 0.0
        along, across = bounce(pairs, c, pairs[pair + FRICTION], x * nx + y * ny, x * -ny + y * nx)
        jx, jy = nx * more, ny * more
        push(solids, a, AWAY_X, ax, ay, -jx, -jy)
        push(solids, b, AWAY_X, bx, by, jx, jy)
        jx, jy = nx * along - ny * across, nx * across + ny * along
        push(solids, a, VX, ax, ay, -jx, -jy)
        push(solids, b, VX, bx, by, jx, jy)


def part(pairs, contact, speed):
    """The impulse that is still wanted to part what overlaps and parts with that speed."""
    before = pairs[contact + PARTED]
    now = before + (pairs[contact + PARTING] - speed) * pairs[contact + MASS_ALONG]
    pairs[contact + PARTED] = now if now > 0.0 else 0.0
    return pairs[contact + PARTED] - before


def bounce(pairs, contact, friction, speed_along, speed_across):
    """The impulses that are still wanted along the normal and, by friction, across it."""
    along, across = pairs[contact + ALONG], pairs[contact + ACROSS]
    now = along + -speed_along * pairs[contact + MASS_ALONG]
    pairs[contact + ALONG] = now if now > 0.0 else 0.0
    most = friction * pairs[contact + ALONG]
    now = across + -speed_across * pairs[contact + MASS_ACROSS]
    now = now if now > -most else -most
    pairs[contact + ACROSS] = now if now < most else most
    return pairs[contact + ALONG] - along, pairs[contact + ACROSS] - across
