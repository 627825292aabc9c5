"""Contacts of a disc with what never moves, made without Chipmunk, in Chipmunk's own order of operations.

A round robot, and the round item in its claw, meet boxes and walls at one point each. So a lane in which nothing is
loose needs no Space: what `cpSpaceStep` would do is some arithmetic. It is Chipmunk's, operation by operation (GJK and
EPA for the nearest points, then its solver by sequential impulses), so the bits are those of a Space (`tests/sim`).

A **pair** is what is remembered of a disc and a box that touch, or did so a few steps ago. `disc` has what a Space and
its body would keep.
"""

import math

import numpy as np

from mindrun.kinds.bodies.body import FRICTION_COEFFICIENT
from mindrun.numbers.arithmetic import ANGLE, BOX_COLUMNS, SPEED_X, SPEED_Y, SPIN, F, X, Y, box_of, size_of
from mindrun.sim.chipmunk_internals import PERSISTENCE_TICKS, POWER, SINE_COSINE, WALL_COUNT
from mindrun.sim.codes import FORCE_X, FORCE_Y, TORQUE
from mindrun.sim.lanes.nearest_points import nearest_points
from mindrun.sim.lanes.placement import ENDLESS_UNITS
from mindrun.sim.state import (
    ACROSS,
    ALONG,
    AT_X,
    AT_Y,
    BIAS_SPIN,
    BIAS_X,
    BIAS_Y,
    FIRST,
    FRICTION,
    KEY,
    MASS_ACROSS,
    MASS_ALONG,
    MOST_PAIRS,
    NORMAL_X,
    NORMAL_Y,
    PAIR_COLUMNS,
    PAIRS,
    PARTED,
    PARTING,
    RANK,
    REACH,
    SECONDS,
    STEPS,
    TOUCHING,
    USED,
    ContactState,
    WorldState,
)
from mindrun.sim.tables import Tables
from mindrun.sim.units import call, call_double, unit

SOLVER_ITERATIONS = 8
ROBOT_DISC = -1  # in place of a thing
COLLISION_BIAS = math.pow(float(F(1) - F(0.1)), 60.0)  # what is left of an overlap after a second
HALF_WALL_UNITS = 1.0  # half the thickness of a wall, outside the arena
HASH_CELLS = 23  # of Chipmunk's table: the first of its primes from HASH_COUNT on
HASH_X, HASH_Y, HASH_SIZE = np.uint64(1640531513), np.uint64(2654435789), np.uint64(HASH_CELLS)


@unit
def step_disc(tables: Tables, world: WorldState, contact: ContactState, seconds: float, share: float, lane: int) -> int:
    """Move a lane's robot by some seconds with a share of its force; return how many boxes and walls it touches."""
    constants, body, disc, pairs = tables.world[0], world.body, contact.disc[lane], contact.pairs[lane]
    disc[STEPS] += 1.0
    forget_old(disc, pairs)
    body[X, lane] = body[X, lane] + (body[SPEED_X, lane] + disc[BIAS_X]) * seconds
    body[Y, lane] = body[Y, lane] + (body[SPEED_Y, lane] + disc[BIAS_Y]) * seconds
    body[ANGLE, lane] = body[ANGLE, lane] + (body[SPIN, lane] + disc[BIAS_SPIN]) * seconds
    disc[BIAS_X], disc[BIAS_Y], disc[BIAS_SPIN], disc[TOUCHING] = 0.0, 0.0, 0.0, 0.0
    held = world.held[lane]
    is_held_first = held >= 0 and tables.things[held].turn < constants.turn
    if is_held_first:
        touch_held(tables, world, contact, lane)
    x, y, friction = body[X, lane], body[Y, lane], world.numbers[constants.friction, lane]
    touch(tables, world, disc, pairs, x, y, constants.radius, ROBOT_DISC, friction, lane)
    if held >= 0 and not is_held_first:
        touch_held(tables, world, contact, lane)
    let_go(tables, world, contact, lane)
    solve(tables, world, disc, pairs, seconds, share, lane)
    disc[SECONDS] = seconds
    return int(disc[TOUCHING])


def forget_old(disc, pairs):
    """Forget the pairs that have not touched for so long that Chipmunk would have."""
    kept = 0
    for i in range(int(disc[PAIRS])):
        if pairs[PAIR_COLUMNS * i + USED] > disc[STEPS] - 1.0 - PERSISTENCE_TICKS:
            for column in range(PAIR_COLUMNS):
                pairs[PAIR_COLUMNS * kept + column] = pairs[PAIR_COLUMNS * i + column]
            kept += 1
    disc[PAIRS] = kept


