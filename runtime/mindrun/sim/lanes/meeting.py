"""Contacts of solids with each other and with boxes and walls that never move, as Chipmunk's hash and shapes find them.

A **pair** is what is remembered of two that touch, or did so a few steps ago. Those that touch stand first, in the
order of the hash: for each solid that moves what else moves, then for each what never does.
"""

import numpy as np

from mindrun.numbers.arithmetic import BOX_COLUMNS, box_of
from mindrun.sim.codes import PERSISTENCE_TICKS, WALL_COUNT
from mindrun.sim.lanes.hashed import rank, sides_of, swap, wall_of
from mindrun.sim.lanes.loose import OF_LOOSE
from mindrun.sim.lanes.nearest_points import LEAST_NORMAL, corner, farthest, nearest_points
from mindrun.sim.lanes.placement import ENDLESS_UNITS
from mindrun.sim.lanes.shapes import overlap, put_corners, put_held
from mindrun.sim.state import (
    ACROSS,
    ALONG,
    AT_X,
    AT_Y,
    AWAKE,
    CONTACT,
    CONTACT_COLUMNS,
    CONTACTS,
    CORNER,
    CORNERS,
    COSINE_OF,
    FIRST,
    FIRST_LOOSE,
    FIXED,
    FOUND,
    FRICTION,
    HASH,
    HELD,
    HIGH,
    IN_CLAW,
    ITS_X,
    ITS_Y,
    KEY,
    LEFT,
    LOW,
    MIDDLE_X,
    MIDDLE_Y,
    NORMAL_X,
    NORMAL_Y,
    NUMBER,
    OTHER,
    OWN,
    OWN_CORNER,
    PAIR_COLUMNS,
    PAIRS,
    RADIUS,
    REACH,
    RIGHT,
    ROBOT,
    ROUGHNESS,
    RUN_INTO,
    SINE_OF,
    SOLID_COLUMNS,
    STEPS,
    THING,
    TOUCHING,
    USED,
    ContactState,
    WorldState,
)
from mindrun.sim.tables import Tables
from mindrun.sim.units import unit_where

KEY_RANGE = 1 << 26
CORNER_HASH, HASH_BITS = np.uint64(3344921057), np.uint64((1 << 52) - 1)  # as many as a number has
OF_QUADRANGLES = unit_where(lambda tables: not tables.world[0]["is_round"] or not tables.loose["is_round"].all())


def forget_old(space, pairs):
    """Forget the pairs that have not touched for so long that Chipmunk would have."""
    kept = 0
    for i in range(int(space[PAIRS])):
        if pairs[PAIR_COLUMNS * i + USED] >= space[STEPS] - PERSISTENCE_TICKS:
            if kept < i:
                swap(pairs, kept, i)
            kept += 1
    space[PAIRS], space[TOUCHING] = kept, 0.0


@OF_LOOSE
def touch_movers(tables: Tables, world: WorldState, contact: ContactState, lane: int) -> None:
    """Note what touches of all that moves."""
    space, solids, awake = contact.space[lane], contact.solids[lane], contact.awake[lane]
    for i in range(1, int(space[AWAKE])):
        a, begin = awake[i], int(space[TOUCHING])
        for k in range(i - 1, -1, -1):
            b = awake[k]
            if overlap(solids, a, b) and a + b != ROBOT + HELD:
                meet(contact, a, b, b, lane)
        if space[TOUCHING] - begin > 1.0:
            rank(tables, world, contact, a, begin, lane)


def touch_fixed(tables, world, contact, lane):
    """Note what touches what never moves, and how often the robot does, with what it holds."""
    space, awake, near = contact.space[lane], contact.awake[lane], contact.close[lane]
    number = FIRST_LOOSE + len(tables.loose)  # of the first box
    for i in range(int(space[AWAKE])):
        a, begin = awake[i], int(space[TOUCHING])
        for k in range(find_close(tables, world, contact, a, lane) - 1, -1, -1):
            put_fixed(tables, world, contact, number + near[k], lane)
            meet(contact, a, FIXED, number + near[k], lane)
        count = space[TOUCHING] - begin
        if count > 1.0:
            rank(tables, world, contact, a, begin, lane)
        space[RUN_INTO] += count if a in (ROBOT, HELD) else 0.0


