"""Contacts of solids with each other and with boxes and walls that never move, as Chipmunk's hash and shapes find them.

A **pair** is what is remembered of two that touch, or did so a few steps ago. Those that touch stand first, in the
order of the hash: for each solid that moves what else moves, then for each what never does. The hash looks through the
cells that the solid is in, column by column; in each at what lies in any cell of the same slot of its table, what was
added last first.
"""

import numpy as np

from mindrun.numbers.arithmetic import *
from mindrun.sim.codes import PERSISTENCE_TICKS, WALL_COUNT, Tables
from mindrun.sim.lanes.nearest_points import LEAST_NORMAL, farthest, nearest_points
from mindrun.sim.lanes.placement import ENDLESS_UNITS
from mindrun.sim.lanes.solid import count_of, first_loose
from mindrun.sim.lanes.solids import overlap, put_corners, put_held, turn
from mindrun.sim.state import FIXED, ROBOT, ContactState, WorldState
from mindrun.sim.units import unit_where

SLOTS, HASH_X, HASH_Y = np.uint64(23), np.uint64(1640531513), np.uint64(2654435789)
HALF_WALL_UNITS = 1.0  # half the thickness of a wall, outside the arena


def rank(tables, world, contact, a, begin, lane):
    """Sort the pairs of solid `a` from number `begin` on, what was added last first, into the order of the hash."""
    solids, pairs, order, cell = contact.solids[lane], contact.pairs[lane], contact.order[lane], tables.world[0].cell
    left, right = floor(solids[a].left / cell), floor(solids[a].right / cell)
    low, high = floor(solids[a].low / cell), floor(solids[a].high / cell)
    if left == right and low == high:
        return
    end = contact.space[lane].touching
    for i in range(begin, end):
        number, is_found = 0, False
        its_left, its_low, its_right, its_top = sides_of(tables, world, solids, pairs[order[i]].found, lane)
        for column in range(left, right + 1):
            for row in range(low, high + 1):
                is_found = is_found or lies_in(cell, its_left, its_low, its_right, its_top, slot_of(column, row))
                number += 0 if is_found else 1
        pairs[order[i]].rank = number
    for i in range(begin + 1, end):
        for k in range(i, begin, -1):
            if pairs[order[k]].rank < pairs[order[k - 1]].rank:
                swap(order, k - 1, k)


def swap(order, i, k):
    """Let two pairs change places."""
    order[i], order[k] = order[k], order[i]


def sides_of(tables, world, solids, number, lane):
    """The sides of a solid or, behind these, of a box or, behind these, of a wall: left, low, right, top."""
    b, boxes = number - first_box(tables), count_of(world.boxes)
    if b < 0:
        return solids[number].left, solids[number].low, solids[number].right, solids[number].high
    if b >= boxes:
        return wall_of(tables.world[0].half_x, tables.world[0].half_y, b - boxes)
    x, y, wide, high = box_of(world.boxes, b, lane)
    return x - wide, y - high, x + wide, y + high


def first_box(tables):
    """The number of the first box, behind all solids that move."""
    return first_loose(tables) + len(tables.loose)


def wall_of(x, y, wall):
    """The sides of a wall of an arena: left, low, right, top."""
    far_x, far_y = x + 2 * HALF_WALL_UNITS, y + 2 * HALF_WALL_UNITS
    left, low = x if wall == 1 else -far_x, y if wall == 3 else -far_y
    return left, low, -x if wall == 0 else far_x, -y if wall == 2 else far_y


def lies_in(cell, left, low, right, top, slot):
    """True if a rectangle lies in any cell of a slot of Chipmunk's table."""
    for column in range(floor(left / cell), floor(right / cell) + 1):
        for row in range(floor(low / cell), floor(top / cell) + 1):
            if slot_of(column, row) == slot:
                return True
    return False


def slot_of(column, row):
    """The slot of a cell in Chipmunk's table."""
    return (np.uint64(np.int64(column)) * HASH_X ^ np.uint64(np.int64(row)) * HASH_Y) % SLOTS


def floor(number):
    """The whole number at or below a number."""
    return int(np.floor(number))


