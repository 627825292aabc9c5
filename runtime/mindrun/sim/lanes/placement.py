"""Places drawn at random, of things that appear and reappear.

Every world has its own generator (SplitMix64), seeded by the layout alone, so that all genomes of a generation meet
the same world. Everything is placed clear of everything else, with room for the robot between.
"""

import numpy as np

from mindrun.graph.tasks import meets_robot
from mindrun.numbers.arithmetic import *
from mindrun.sim.codes import Tables
from mindrun.sim.lanes.solid import is_clear
from mindrun.sim.state import WorldState
from mindrun.sim.units import unit, unit_where

MAX_TRIES = 1000
OF_SEVERAL = unit_where(lambda tables: len(tables.robots) > 1)  # robots in one world
ENDLESS_UNITS = 1e300  # half the side of what is no arena is infinite, above this


def place_for(tables, world, i, is_begun, lane):
    """A place for a thing with a place, or with several or a way that is drawn; the robot `is_begun` when it moves."""
    thing = tables.things[i]
    if thing.walker >= 0 and tables.walkers[thing.walker].ways > 0:
        return set_out(tables, world, thing.walker, lane)
    if thing.options > 0:
        return choose(tables, world, i, is_begun, lane)
    return at_drawn(world, thing, lane)


def at_drawn(world, placed, lane):
    """The place of something, whose x and y may be made of numbers that the task draws."""
    if placed.x_row >= 0:
        return world.numbers[placed.x_row, lane], world.numbers[placed.y_row, lane]
    return placed.x, placed.y


def choose(tables, world, i, is_begun, lane):
    """Draw one of a thing's places, alike probable among those that fit it best."""
    thing, best, count = tables.things[i], 0, 0
    for option in range(thing.option, thing.option + thing.options):
        fits = fit(tables, world, i, option, is_begun, lane)
        count = count + 1 if fits == best else 1 if fits > best else count
        best = max(best, fits)
    left = any_of(world.random, count, lane)
    for option in range(thing.option, thing.option + thing.options):
        if fit(tables, world, i, option, is_begun, lane) == best:
            if left == 0:
                return tables.options[option, X], tables.options[option, Y]
            left -= 1
    return np.nan, np.nan  # never: one of them fits best


def any_of(random, count, lane):
    """A whole number from 0 to before `count`, each as probable."""
    return min(int(uniform(random, lane, 0.0, count)), count - 1)


def fit(tables, world, i, option, is_begun, lane):
    """How well a place fits a thing: 0 where another of its name is, 1 where it is itself, 2 on the robot, else 3."""
    thing, x, y = tables.things[i], tables.options[option, X], tables.options[option, Y]
    for k in range(i - thing.copy, i - thing.copy + thing.copies):
        its_x, its_y = place_of(world.things, k, lane)
        if its_x == x and its_y == y:
            return 1 if k == i else 0
    if is_begun:
        dx, dy = x - world.body[X, lane], y - world.body[Y, lane]
        if stands_on(tables, i, size_of(world.things, i, lane), dx, dy):
            return 2
    return 3


def set_out(tables, world, i, lane):
    """Send a walker on its way, or on one that is drawn; return where it begins: at one of its corners, or anywhere."""
    walker = tables.walkers[i]
    way = walker.way
    if walker.ways > 1:
        way += any_of(world.random, walker.ways, lane)
    first, places = tables.ways[way].first, tables.ways[way].places
    corner, far = first + walker.copy % places, 0.0
    if walker.is_anywhere:
        for k in range(first, first + places):
            far += stretch(tables, world, k, lane)
        far, corner = uniform(world.random, lane, 0.0, far), first
        while corner < first + places - 1 and far > stretch(tables, world, corner, lane):
            far -= stretch(tables, world, corner, lane)
            corner += 1
    goal = tables.corners[corner].next
    world.goal[i, lane] = goal
    x, y = at_drawn(world, tables.corners[corner], lane)
    if far > 0.0:
        to_x, to_y = at_drawn(world, tables.corners[goal], lane)
        share = min(1.0, far / stretch(tables, world, corner, lane))
        x, y = x + (to_x - x) * share, y + (to_y - y) * share
    return x, y


def stretch(tables, world, corner, lane):
    """The length of a way from a corner to the next one."""
    x, y = at_drawn(world, tables.corners[corner], lane)
    to_x, to_y = at_drawn(world, tables.corners[tables.corners[corner].next], lane)
    return length(to_x - x, to_y - y)


def appear(tables, world, i, lane):
    """Put thing i, in the size that it begins with, in its place or somewhere."""
    thing = tables.things[i]
    size = uniform(world.random, lane, thing.first, thing.last) if thing.drawn else thing.first
    resize_thing(world.things, i, size, lane)
    if thing.is_fixed:
        x, y = place_of(world.things, i, lane)
        put_at(tables, world, i, x, y, lane)
    else:
        put(tables, world, i, lane)


def anywhere(random, left, right, below, above, lane):
    """A place drawn from a rectangle."""
    return uniform(random, lane, left, right), uniform(random, lane, below, above)