def let_go(tables, world, contact, lane):
    """Forget the pairs of what the claw has let go where it would touch if it were still there.

    For Chipmunk that is a contact without impulses, and what does not touch one that it remembers.
    """
    solids, pairs, space = contact.solids[lane], contact.pairs[lane], contact.space[lane]
    for i in range(int(space[TOUCHING]), int(space[PAIRS])):
        pair = PAIR_COLUMNS * i
        thing, number = int(pairs[pair + THING]), int(pairs[pair + FOUND])
        if thing >= 0 and thing != space[IN_CLAW]:
            put_held(tables, world, contact, thing, pairs[pair + REACH], lane)
            own, other = int(pairs[pair + OWN]) // SOLID_COLUMNS, int(pairs[pair + OTHER]) // SOLID_COLUMNS
            b = own if other == ROBOT else other
            if b == FIXED:
                put_fixed(tables, world, contact, number, lane)
            if overlap(solids, HELD, b) and touch_circle(solids, SOLID_COLUMNS * HELD, SOLID_COLUMNS * b)[0]:
                pairs[pair + USED] = -PERSISTENCE_TICKS


def put_fixed(tables, world, contact, number, lane):
    """Write a box or a wall to where the solid stands that never moves."""
    solids, p = contact.solids[lane], SOLID_COLUMNS * FIXED
    left, low, right, top = sides_of(tables, world, solids, number, lane)
    solids[p + LEFT], solids[p + LOW], solids[p + RIGHT], solids[p + HIGH] = left, low, right, top
    put_corners(solids, p + CORNER, left, low, right, top)
    solids[p + NUMBER] = number - FIRST_LOOSE - len(tables.loose)


def find_close(tables, world, contact, a, lane):
    """Write down the boxes and walls that meet the rectangle around a solid; return how many do."""
    close, solids, p = contact.close[lane], contact.solids[lane], SOLID_COLUMNS * a
    left, right, low, high = solids[p + LEFT], solids[p + RIGHT], solids[p + LOW], solids[p + HIGH]
    boxes, half_x, half_y = world.boxes.shape[1] // BOX_COLUMNS, tables.world[0].half_x, tables.world[0].half_y
    count = 0
    for b in range(boxes):
        x, y, wide, tall = box_of(world.boxes, b, lane)
        if x - wide <= right and left <= x + wide and y - tall <= high and low <= y + tall:
            close[count], count = b, count + 1
    if half_x < ENDLESS_UNITS and (left <= -half_x or right >= half_x or low <= -half_y or high >= half_y):
        for wall in range(WALL_COUNT):
            its_left, its_low, its_right, its_top = wall_of(half_x, half_y, wall)
            if left <= its_right and its_left <= right and low <= its_top and its_low <= high:
                close[count], count = boxes + wall, count + 1
    return count


def meet(contact, a, b, found, lane):
    """Note the contacts of two solids, if they touch; `found` is the number of the other, and of no other box."""
    solids, pairs = contact.solids[lane], contact.pairs[lane]
    key = KEY_RANGE * named(contact, a, lane) + named(contact, found, lane)
    own, other = SOLID_COLUMNS * a, SOLID_COLUMNS * b
    if solids[own + CORNERS] > solids[other + CORNERS]:
        a, b, own, other = b, a, other, own
    if solids[own + CORNERS] > 1.0:
        meet_quadrangles(contact, a, b, key, found, lane)
        return
    touches, x, y, its_x, its_y, nx, ny = touch_circle(solids, own, other)
    pair = take_pair(contact, a, b, key, found, nx, ny, lane) if touches else -1
    if pair >= 0:
        if pairs[pair + CONTACTS] == 0.0:
            pairs[pair + CONTACT + ALONG], pairs[pair + CONTACT + ACROSS] = 0.0, 0.0
        pairs[pair + CONTACTS] = 1.0
        put_contact(solids, pairs, pair, pair + CONTACT, x, y, its_x, its_y)


def named(contact, a, lane):
    """The number of a solid that no other has; every thing has its own in the claw."""
    return -1 - int(contact.space[lane, IN_CLAW]) if a == HELD else a


