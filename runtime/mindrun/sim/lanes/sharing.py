"""Several robots in one world: each has a lane, neighbours of which the first has the things, and the rest copies."""

import numpy as np

from mindrun.numbers.arithmetic import *
from mindrun.sim.codes import OTHER_ROBOT, PERSISTENCE_TICKS, SIGNAL, Tables
from mindrun.sim.lanes.placement import OF_SEVERAL
from mindrun.sim.lanes.solid import reach_of, within
from mindrun.sim.state import ContactState, WorldState

CONTACT_MARGIN_UNITS = 0.01  # beyond the rounding of any distance here
CONTACT_TICKS = PERSISTENCE_TICKS + 2  # for which Chipmunk goes on with a world in which something could have touched


def is_paid(tables, number):
    """True if what happens to the robot with a number counts."""
    return tables.robots[number].paid == 1


@OF_SEVERAL
def join(tables: Tables, world: WorldState, contact: ContactState, lanes: int) -> None:
    """Let Chipmunk make the tick of two robots that could touch. Where one leaves all places, all of its world fly."""
    near, robots, dt = contact.near, len(tables.robots), tables.world[0].dt
    for home in range(0, lanes, robots):
        are_there = True
        for lane in range(home, home + robots):
            contact.mates[1, lane], contact.mates[0, lane] = contact.mates[0, lane], 0
            x, y = next_middle(world.body, dt, lane)
            are_there = are_there and within(x, y, world.body[ANGLE, lane] + world.body[SPIN, lane] * dt)
            reach = reach_of(tables, world, lane) + CONTACT_MARGIN_UNITS
            for other in range(home, lane):
                its_x, its_y = next_middle(world.body, dt, other)
                dx, dy = its_x - x, its_y - y
                gap = reach + (tables.world[0].radius if world.held[other] < 0 else reach_of(tables, world, other))
                if dx * dx + dy * dy < gap * gap:
                    near[lane], near[other] = CONTACT_TICKS, CONTACT_TICKS
        contact.swift[home] = contact.swift[home] if are_there else 0
        for lane in range(home, home if are_there else home + robots):
            near[lane] = 0


@OF_SEVERAL
def share(tables: Tables, world: WorldState, lanes: int) -> None:
    """Let the robots of each world have the same things, each but what others hold, and each other among them."""
    for home in range(0, lanes, len(tables.robots)):
        share_world(tables, world, home)


def share_world(tables, world, home):
    """Let the robots of a world have the same things, each but what others hold, and each other among them."""
    end, held, things = home + len(tables.robots), world.held, world.things
    for i in range(len(tables.things)):
        (x, y), size = place_of(things, i, home), size_of(things, i, home)
        for lane in range(home + 1, end if tables.things[i].kind != OTHER_ROBOT else home):
            if held[lane] != i:
                put_thing(things, i, x, y, lane)
                resize_thing(things, i, size, lane)
    for lane in range(home, end):
        for other in range(home, end if held[lane] >= 0 else home):
            if other != lane:
                put_thing(things, held[lane], np.nan, np.nan, other)
    for number in range(end - home):
        show_robot(tables, world, number, home, end)
    for rows in (world.loose, world.direction):
        for row in range(len(rows) if len(tables.loose) + len(tables.walkers) > 0 else 0):
            for lane in range(home + 1, end):
                rows[row, lane] = rows[row, home]


def show_robot(tables, world, number, home, end):
    """Let the other robots of a world, in the lanes home to end, see and hear the one with a number."""
    (x, y), thing, own = middle_of(world.body, home + number), tables.robots[number].thing, home + number
    for lane in range(home, end if thing >= 0 else home):
        put_thing(world.things, thing, x, y, lane)
    if thing >= 0:
        put_thing(world.things, thing, np.nan, np.nan, own)
    for i in range(len(tables.actuators)):
        for lane in range(home, end if tables.actuators[i].kind == SIGNAL else home):
            world.said[number, lane] = world.acting[i, own]
