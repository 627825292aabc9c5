"""The order in which Chipmunk's hash finds what a solid meets.

It looks through the cells that the solid is in, column by column; in each at what lies in any cell of the same slot of
its table, what was added last first.
"""

import numpy as np

from mindrun.numbers.arithmetic import BOX_COLUMNS, box_of
from mindrun.sim.state import FIRST_LOOSE

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
    b, boxes = number - FIRST_LOOSE - len(tables.loose), world.boxes.shape[1] // BOX_COLUMNS
    if b < 0:
        return solids[number].left, solids[number].low, solids[number].right, solids[number].high
    if b >= boxes:
        return wall_of(tables.world[0].half_x, tables.world[0].half_y, b - boxes)
    x, y, wide, high = box_of(world.boxes, b, lane)
    return x - wide, y - high, x + wide, y + high


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