def touch_circle(solids, own, other):
    """True if a circle and another solid touch; the points of both, and the normal."""
    radius, x, y = solids[own + RADIUS], solids[own + CORNER], solids[own + CORNER + 1]
    if solids[other + CORNERS] > 1.0:
        x, y, its_x, its_y, nx, ny, apart = nearest_points(solids, own, other)
        return apart <= radius, x + nx * radius, y + ny * radius, its_x, its_y, nx, ny
    its_radius, its_x, its_y = solids[other + RADIUS], solids[other + CORNER], solids[other + CORNER + 1]
    dx, dy, near = its_x - x, its_y - y, radius + its_radius
    square = dx * dx + dy * dy
    apart = np.sqrt(square)
    nx, ny = (dx * (1.0 / apart), dy * (1.0 / apart)) if apart != 0.0 else (1.0, 0.0)
    its_x, its_y = its_x + nx * -its_radius, its_y + ny * -its_radius
    return square < near * near, x + nx * radius, y + ny * radius, its_x, its_y, nx, ny


def take_pair(contact, a, b, key, found, nx, ny, lane):
    """Move the pair with a key behind those that touch, new where there is none; its column.

    Without room for it that is −1, and the robot is nowhere: its run ends as a fault.
    """
    space, solids, pairs = contact.space[lane], contact.solids[lane], contact.pairs[lane]
    place, count = int(space[TOUCHING]), int(space[PAIRS])
    k = place
    while k < count and pairs[PAIR_COLUMNS * k + KEY] != key:
        k += 1
    pair = PAIR_COLUMNS * k
    if k == count:
        if pair >= len(pairs):
            solids[SOLID_COLUMNS * ROBOT + MIDDLE_X] = np.nan
            return -1
        space[PAIRS] += 1.0
        pairs[pair + KEY], pairs[pair + USED], pairs[pair + CONTACTS] = key, -1.0, 0.0
        pairs[pair + THING] = space[IN_CLAW] if HELD in (a, b) else -1.0
    if k > place:
        swap(pairs, place, k)
    pair = PAIR_COLUMNS * place
    space[TOUCHING] += 1.0
    pairs[pair + FIRST] = 0.0 if pairs[pair + USED] == space[STEPS] - 1.0 else 1.0
    pairs[pair + USED], pairs[pair + FOUND] = space[STEPS], found
    pairs[pair + OWN], pairs[pair + OTHER] = SOLID_COLUMNS * body_of(a), SOLID_COLUMNS * body_of(b)
    pairs[pair + NORMAL_X], pairs[pair + NORMAL_Y], pairs[pair + REACH] = nx, ny, solids[SOLID_COLUMNS * HELD + RADIUS]
    pairs[pair + FRICTION] = solids[SOLID_COLUMNS * a + ROUGHNESS] * solids[SOLID_COLUMNS * b + ROUGHNESS]
    return pair


def body_of(a):
    """The solid with whose motion a solid moves."""
    return ROBOT if a == HELD else a


def put_contact(solids, pairs, pair, contact, x, y, its_x, its_y):
    """Write the places of a contact, from the middles of both."""
    a, b = int(pairs[pair + OWN]), int(pairs[pair + OTHER])
    pairs[contact + AT_X], pairs[contact + AT_Y] = x - solids[a + MIDDLE_X], y - solids[a + MIDDLE_Y]
    pairs[contact + ITS_X], pairs[contact + ITS_Y] = its_x - solids[b + MIDDLE_X], its_y - solids[b + MIDDLE_Y]


