"""The numbers of a run: what varies is drawn, and so is when what fails does."""

import numpy as np

from mindrun.sim.codes import CONSTANT, DAMPING, DRAWN, DRAWN_WHOLE, FAILING, INVERSE, OVER
from mindrun.sim.compiling import compiled
from mindrun.sim.lanes.placement import uniform


@compiled
def set_numbers(tables, world, lane):
    """The numbers of a lane whose world has been drawn: it is the same world whatever varies in it."""
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
        else:
            numbers[i, lane] = computed(row.form, numbers[row.of, lane], row.low)


@compiled
def computed(form, x, by):
    """One of the steps of `parameter_rows`."""
    if form == DAMPING:
        return 1.0 / (1.0 + by * x)
    if form == INVERSE:
        return by / x
    return x / by if form == OVER else x * by


@compiled
def fails_at(chance, keep, ticks):
    """The tick in which something fails that lasts through each with a probability of `keep`; `chance` is in 0..1."""
    tick, left = 0, keep
    while left > chance and tick < ticks:
        left *= keep
        tick += 1
    return tick