def find(tables, world, low, high, room, extent, but, lane):
    """A place for something of that half size: low..high from the robot, clear of obstacles, walls and other things.

    Along one of the axes it is at least `room` from the robot's centre; it is for thing number `but`, or, where that is
    −1, for an obstacle. A thing that the robot would be in, or would have reached as a goal, has no place there.
    Where no try succeeds the last of the best: what is nearer to the robot than it may be is worse than what meets it,
    that is worse than what stands in an obstacle, and that is worse than what covers a thing.
    """
    constants, margin, body = tables.world[0], extent + 2 * tables.world[0].radius, world.body
    left, right, below, above, zone = bounds(tables, world, extent, but, lane)
    best, best_x, best_y = 0, 0.0, 0.0
    for _ in range(MAX_TRIES):
        if left <= right:
            x, y = anywhere(world.random, left, right, below, above, lane)
        elif constants.half_x < ENDLESS_UNITS:
            room_x = max(constants.half_x - extent - 2 * constants.radius, 0.0)
            room_y = max(constants.half_y - extent - 2 * constants.radius, 0.0)
            x, y = anywhere(world.random, -room_x, room_x, -room_y, room_y, lane)
        else:
            sine, cosine = sine_cosine(uniform(world.random, lane, 0.0, 2 * np.pi))
            far = uniform(world.random, lane, low, high)
            x, y = body[X, lane] + far * cosine, body[Y, lane] + far * sine
        dx, dy = x - body[X, lane], y - body[Y, lane]
        far = length(dx, dy)
        fits = 0
        if far > low - 1e-9 and far < high + 1e-9 and max(abs(dx), abs(dy)) >= room:
            fits = 1
            if is_clear(world.boxes, x, y, margin, lane):
                fits = 3 if clear_of_things(world.things, x, y, extent, but, zone, lane) else 2
            if but < 0 or not stands_on(tables, but, 2 * extent, dx, dy):
                fits += 3
        if fits >= best:
            best, best_x, best_y = fits, x, y
        if fits == 6:
            break
    return best_x, best_y


def bounds(tables, world, extent, i, lane):
    """The rectangle in which thing i is placed, from side to side, within the arena; and the zone that it is, or −1.

    The sides are 1 and 0 where it is placed anywhere, or `i` is none.
    """
    if i < 0 or not tables.things[i].is_within:
        return 1.0, 0.0, 1.0, 0.0, -1
    thing, constants, zone = tables.things[i], tables.world[0], -1
    left, right, below, above = thing.left, thing.right, thing.below, thing.above
    if thing.insides > 0:
        zone = thing.inside
        if thing.insides > 1:
            zone += any_of(world.random, thing.insides, lane)
        x, y = place_of(world.things, zone, lane)
        half = size_of(world.things, zone, lane) / 2
        if np.isnan(x):  # it stays where it is
            x, y = place_of(world.things, i, lane)
            return x, x, y, y, -1
        left, right, below, above = x - half, x + half, y - half, y + half
    room_x, room_y = max(constants.half_x - extent, 0.0), max(constants.half_y - extent, 0.0)
    left, right = min(max(left, -room_x), room_x), max(min(right, room_x), -room_x)
    below, above = min(max(below, -room_y), room_y), max(min(above, room_y), -room_y)
    return left, right, below, above, zone


@unit
def put(tables: Tables, world: WorldState, i: int, lane: int) -> None:
    """Put thing i somewhere else: at another of its places, on a way that is drawn, or where there is room."""
    thing = tables.things[i]
    if thing.options > 0 or (thing.walker >= 0 and tables.walkers[thing.walker].is_drawn):
        x, y = place_for(tables, world, i, True, lane)
    else:
        x, y = find(tables, world, thing.low, thing.high, 0.0, size_of(world.things, i, lane) / 2, i, lane)
    put_at(tables, world, i, x, y, lane)


def put_at(tables, world, i, x, y, lane):
    """Put thing i at a place. What is loose stands straight and still there, unsettled: something may touch it."""
    put_thing(world.things, i, x, y, lane)
    loose = tables.things[i].loose
    if loose >= 0:
        world.loose[LOOSE_ROWS * loose : LOOSE_ROWS * (loose + 1), lane] = 0.0
        world.still[loose, lane], world.restless[lane] = 0, 1
    if tables.things[i].walker >= 0:
        world.direction[tables.things[i].walker, lane] = uniform(world.random, lane, 0.0, 2 * np.pi)


def succeed(tables, world, i, lane):
    """Move thing i elsewhere with the next size of its schedule, let go and not yet reached."""
    thing = tables.things[i]
    size = size_of(world.things, i, lane)
    if thing.drawn:
        size = uniform(world.random, lane, thing.first, thing.last)
    elif thing.first > thing.last:
        size = max(thing.last, size - thing.by)
    elif thing.first < thing.last:
        size = min(thing.last, size + thing.by)
    resize_thing(world.things, i, size, lane)
    forget(tables, world, i, lane)
    put(tables, world, i, lane)


def vanish(tables, world, i, lane):
    """Remove thing i for the rest of the run: a place that is NaN is in nobody's reach or way."""
    forget(tables, world, i, lane)
    put_at(tables, world, i, np.nan, np.nan, lane)


def forget(tables, world, i, home):
    """Let thing i go, and clear the bits of its being reached and delivered, by any robot of a world."""
    for lane in range(home, home + len(tables.robots)):
        world.held[lane] = -1 if world.held[lane] == i else world.held[lane]
        world.reached[i, lane], world.delivered[i, lane] = 0, 0


def clear_of_things(things, x, y, extent, but, zone, lane):
    """True if something of half size `extent` at a place would cover no thing, numbers `but` and `zone` aside."""
    for i in range(things.shape[0] // THING_ROWS):
        its_x, its_y = place_of(things, i, lane)
        gap = extent + size_of(things, i, lane) / 2
        if i != but and i != zone and abs(its_x - x) < gap and abs(its_y - y) < gap:
            return False
    return True


def stands_on(tables, i, size, dx, dy):
    """True if the robot, (dx, dy) from the middle of thing i, would be in it, or would have reached it as a goal."""
    thing, constants = tables.things[i], tables.world[0]
    is_area, is_round, is_goal = thing.is_area == 1, thing.is_round == 1, thing.is_goal == 1
    return meets_robot(is_area, is_round, is_goal, size, dx, dy, constants.radius, constants.front + constants.claw)