@OF_QUADRANGLES
def meet_quadrangles(contact: ContactState, a: int, b: int, key: int, found: int, lane: int) -> None:
    """Note the contacts of two quadrangles, if they touch: up to two, where the ends of their edges face each other."""
    solids, pairs, own, other = contact.solids[lane], contact.pairs[lane], SOLID_COLUMNS * a, SOLID_COLUMNS * b
    _, _, _, _, nx, ny, apart = nearest_points(solids, own, other)
    if not apart <= 0.0:
        return
    if b == FIXED:
        for column in range(8):
            solids[other + OWN_CORNER + column] = solids[other + CORNER + column]
    c, d = edge(solids, own, nx, ny)
    e, f = edge(solids, other, -nx, -ny)
    cx, cy, dx, dy = ends(solids, corner(own, c), corner(own, d))
    ex, ey, fx, fy = ends(solids, corner(other, e), corner(other, f))
    at_c, at_d, at_e, at_f = cx * ny - cy * nx, dx * ny - dy * nx, ex * ny - ey * nx, fx * ny - fy * nx
    scale, its_scale = 1.0 / (at_d - at_c + LEAST_NORMAL), 1.0 / (at_f - at_e + LEAST_NORMAL)
    t, u = clamped((at_f - at_c) * scale), clamped((at_c - at_e) * its_scale)
    x, y, its_x, its_y = (
        cx * (1.0 - t) + dx * t,
        cy * (1.0 - t) + dy * t,
        ex * (1.0 - u) + fx * u,
        ey * (1.0 - u) + fy * u,
    )
    is_one = (its_x - x) * nx + (its_y - y) * ny <= 0.0
    t, u = clamped((at_e - at_c) * scale), clamped((at_d - at_e) * its_scale)
    cx, cy, ex, ey = cx * (1.0 - t) + dx * t, cy * (1.0 - t) + dy * t, ex * (1.0 - u) + fx * u, ey * (1.0 - u) + fy * u
    is_other = (ex - cx) * nx + (ey - cy) * ny <= 0.0
    if not (is_one or is_other):
        return
    pair = take_pair(contact, a, b, key, found, nx, ny, lane)
    if pair < 0:
        return
    one = contact_hash(solids[own + NUMBER], c, solids[other + NUMBER], f)
    another = contact_hash(solids[own + NUMBER], d, solids[other + NUMBER], e)
    remember(pairs, pair, is_one, is_other, one, another)
    if is_one:
        put_contact(solids, pairs, pair, pair + CONTACT, x, y, its_x, its_y)
    if is_other:
        put_contact(solids, pairs, pair, pair + CONTACT + (CONTACT_COLUMNS if is_one else 0), cx, cy, ex, ey)


def edge(solids, a, nx, ny):
    """The numbers of both ends of the edge of a quadrangle that faces a direction."""
    i = farthest(solids, a, nx, ny)
    following = (i + 1) % 4
    ax, ay = facing(solids, a, i)
    bx, by = facing(solids, a, following)
    return ((i + 3) % 4, i) if nx * ax + ny * ay > nx * bx + ny * by else (i, following)


def facing(solids, a, i):
    """The direction that the edge before corner i faces."""
    here, before = a + OWN_CORNER + 2 * i, a + OWN_CORNER + 2 * ((i + 3) % 4)
    dx, dy = solids[here] - solids[before], solids[here + 1] - solids[before + 1]
    scale = 1.0 / (np.sqrt(dy * dy + dx * dx) + LEAST_NORMAL)
    nx, ny, cosine, sine = dy * scale, -dx * scale, solids[a + COSINE_OF], solids[a + SINE_OF]
    return cosine * nx + -sine * ny, sine * nx + cosine * ny


def ends(solids, one, other):
    """The x and y of two corners at their columns."""
    return solids[one], solids[one + 1], solids[other], solids[other + 1]


def clamped(t):
    """A number clamped to 0..1; 1 for NaN."""
    t = t if t < 1.0 else 1.0
    return 0.0 if t < 0.0 else t


def contact_hash(number, i, its_number, k):
    """The number by which Chipmunk knows a contact between two corners again, but for its highest bits."""
    here = np.uint64(number) * CORNER_HASH ^ np.uint64(i) * CORNER_HASH
    there = np.uint64(its_number) * CORNER_HASH ^ np.uint64(k) * CORNER_HASH
    return np.float64((here * CORNER_HASH ^ there * CORNER_HASH) & HASH_BITS)


def remember(pairs, pair, is_one, is_other, one, another):
    """Give the contacts with these hashes the impulses of those that a pair has had, or none."""
    along, across = recalled(pairs, pair, one)
    other_along, other_across = recalled(pairs, pair, another)
    c = pair + CONTACT
    if is_one:
        pairs[c + HASH], pairs[c + ALONG], pairs[c + ACROSS] = one, along, across
        c += CONTACT_COLUMNS
    if is_other:
        pairs[c + HASH], pairs[c + ALONG], pairs[c + ACROSS] = another, other_along, other_across
    pairs[pair + CONTACTS] = 2.0 if is_one and is_other else 1.0


def recalled(pairs, pair, known):
    """The impulses of the contact of a pair with a hash, 0 if it has none."""
    along, across = 0.0, 0.0
    for k in range(int(pairs[pair + CONTACTS])):
        c = pair + CONTACT + CONTACT_COLUMNS * k
        if pairs[c + HASH] == known:
            along, across = pairs[c + ALONG], pairs[c + ACROSS]
    return along, across