def touch_held(tables, world, contact, lane):
    """Note what the item in the claw touches."""
    held = world.held[lane]
    x, y = place_in_claw(tables, world, contact, held, lane)
    radius = size_of(world.things, held, lane) / 2
    touch(tables, world, contact.disc[lane], contact.pairs[lane], x, y, radius, held, FRICTION_COEFFICIENT, lane)


def place_in_claw(tables, world, contact, thing, lane):
    """The x and y of a thing's middle in the claw, turned with the C library's sine and cosine as Chipmunk does it."""
    angle, turned = world.body[ANGLE, lane], contact.floats[lane]
    call(tables.library[SINE_COSINE], angle, turned[1:].ctypes.data, turned.ctypes.data)
    hold = tables.things[thing].hold
    return turned[0] * hold + world.body[X, lane], turned[1] * hold + world.body[Y, lane]


def let_go(tables, world, contact, lane):
    """Forget the pairs of what the claw has let go where it would touch if it were still there.

    For Chipmunk that is a contact without impulses, and what does not touch one that it remembers.
    """
    disc, pairs = contact.disc[lane], contact.pairs[lane]
    for i in range(int(disc[TOUCHING]), int(disc[PAIRS])):
        key, reach = int(pairs[PAIR_COLUMNS * i + KEY]), pairs[PAIR_COLUMNS * i + REACH]
        thing = key % (len(tables.things) + 1) - 1
        if thing != ROBOT_DISC and thing != world.held[lane]:
            x, y = place_in_claw(tables, world, contact, thing, lane)
            left, low, right, top = sides_of(tables, world, box_in(tables, key), lane)
            apart = nearest_points(x, y, reach, left, low, right, top)[6]
            if apart <= reach and overlaps(x, y, reach, left, low, right, top):
                pairs[PAIR_COLUMNS * i + USED] = -PERSISTENCE_TICKS


def touch(tables, world, disc, pairs, x, y, radius, thing, friction, lane):
    """Note what a disc at (x, y) touches, in the order in which Chipmunk's hash would find it."""
    boxes, begin = world.boxes.shape[1] // BOX_COLUMNS, int(disc[TOUCHING])
    for b in range(boxes):
        its_x, its_y, wide, high = box_of(world.boxes, b, lane)
        if overlaps(x, y, radius, its_x - wide, its_y - high, its_x + wide, its_y + high):
            meet(tables, world, disc, pairs, x, y, radius, thing, b, friction, lane)
    half_x, half_y = tables.world[0].half_x, tables.world[0].half_y
    if half_x < ENDLESS_UNITS and max(abs(x) + radius - half_x, abs(y) + radius - half_y) >= 0.0:
        for wall in range(WALL_COUNT):
            left, low, right, top = wall_of(half_x, half_y, wall)
            if overlaps(x, y, radius, left, low, right, top):
                meet(tables, world, disc, pairs, x, y, radius, thing, boxes + wall, friction, lane)
    if disc[TOUCHING] - begin > 1:
        rank(tables, world, disc, pairs, x, y, radius, begin, lane)


def overlaps(x, y, radius, left, low, right, top):
    """True if the square around a disc meets a box."""
    return (x - radius <= right) & (left <= x + radius) & (y - radius <= top) & (low <= y + radius)


def wall_of(x, y, wall):
    """The sides of a wall of an arena: left, low, right, top."""
    far_x, far_y = x + 2 * HALF_WALL_UNITS, y + 2 * HALF_WALL_UNITS
    if wall == 0:
        return -far_x, -far_y, -x, far_y
    if wall == 1:
        return x, -far_y, far_x, far_y
    if wall == 2:
        return -far_x, -far_y, far_x, -y
    return -far_x, y, far_x, far_y


def meet(tables, world, disc, pairs, x, y, radius, thing, b, friction, lane):
    """Note the contact of a disc and box b, if they touch."""
    left, low, right, top = sides_of(tables, world, b, lane)
    at_x, at_y, its_x, its_y, nx, ny, apart = nearest_points(x, y, radius, left, low, right, top)
    i = int(disc[TOUCHING])
    if not (apart <= radius and take_pair(disc, pairs, b * (len(tables.things) + 1) + thing + 1, i)):
        return
    disc[TOUCHING] += 1.0
    pair = PAIR_COLUMNS * i
    pairs[pair + NORMAL_X], pairs[pair + NORMAL_Y], pairs[pair + FRICTION] = nx, ny, friction
    own_x, own_y = world.body[X, lane], world.body[Y, lane]
    pairs[pair + AT_X], pairs[pair + AT_Y] = (at_x + nx * radius) - own_x, (at_y + ny * radius) - own_y
    # How far apart they are along the normal, of which the solver takes what is more than `slop` back.
    dx, dy = (its_x - pairs[pair + AT_X]) + (0.0 - own_x), (its_y - pairs[pair + AT_Y]) + (0.0 - own_y)
    pairs[pair + PARTING], pairs[pair + REACH] = dx * nx + dy * ny, radius