KEY_RANGE = 1 << 26
CORNER_HASH, NO_HASH = np.uint64(3344921057), np.uint64(0)  # the only contact of a circle has none
OF_MOVERS = unit_where(lambda tables: len(tables.loose) > 0 or len(tables.robots) > 1)
OF_QUADRANGLES = unit_where(lambda tables: not tables.world[0]["is_round"] or not tables.loose["is_round"].all())


def forget_old(space, pairs, order):
    """Forget the pairs that have not touched for so long that Chipmunk would have."""
    kept = 0
    for i in range(space.pairs):
        if pairs[order[i]].used >= space.steps - PERSISTENCE_TICKS:
            swap(order, kept, i)
            kept += 1
    space.pairs, space.touching = kept, 0


@OF_MOVERS
def touch_movers(tables: Tables, world: WorldState, contact: ContactState, lane: int) -> None:
    """Note what touches of all that moves, and which robots touch each other."""
    space, solids, awake = contact.space[lane], contact.solids[lane], contact.awake[lane]
    for i in range(1, space.awake):
        a, begin = awake[i], space.touching
        for k in range(i - 1, -1, -1):
            b, before = awake[k], space.touching
            if overlap(solids[a], solids[b]) and solids[a].body != solids[b].body:
                meet(contact, a, b, b, lane)
                if space.touching > before and solids[a].robot >= 0 and solids[b].robot >= 0:
                    contact.space[lane + solids[a].robot].met |= 1 << solids[b].robot
                    contact.space[lane + solids[b].robot].met |= 1 << solids[a].robot
        if space.touching - begin > 1:
            rank(tables, world, contact, a, begin, lane)


def touch_fixed(tables, world, contact, lane):
    """Note what touches what never moves, and how often each robot does, with what it holds."""
    space, awake, near, solids = contact.space[lane], contact.awake[lane], contact.close[lane], contact.solids[lane]
    number = first_box(tables)
    for i in range(space.awake):
        a, begin = awake[i], space.touching
        for k in range(find_close(tables, world, contact, a, lane) - 1, -1, -1):
            put_fixed(tables, world, contact, number + near[k], lane)
            meet(contact, a, FIXED, number + near[k], lane)
        count = space.touching - begin
        if count > 1:
            rank(tables, world, contact, a, begin, lane)
        if solids[a].robot >= 0:
            contact.space[lane + solids[a].robot].run_into += count


def let_go(tables, world, contact, lane):
    """Forget the pairs of what the claw has let go where it would touch if it were still there.

    For Chipmunk that is a contact without impulses, and what does not touch one that it remembers.
    """
    pairs, space = contact.pairs[lane], contact.space[lane]
    for i in range(space.touching, space.pairs):
        pair = pairs[contact.order[lane, i]]
        if was_let_go(contact, pair.thing, pair.own, lane):
            part_if_near(tables, world, contact, pair, pair.thing, pair.own, pair.other, lane)
        elif was_let_go(contact, pair.its_thing, pair.other, lane):
            part_if_near(tables, world, contact, pair, pair.its_thing, pair.other, pair.own, lane)


def was_let_go(contact, thing, own, lane):
    """True if a thing was in the claw of a robot, whose solid is given, and is not any more."""
    return thing >= 0 and thing != contact.space[lane + contact.solids[lane, own].robot].in_claw


def part_if_near(tables, world, contact, pair, thing, own, b, lane):
    """Forget a pair if the thing that a robot has let go would touch solid `b` where it was held."""
    solids = contact.solids[lane]
    held, own_lane = solids[own + 1], lane + solids[own].robot
    turn(tables, solids[own], world.body[ANGLE, own_lane])
    put_held(tables, solids[own], held, thing, pair.reach)
    if b == FIXED:
        put_fixed(tables, world, contact, pair.found, lane)
    if overlap(held, solids[b]) and touch_circle(held, solids[b])[0]:
        pair.used = -PERSISTENCE_TICKS


def put_fixed(tables, world, contact, number, lane):
    """Write a box or a wall to where the solid stands that never moves."""
    solids, fixed = contact.solids[lane], contact.solids[lane, FIXED]
    fixed.left, fixed.low, fixed.right, fixed.high = sides_of(tables, world, solids, number, lane)
    put_corners(fixed.corners, fixed.left, fixed.low, fixed.right, fixed.high)
    fixed.number = number - first_box(tables)


