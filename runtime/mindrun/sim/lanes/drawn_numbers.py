"""Numbers of a lane that are drawn: those that its task draws, and those that vary from run to run."""

import numpy as np

from mindrun.graph import draws
from mindrun.numbers.arithmetic import uniform
from mindrun.sim.codes import BETWEEN, CHOSEN, CONSTANT, DRAWN, DRAWN_WHOLE, FAILING
from mindrun.sim.parameter_rows import computed

BEFORE_THE_WORLD = np.uint64(draws.BEFORE_THE_WORLD)


def draw_numbers(tables, world, seed, lane):
    """Draw the numbers of a lane that its task draws, before its world, and from the seed alone: they move nothing."""
    world.random_aside[lane] = seed ^ BEFORE_THE_WORLD
    for i in range(len(tables.parameters)):
        row = tables.parameters[i]
        if row.form == BETWEEN:
            world.numbers[i, lane] = uniform(world.random_aside, lane, row.low, row.high)
        elif row.form == CHOSEN:
            chosen = min(int(uniform(world.random_aside, lane, 0.0, row.high)), int(row.high) - 1)
            world.numbers[i, lane] = tables.choices[row.of + chosen]


def set_numbers(tables, world, lane):
    """Draw the numbers of a lane that vary, after its world: it is the same world whatever varies in it."""
    numbers, random = world.numbers, world.random
    for i in range(len(tables.parameters)):
        row = tables.parameters[i]
        if row.form == CONSTANT:
            numbers[i, lane] = row.low
        elif row.form == DRAWN:
            numbers[i, lane] = uniform(random, lane, row.low, row.high)
        elif row.form == DRAWN_WHOLE:
            numbers[i, lane] = min(np.floor(uniform(random, lane, row.low, row.high + 1.0)), row.high)
        elif row.form == FAILING:
            numbers[i, lane] = fails_at(uniform(random, lane, 0.0, 1.0), row.low, tables.world[0].ticks)
        elif row.form < CHOSEN:  # all others are known already
            numbers[i, lane] = computed(row.form, numbers[row.of, lane], row.low)


def fails_at(chance, keep, ticks):
    """The tick in which something fails that lasts through each with a probability of `keep`; `chance` is in 0..1."""
    tick, left = 0, keep
    while left > chance and tick < ticks:
        left *= keep
        tick += 1
    return tick