def take_pair(disc, pairs, key, i):
    """Put the pair with a key in place i, new where there is none; False where there is no room."""
    count, found = int(disc[PAIRS]), -1
    for k in range(i, count):
        found = k if pairs[PAIR_COLUMNS * k + KEY] == key else found
    if found < 0:
        if count == MOST_PAIRS:
            return False
        found = count
        disc[PAIRS] += 1.0
        pair = PAIR_COLUMNS * found
        pairs[pair + KEY], pairs[pair + USED], pairs[pair + ALONG], pairs[pair + ACROSS] = key, -1.0, 0.0, 0.0
    exchange(pairs, i, found)
    pair = PAIR_COLUMNS * i
    pairs[pair + FIRST] = 0.0 if pairs[pair + USED] == disc[STEPS] - 1.0 else 1.0
    pairs[pair + USED] = disc[STEPS]
    return True


def exchange(pairs, i, k):
    """Exchange two pairs."""
    for column in range(PAIR_COLUMNS):
        here, there = PAIR_COLUMNS * i + column, PAIR_COLUMNS * k + column
        pairs[here], pairs[there] = pairs[there], pairs[here]


def box_in(tables, key):
    """The number of the box, or of the wall behind these, in the key of a pair."""
    return int(key) // (len(tables.things) + 1)