def find_close(tables, world, contact, a, lane):
    """Write down the boxes and walls that meet the rectangle around a solid; return how many do."""
    close, solid = contact.close[lane], contact.solids[lane, a]
    left, right, low, high = solid.left, solid.right, solid.low, solid.high
    boxes, half_x, half_y = count_of(world.boxes), tables.world[0].half_x, tables.world[0].half_y
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
    if solids[b].is_round and not solids[a].is_round:
        a, b = b, a
    if not solids[a].is_round:
        meet_quadrangles(contact, a, b, key, found, lane)
        return
    touches, x, y, its_x, its_y, nx, ny = touch_circle(solids[a], solids[b])
    i = take_pair(contact, a, b, key, found, nx, ny, lane) if touches else -1
    if i >= 0:
        along, across = recalled(pairs[i], NO_HASH)
        pairs[i].count = 0
        put_contact(solids, pairs[i], NO_HASH, along, across, x, y, its_x, its_y)


def named(contact, a, lane):
    """The number of a solid that no other has; every thing has its own in the claw."""
    solids = contact.solids[lane]
    if a >= len(solids) or solids[a].body == a:
        return a
    return -1 - contact.space[lane + solids[a].robot].in_claw


def touch_circle(circle, other):
    """True if a circle and another solid touch; the points of both, and the normal."""
    radius, x, y = circle.radius, circle.corners[0].x, circle.corners[0].y
    if not other.is_round:
        x, y, its_x, its_y, nx, ny, apart = nearest_points(circle, other)
        return apart <= radius, x + nx * radius, y + ny * radius, its_x, its_y, nx, ny
    its_radius, its_x, its_y = other.radius, other.corners[0].x, other.corners[0].y
    dx, dy, near = its_x - x, its_y - y, radius + its_radius
    square = dx * dx + dy * dy
    apart = np.sqrt(square)
    nx, ny = (dx * (1.0 / apart), dy * (1.0 / apart)) if apart != 0.0 else (1.0, 0.0)
    its_x, its_y = its_x + nx * -its_radius, its_y + ny * -its_radius
    return square < near * near, x + nx * radius, y + ny * radius, its_x, its_y, nx, ny


def take_pair(contact, a, b, key, found, nx, ny, lane):
    """Move the pair with a key behind those that touch, new where there is none; its number.

    Without room for it that is −1, and the robot is nowhere: its run ends as a fault.
    """
    space, solids, pairs, order = contact.space[lane], contact.solids[lane], contact.pairs[lane], contact.order[lane]
    k = space.touching
    while k < space.pairs and pairs[order[k]].key != key:
        k += 1
    if k == len(pairs):
        solids[ROBOT].middle_x = np.nan
        return -1
    i = order[k]
    pair = pairs[i]
    if k == space.pairs:
        space.pairs += 1
        pair.key, pair.used, pair.count = key, -1, 0
        pair.thing, pair.its_thing = thing_of(contact, a, lane), thing_of(contact, b, lane)
    swap(order, space.touching, k)
    space.touching += 1
    pair.is_first = 0 if pair.used == space.steps - 1 else 1
    pair.used, pair.found = space.steps, found
    pair.own, pair.other = solids[a].body, solids[b].body
    pair.normal_x, pair.normal_y = nx, ny
    pair.reach = solids[a if solids[a].body != a else b].radius
    pair.friction = solids[a].friction * solids[b].friction
    return i


def thing_of(contact, a, lane):
    """The thing that solid `a` is in a claw, or −1."""
    solid = contact.solids[lane, a]
    return -1 if solid.body == a else contact.space[lane + solid.robot].in_claw


def put_contact(solids, pair, known, along, across, x, y, its_x, its_y):
    """Give a pair one more contact with a hash, its impulses and its places, from the middles of both."""
    own, other, contact = solids[pair.own], solids[pair.other], pair.contacts[pair.count]
    contact.hash, contact.along, contact.across = known, along, across
    pair.count += 1
    contact.x, contact.y = x - own.middle_x, y - own.middle_y
    contact.its_x, contact.its_y = its_x - other.middle_x, its_y - other.middle_y


