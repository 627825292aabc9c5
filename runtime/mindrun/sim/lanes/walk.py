"""Walk: one tick of what moves by itself. It touches nothing, so that plain arithmetic is all there is to it."""

import numpy as np

from mindrun.numbers.arithmetic import SIZE, THING_ROWS, X, Y
from mindrun.sim.arithmetic import sine_cosine
from mindrun.sim.compiling import compiled
from mindrun.sim.lanes.clear_places import clear
from mindrun.sim.lanes.placement import uniform
from mindrun.sim.lanes.places import within
from mindrun.sim.lanes.solid import CLOSED_UNITS, is_barred


@compiled
def walk(tables, world, lanes):
    """Every walker that has not vanished takes its step."""
    for i in range(len(tables.walkers)):
        place = THING_ROWS * tables.walkers[i].thing
        for lane in range(lanes):
            if np.isnan(world.things[place + X, lane]):
                continue
            if tables.walkers[i].places > 0:
                go_along(tables, world, i, place, lane)
            else:
                wander(tables, world, i, place, lane)


@compiled
def wander(tables, world, i, place, lane):
    """A step ahead, and its direction drifts; where that is not free it stands, and faces anywhere."""
    sine, cosine = sine_cosine(world.direction[i, lane])
    x, y = world.things[place + X, lane], world.things[place + Y, lane]
    step, half = tables.walkers[i].step, world.things[place + SIZE, lane] / 2
    to_x, to_y = x + cosine * step, y + sine * step
    if may_step(tables, world, step, x, y, to_x, to_y, half, lane):
        world.things[place + X, lane], world.things[place + Y, lane] = to_x, to_y
        turn = tables.walkers[i].turn
        world.direction[i, lane] += uniform(world.random, lane, -turn, turn)
    else:
        world.direction[i, lane] = uniform(world.random, lane, 0.0, 2 * np.pi)


@compiled
def may_step(tables, world, step, x, y, to_x, to_y, half, lane):
    """Whether nothing is in the way of a square of that half side; of its middle alone where it has no room already.

    What steps by no more than a quarter of its side passes nothing where it arrives free.
    """
    boxes, constants = world.boxes, tables.world[0]
    if not is_free(tables, world, x, y, half, lane):
        return not is_barred(boxes, constants, x, y, to_x, to_y, CLOSED_UNITS, lane)
    if not is_free(tables, world, to_x, to_y, half, lane):
        return False
    return step <= half / 2 or not is_barred(boxes, constants, x, y, to_x, to_y, half, lane)


@compiled
def is_free(tables, world, x, y, half, lane):
    """Whether a square of that half side around a point meets no wall and no obstacle."""
    inside = tables.world[0].half_x - abs(x) >= half and tables.world[0].half_y - abs(y) >= half
    return inside and within(x, y, 0.0) and clear(world.boxes, x, y, half, lane)


@compiled
def go_along(tables, world, i, place, lane):
    """A step towards the next place of its way; where it would come past that it stops there for this tick."""
    walker = tables.walkers[i]
    goal = walker.first + world.goal[i, lane]
    dx = tables.ways[goal, X] - world.things[place + X, lane]
    dy = tables.ways[goal, Y] - world.things[place + Y, lane]
    far = np.sqrt(dx * dx + dy * dy)
    if far <= walker.step:
        world.things[place + X, lane], world.things[place + Y, lane] = tables.ways[goal, X], tables.ways[goal, Y]
        world.goal[i, lane] = (world.goal[i, lane] + 1) % walker.places
    else:
        share = walker.step / far
        world.things[place + X, lane] += dx * share
        world.things[place + Y, lane] += dy * share
