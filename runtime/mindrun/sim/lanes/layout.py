"""The layout of a world as a run begins: its obstacles, its robots, and its things."""

import numpy as np

from mindrun.numbers.arithmetic import *
from mindrun.sim.codes import FAR, OTHER_ROBOT, Tables
from mindrun.sim.lanes.placement import (
    ENDLESS_UNITS,
    MAX_TRIES,
    OF_SEVERAL,
    any_of,
    anywhere,
    appear,
    at_drawn,
    find,
    place_for,
    stands_on,
)
from mindrun.sim.lanes.solid import count_of, is_clear, put_box
from mindrun.sim.state import WorldState
from mindrun.sim.units import unit


@unit
def draw(tables: Tables, world: WorldState, lane: int) -> None:
    """Draw a world into a lane: obstacles with a place, the robot, things with a place, other obstacles, other things.

    Of each the first in the source come first.
    """
    boxes, walls, box = world.boxes[lane], tables.walls, len(tables.walls)
    for b in range(count_of(world.boxes)):
        put_box(boxes, b, FAR, FAR, 0.0, 0.0)
    for b in range(len(walls)):
        put_box(boxes, b, walls[b, X], walls[b, Y], walls[b, HALF_X], walls[b, HALF_Y])
    world.things[:, lane] = FAR
    for i in range(len(tables.obstacles)):
        box = draw_grid(tables, world, tables.obstacles[i], box, lane)
    for i in range(len(tables.things)):
        if tables.things[i].is_fixed:  # of what is within another thing nobody knows yet
            x, y = place_for(tables, world, i, False, lane)
            put_thing(world.things, i, x, y, lane)
    start(tables, world, lane)
    if len(tables.robots) > 1:
        start_mates(tables, world, lane)
    elif tables.robots[0].thing >= 0:  # nobody is there whom it could be a thing to
        put_thing(world.things, tables.robots[0].thing, np.nan, np.nan, lane)
    for i in range(len(tables.things)):
        if tables.things[i].is_fixed and tables.things[i].kind != OTHER_ROBOT:
            appear(tables, world, i, lane)
    for i in range(len(tables.obstacles)):
        obstacle = tables.obstacles[i]
        for _ in range(obstacle.count):
            size = uniform(world.random, lane, obstacle.first, obstacle.last)
            room = size / 2 + 3 * tables.world[0].radius
            x, y = find(tables, world, obstacle.low, obstacle.high, room, size / 2, -1, lane)
            put_box(boxes, box, x, y, size / 2, size / 2)
            box += 1
    for is_within in range(2):
        for i in range(len(tables.things)):
            thing = tables.things[i]
            if not thing.is_fixed and thing.is_within == is_within and thing.kind != OTHER_ROBOT:
                appear(tables, world, i, lane)


def draw_grid(tables, world, obstacle, box, lane):
    """Put an obstacle at each crossing of the grid, a little off it; return the number of the next box."""
    random, jitter = world.random, obstacle.jitter
    middle_x, middle_y = (obstacle.columns - 1) / 2, (obstacle.rows - 1) / 2
    from_x, from_y = at_drawn(world, obstacle, lane)
    if obstacle.options > 0:
        option = obstacle.option + any_of(random, obstacle.options, lane)
        from_x, from_y = tables.options[option, X], tables.options[option, Y]
    for row in range(obstacle.rows):
        for column in range(obstacle.columns):
            x = from_x + (column - middle_x) * obstacle.grid + uniform(random, lane, -jitter, jitter)
            y = from_y + (row - middle_y) * obstacle.grid + uniform(random, lane, -jitter, jitter)
            size = uniform(random, lane, obstacle.first, obstacle.last)
            put_box(world.boxes[lane], box, x, y, size / 2, size / 2)
            box += 1
    return box


def start(tables, world, lane):
    """Put the robot at rest where its task says, in the origin of a plain scene, or anywhere clear in an arena.

    Clear by its own width all around, and on no goal; where no try succeeds, the last of the best: touching something
    solid is worse than a goal, and that is worse than being near to something.
    """
    body, constants = world.body, tables.world[0]
    body[:, lane] = 0.0
    if constants.is_placed:
        body[X, lane], body[Y, lane] = constants.start_x, constants.start_y
    elif constants.half_x < ENDLESS_UNITS:
        start_anywhere(tables, world, lane)
    face(tables, world, lane)


def face(tables, world, lane):
    """Let the robot of a lane face where its task says, or anywhere."""
    constants = tables.world[0]
    angle = constants.facing if constants.is_faced else uniform(world.random, lane, 0.0, 2 * np.pi)
    world.body[ANGLE, lane] = angle