@OF_QUADRANGLES
def meet_quadrangles(contact: ContactState, a: int, b: int, key: int, found: int, lane: int) -> None:
    """Note the contacts of two quadrangles, if they touch: up to two, where the ends of their edges face each other."""
    solids, own, other = contact.solids[lane], contact.solids[lane, a], contact.solids[lane, b]
    _, _, _, _, nx, ny, apart = nearest_points(own, other)
    if not apart <= 0.0:
        return
    if b == FIXED:
        other.own_corners = other.corners
    c, d, cx, cy, dx, dy = edge(own, nx, ny)
    e, f, ex, ey, fx, fy = edge(other, -nx, -ny)
    at_c, at_d, at_e, at_f = cx * ny - cy * nx, dx * ny - dy * nx, ex * ny - ey * nx, fx * ny - fy * nx
    scale, its_scale = 1.0 / (at_d - at_c + LEAST_NORMAL), 1.0 / (at_f - at_e + LEAST_NORMAL)
    t, u = clamped((at_f - at_c) * scale), clamped((at_c - at_e) * its_scale)
    x, y = on_way(cx, cy, dx, dy, t)
    its_x, its_y = on_way(ex, ey, fx, fy, u)
    is_one = (its_x - x) * nx + (its_y - y) * ny <= 0.0
    t, u = clamped((at_e - at_c) * scale), clamped((at_d - at_e) * its_scale)
    cx, cy = on_way(cx, cy, dx, dy, t)
    ex, ey = on_way(ex, ey, fx, fy, u)
    is_other = (ex - cx) * nx + (ey - cy) * ny <= 0.0
    i = take_pair(contact, a, b, key, found, nx, ny, lane) if is_one or is_other else -1
    if i < 0:
        return
    pair = contact.pairs[lane, i]
    one, another = contact_hash(own.number, c, other.number, f), contact_hash(own.number, d, other.number, e)
    along, across = recalled(pair, one)
    other_along, other_across = recalled(pair, another)
    pair.count = 0
    if is_one:
        put_contact(solids, pair, one, along, across, x, y, its_x, its_y)
    if is_other:
        put_contact(solids, pair, another, other_along, other_across, cx, cy, ex, ey)


def on_way(x, y, to_x, to_y, share):
    """The place at a share of the way from one place to another."""
    return x * (1.0 - share) + to_x * share, y * (1.0 - share) + to_y * share


def edge(solid, nx, ny):
    """The numbers of both ends of the edge of a quadrangle that faces a direction, and where they are."""
    i = farthest(solid, nx, ny)
    following, before = (i + 1) % 4, (i + 3) % 4
    ax, ay = facing(solid, i)
    bx, by = facing(solid, following)
    c, d = (before, i) if nx * ax + ny * ay > nx * bx + ny * by else (i, following)
    return c, d, solid.corners[c].x, solid.corners[c].y, solid.corners[d].x, solid.corners[d].y


def facing(solid, i):
    """The direction that the edge before corner i faces."""
    here, before = solid.own_corners[i], solid.own_corners[(i + 3) % 4]
    dx, dy = here.x - before.x, here.y - before.y
    scale = 1.0 / (np.sqrt(dy * dy + dx * dx) + LEAST_NORMAL)
    nx, ny, cosine, sine = dy * scale, -dx * scale, solid.cosine, solid.sine
    return cosine * nx + -sine * ny, sine * nx + cosine * ny


def clamped(t):
    """A number clamped to 0..1; 1 for NaN."""
    t = t if t < 1.0 else 1.0
    return 0.0 if t < 0.0 else t


def contact_hash(number, i, its_number, k):
    """The number by which Chipmunk knows a contact between two corners again."""
    here = np.uint64(number) * CORNER_HASH ^ np.uint64(i) * CORNER_HASH
    there = np.uint64(its_number) * CORNER_HASH ^ np.uint64(k) * CORNER_HASH
    return here * CORNER_HASH ^ there * CORNER_HASH


def recalled(pair, known):
    """The impulses of the contact of a pair with a hash, 0 if it has none."""
    along, across = 0.0, 0.0
    for k in range(pair.count):
        if pair.contacts[k].hash == known:
            along, across = pair.contacts[k].along, pair.contacts[k].across
    return along, across