def rank(tables, world, disc, pairs, x, y, radius, begin, lane):
    """Sort the pairs from number `begin` on into the order in which Chipmunk's hash finds them.

    It looks through the cells that the disc is in, column by column; in each at what lies in any cell of the same slot
    of its table, what was added last first.
    """
    cell, end = tables.world[0].cell, int(disc[TOUCHING])
    for i in range(begin, end):
        pairs[PAIR_COLUMNS * i + RANK] = -1.0
    number, count = 0.0, float(world.boxes.shape[1] // BOX_COLUMNS + WALL_COUNT)
    for column in range(floor((x - radius) / cell), floor((x + radius) / cell) + 1):
        for row in range(floor((y - radius) / cell), floor((y + radius) / cell) + 1):
            slot = slot_of(column, row)
            for i in range(begin, end):
                pair = PAIR_COLUMNS * i
                if pairs[pair + RANK] < 0.0:
                    left, low, right, top = sides_of(tables, world, box_in(tables, pairs[pair + KEY]), lane)
                    if lies_in(cell, left, low, right, top, slot):
                        pairs[pair + RANK] = number + (count - box_in(tables, pairs[pair + KEY]))
            number += count + 1.0
    for i in range(begin + 1, end):
        for k in range(i, begin, -1):
            if pairs[PAIR_COLUMNS * k + RANK] < pairs[PAIR_COLUMNS * (k - 1) + RANK]:
                exchange(pairs, k, k - 1)


def sides_of(tables, world, b, lane):
    """The sides of a box or, behind these, of a wall: left, low, right, top."""
    boxes = world.boxes.shape[1] // BOX_COLUMNS
    if b >= boxes:
        return wall_of(tables.world[0].half_x, tables.world[0].half_y, b - boxes)
    x, y, wide, high = box_of(world.boxes, b, lane)
    return x - wide, y - high, x + wide, y + high


def lies_in(cell, left, low, right, top, slot):
    """True if a box lies in any cell of a slot of Chipmunk's table."""
    for column in range(floor(left / cell), floor(right / cell) + 1):
        for row in range(floor(low / cell), floor(top / cell) + 1):
            if slot_of(column, row) == slot:
                return True
    return False


def slot_of(column, row):
    """The slot of a cell in Chipmunk's table."""
    return (np.uint64(column) * HASH_X ^ np.uint64(row) * HASH_Y) % HASH_SIZE


def floor(number):
    """The whole number at or below a number."""
    return int(np.floor(number))


def solve(tables, world, disc, pairs, seconds, share, lane):
    """Move the velocities on, and let sequential impulses part what touches and overlaps."""
    constants, body, count = tables.world[0], world.body, int(disc[TOUCHING])
    mass, moment = world.numbers[constants.mass_inv, lane], world.numbers[constants.moment_inv, lane]
    take_back = 1.0 - call_double(tables.library[POWER], COLLISION_BIAS, seconds) if count > 0 else 0.0
    for i in range(count):
        prepare(pairs, PAIR_COLUMNS * i, mass, moment, constants.slop, take_back, seconds)
    vx = body[SPEED_X, lane] + world.push[FORCE_X, lane] * share * mass * seconds
    vy = body[SPEED_Y, lane] + world.push[FORCE_Y, lane] * share * mass * seconds
    spin = body[SPIN, lane] + world.push[TORQUE, lane] * share * moment * seconds
    before = seconds / disc[SECONDS]  # in the first step all pairs are new, and nobody asks
    for i in range(count):
        pair = PAIR_COLUMNS * i
        if pairs[pair + FIRST] == 0.0:
            along, across = pairs[pair + ALONG], pairs[pair + ACROSS]
            vx, vy, spin = pushed(pairs, pair, along, across, before, mass, moment, vx, vy, spin)
    away_x, away_y, away_spin = 0.0, 0.0, 0.0
    for _ in range(SOLVER_ITERATIONS if count > 0 else 0):
        for i in range(count):
            pair = PAIR_COLUMNS * i
            more = part(pairs, pair, away_x, away_y, away_spin)
            along, across = bounce(pairs, pair, vx, vy, spin)
            away_x, away_y, away_spin = pushed(pairs, pair, more, 0.0, 1.0, mass, moment, away_x, away_y, away_spin)
            vx, vy, spin = pushed(pairs, pair, along, across, 1.0, mass, moment, vx, vy, spin)
    disc[BIAS_X], disc[BIAS_Y], disc[BIAS_SPIN] = away_x, away_y, away_spin
    body[SPEED_X, lane], body[SPEED_Y, lane], body[SPIN, lane] = vx, vy, spin


def prepare(pairs, pair, mass, moment, slop, take_back, seconds):
    """Compute how heavy the body is at a contact, along its normal and across, and how fast to part what overlaps."""
    nx, ny, rx, ry = pairs[pair + NORMAL_X], pairs[pair + NORMAL_Y], pairs[pair + AT_X], pairs[pair + AT_Y]
    arm = rx * ny - ry * nx
    pairs[pair + MASS_ALONG] = 1.0 / (mass + moment * arm * arm)
    arm = rx * nx - ry * -ny
    pairs[pair + MASS_ACROSS] = 1.0 / (mass + moment * arm * arm)
    depth = pairs[pair + PARTING] + slop
    pairs[pair + PARTING] = -take_back * (0.0 if depth > 0.0 else depth) / seconds
    pairs[pair + PARTED] = 0.0


def pushed(pairs, pair, along, across, share, mass, moment, vx, vy, spin):
    """The velocities after a share of an impulse along the normal of a contact, and across it."""
    nx, ny, rx, ry = pairs[pair + NORMAL_X], pairs[pair + NORMAL_Y], pairs[pair + AT_X], pairs[pair + AT_Y]
    jx, jy = -((nx * along - ny * across) * share), -((nx * across + ny * along) * share)
    return vx + jx * mass, vy + jy * mass, spin + moment * (rx * jy - ry * jx)


def part(pairs, pair, vx, vy, spin):
    """The impulse that is still wanted to part what overlaps, beside those velocities."""
    nx, ny, rx, ry = pairs[pair + NORMAL_X], pairs[pair + NORMAL_Y], pairs[pair + AT_X], pairs[pair + AT_Y]
    speed = (0.0 - (vx + -ry * spin)) * nx + (0.0 - (vy + rx * spin)) * ny
    before = pairs[pair + PARTED]
    now = before + (pairs[pair + PARTING] - speed) * pairs[pair + MASS_ALONG]
    pairs[pair + PARTED] = now if now > 0.0 else 0.0
    return pairs[pair + PARTED] - before


def bounce(pairs, pair, vx, vy, spin):
    """The impulses that are still wanted along the normal and, by friction, across it."""
    nx, ny, rx, ry = pairs[pair + NORMAL_X], pairs[pair + NORMAL_Y], pairs[pair + AT_X], pairs[pair + AT_Y]
    speed_x, speed_y = (0.0 - (vx + -ry * spin)) + 0.0, (0.0 - (vy + rx * spin)) + 0.0
    along, across = pairs[pair + ALONG], pairs[pair + ACROSS]
    now = along + -(speed_x * nx + speed_y * ny) * pairs[pair + MASS_ALONG]
    pairs[pair + ALONG] = now if now > 0.0 else 0.0
    most = pairs[pair + FRICTION] * pairs[pair + ALONG]
    now = across + -(speed_x * -ny + speed_y * nx) * pairs[pair + MASS_ACROSS]
    now = now if now > -most else -most
    pairs[pair + ACROSS] = now if now < most else most
    return pairs[pair + ALONG] - along, pairs[pair + ACROSS] - across