def start_anywhere(tables, world, lane):
    """Put the robot of a lane anywhere clear in its arena."""
    body, random, constants, radius = world.body, world.random, tables.world[0], tables.world[0].radius
    room_x, room_y = start_room(constants.half_x, radius), start_room(constants.half_y, radius)
    best = 0
    for _ in range(MAX_TRIES):
        x, y = anywhere(random, -room_x, room_x, -room_y, room_y, lane)
        fits = 0
        if clear_of_all(tables, world, x, y, radius, lane):
            fits = 1
            if is_open(tables, world, x, y, lane):
                fits = 3 if clear_of_all(tables, world, x, y, 3 * radius, lane) else 2
        if fits >= best:
            best, body[X, lane], body[Y, lane] = fits, x, y
        if fits == 3:
            break


@OF_SEVERAL
def start_mates(tables: Tables, world: WorldState, home: int) -> None:
    """Put the other robots of a world where they begin, one after the other, each drawn by itself.

    In its own lane each has a copy of the world so far, with the robots before it.
    """
    constants, things, first = tables.world[0], world.things, tables.robots[0].thing
    if first >= 0:
        put_thing(things, first, world.body[X, home], world.body[Y, home], home)
        resize_thing(things, first, 2 * constants.radius, home)
    for number in range(1, len(tables.robots)):
        lane, mate = home + number, tables.robots[number].thing
        for column in range(world.boxes.shape[1]):
            world.boxes[lane, column] = world.boxes[home, column]
        for row in range(things.shape[0]):
            things[row, lane] = things[row, home]
        start_mate(tables, world, mate, home, lane)
        put_thing(things, mate, world.body[X, lane], world.body[Y, lane], home)
        resize_thing(things, mate, 2 * constants.radius, home)


def start_mate(tables, world, mate, home, lane):
    """Put the robot of a lane at the place of its thing, around the first one, or anywhere clear in an arena."""
    thing, body, constants = tables.things[mate], world.body, tables.world[0]
    body[:, lane] = 0.0
    if thing.is_fixed:
        body[X, lane], body[Y, lane] = place_of(world.things, mate, home)
    elif thing.high < ENDLESS_UNITS:  # it says how far away, or the scene does
        body[X, lane], body[Y, lane] = middle_of(body, home)  # from where distances count
        low = max(thing.low, 4 * constants.radius)
        x, y = find(tables, world, low, max(thing.high, low), 0.0, constants.radius, mate, lane)
        body[X, lane], body[Y, lane] = x, y
    else:
        start_anywhere(tables, world, lane)
    face(tables, world, lane)


def start_room(half, radius):
    """The distance from an arena's middle at which the robot may begin: its width from the border, if there is room."""
    return half - 3 * radius if half > 3 * radius else max(half - radius, 0.0)


@OF_SEVERAL
def clear_of_robots(tables: Tables, world: WorldState, x: float, y: float, gap: float, lane: int) -> int:
    """True if no robot that has begun, or has a place, is nearer than `gap` to a point along both axes."""
    number = lane % len(tables.robots)
    for other in range(len(tables.robots)):
        thing = tables.robots[other].thing
        if other < number:
            its_x, its_y = middle_of(world.body, lane - number + other)
        elif other > number and tables.things[thing].is_fixed:
            its_x, its_y = place_of(world.things, thing, lane)
        else:
            continue
        if abs(its_x - x) < gap and abs(its_y - y) < gap:
            return False
    return True


def clear_of_all(tables, world, x, y, margin, lane):
    """True if no obstacle, and no box or ball with a place of its own, comes within `margin` of a point."""
    if not is_clear(world.boxes, x, y, margin, lane):
        return False
    for i in range(len(tables.loose)):
        thing = tables.things[tables.loose[i].thing]
        gap = max(thing.first, thing.last) / 2 + margin
        its_x, its_y = place_of(world.things, tables.loose[i].thing, lane)
        if thing.is_fixed and abs(its_x - x) < gap and abs(its_y - y) < gap:
            return False
    return len(tables.robots) == 1 or clear_of_robots(tables, world, x, y, tables.world[0].radius + margin, lane)


def is_open(tables, world, x, y, lane):
    """True if nothing with a place of its own keeps a robot from beginning at a point."""
    for i in range(len(tables.things)):
        thing = tables.things[i]
        size = max(thing.first, thing.last) if thing.drawn else thing.first
        its_x, its_y = place_of(world.things, i, lane)
        if thing.is_fixed and stands_on(tables, i, size, its_x - x, its_y - y):
            return False
    return True
