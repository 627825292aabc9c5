"""Several robots in one world: each has a lane, neighbours of which the first has the things, and the rest copies."""

import numpy as np

from mindrun.numbers.arithmetic import *
from mindrun.sim.codes import PERSISTENCE_TICKS, SIGNAL, Tables
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
    """Let Chipmunk make the tick of all robots of a world where it makes that of any, or two of them could touch.

    Where one leaves all places, all of them fly.
    """
    near, robots, body = contact.near, len(tables.robots), world.body
    for home in range(0, lanes, robots):
        most, is_swift, are_there = 0, 0, True
        for lane in range(home, home + robots):
            x, y = next_middle(body, tables.world[0].dt, lane)
            are_there = are_there and within(x, y, body[ANGLE, lane] + body[SPIN, lane] * tables.world[0].dt)
            contact.mates[1, lane], contact.mates[0, lane] = contact.mates[0, lane], 0
            most, is_swift = max(most, near[lane]), max(is_swift, contact.swift[lane])
            for other in range(home, lane):
                its_x, its_y = next_middle(body, tables.world[0].dt, other)
                gap = reach_of(tables, world, lane) + reach_of(tables, world, other) + CONTACT_MARGIN_UNITS
                if (its_x - x) ** 2 + (its_y - y) ** 2 < gap * gap:
                    most = CONTACT_TICKS
        for lane in range(home, home + robots):
            near[lane], contact.swift[lane] = most if are_there else 0, is_swift


@OF_SEVERAL
def share(tables: Tables, world: WorldState, lanes: int) -> None:
    """Let the robots of each world have the same things, each but what others hold, and each other among them."""
    for home in range(0, lanes, len(tables.robots)):
        share_world(tables, world, home)


def share_world(tables, world, home):
    """Let the robots of a world have the same things, each but what others hold, and each other among them."""
    end, held = home + len(tables.robots), world.held
    for lane in range(home + 1, end):
        share_things(tables, world, home, lane)
    for lane in range(home, end):
        for other in range(home, end if held[lane] >= 0 else home):
            if other != lane:
                put_thing(world.things, held[lane], np.nan, np.nan, other)
    for number in range(end - home):
        (x, y), thing = middle_of(world.body, home + number), tables.robots[number].thing
        for lane in range(home, end if thing >= 0 else home):
            is_itself = lane == home + number
            put_thing(world.things, thing, np.nan if is_itself else x, np.nan if is_itself else y, lane)
            for i in range(len(tables.actuators)):
                if tables.actuators[i].kind == SIGNAL:
                    world.said[number, lane] = world.acting[i, home + number]


def share_things(tables, world, home, lane):
    """Copy the things of a world's first lane to another of its lanes, but for what is held there."""
    for i in range(len(tables.things)):
        if world.held[lane] != i:
            x, y = place_of(world.things, i, home)
            put_thing(world.things, i, x, y, lane)
            resize_thing(world.things, i, size_of(world.things, i, home), lane)
    for row in range(len(world.loose)):
        world.loose[row, lane] = world.loose[row, home]
    for row in range(len(world.direction)):
        world.direction[row, lane] = world.direction[row, home]
