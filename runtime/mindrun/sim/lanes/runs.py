"""Runs in lanes: one begins in a lane, and when it is over the next one does, or the last lane moves there."""

import numpy as np

from mindrun.graph import draws
from mindrun.kinds.sensors.motion import TRAIL_TICKS
from mindrun.numbers.arithmetic import *
from mindrun.sim import codes
from mindrun.sim.codes import Tables
from mindrun.sim.lanes.judge import patch_of
from mindrun.sim.lanes.layout import draw
from mindrun.sim.lanes.placement import OF_SEVERAL, any_of, vanish
from mindrun.sim.lanes.reaching import begin_inside
from mindrun.sim.lanes.sharing import is_paid, share_world
from mindrun.sim.lanes.solid import is_lost, remove_box
from mindrun.sim.lanes.think import run_program
from mindrun.sim.parameter_rows import computed
from mindrun.sim.state import PLACE_ROWS, Jobs, State, WorldState
from mindrun.sim.units import unit, unit_where

BEFORE_THE_WORLD = np.uint64(draws.BEFORE_THE_WORLD)
BETWEEN_ROBOTS = np.uint64(0xA0761D6478BD642F)
MEASURED_ASIDE = np.uint64(0xD1B54A32D192ED03)  # what no skill reads draws from a generator of its own


@unit
def fill(tables: Tables, state: State, jobs: Jobs, lanes: int) -> None:
    """Begin as many jobs as there are lanes for: each has one for every robot of its world."""
    robots = len(tables.robots)
    for home in range(0, lanes, robots):
        if not begin_job(tables, state, jobs, home):
            break
        jobs.lanes[0] = home + robots


@unit
def end(tables: Tables, state: State, jobs: Jobs, home: int) -> None:
    """Write the run of a world down where it is over, and begin the next one, or move the last world to its place."""
    run, robots = state.run, len(tables.robots)
    for lane in range(home, home + robots):
        if is_lost(state.world.body, lane):
            run.faults[lane] += 1
            run.ended[home] = codes.LOST
    if run.ended[home] != codes.GOING_ON or state.world.tick[home] >= jobs.most[0]:
        finish(tables, state, jobs, home)
        if not begin_job(tables, state, jobs, home):
            last = jobs.lanes[0] - robots
            for number in range(robots if home != last else 0):
                move(state, last + number, home + number)
            jobs.lanes[0] = last


@unit
def begin_job(tables: Tables, state: State, jobs: Jobs, home: int) -> int:
    """Begin the next job in a world, whose first lane is given; False where there is none."""
    job, world, mind = jobs.next[0], state.world, state.mind
    if job >= len(jobs.genome):
        return False
    jobs.next[0] = job + 1
    for number in range(len(tables.robots)):
        world.seed[home + number] = jobs.seeds[jobs.seed[job]]
        world.random[home + number] = of_robot(jobs.seeds[jobs.seed[job]], number)
    draw_numbers(tables, world, world.random[home], home)
    if len(tables.makings) > 0:
        make_numbers(tables, state, home)
    world.random_aside[home] = world.random[home] ^ MEASURED_ASIDE
    draw(tables, world, home)
    set_numbers(tables, world, home)
    if len(tables.presences) > 0:
        leave_out(tables, state, home)
    if len(tables.robots) > 1:
        copy_world(tables, world, home)
    genome = jobs.genomes[jobs.genome[job]]
    for lane in range(home, home + len(tables.robots)):
        state.run.job[lane] = job
        for i in range(len(genome)):
            mind.genome[i, lane] = genome[i]
        reset(tables, state, lane)
    if len(tables.robots) > 1:
        share_world(tables, world, home)
        world.said[:, home : home + len(tables.robots)] = ZERO
    return True


def of_robot(seed, number):
    """The seed of the generator of the robot with a number: that of the run for the first, others far from it."""
    return seed + np.uint64(number) * BETWEEN_ROBOTS


@OF_SEVERAL
def copy_world(tables: Tables, world: WorldState, home: int) -> None:
    """Give the other robots of a world its boxes and its numbers, and generators of their own."""
    for lane in range(home + 1, home + len(tables.robots)):
        copy_row(world.boxes, home, lane)
        copy_lane(world.numbers, home, lane)
        copy_lane(world.things, home, lane)
        world.random_aside[lane] = world.random[lane] ^ MEASURED_ASIDE
        world.restless[lane] = 0


def draw_numbers(tables, world, seed, lane):
    """Draw the numbers of a lane that its task draws, before its world, and from the seed alone: they move nothing."""
    world.random_aside[lane] = seed ^ BEFORE_THE_WORLD
    for i in range(len(tables.parameters)):
        row = tables.parameters[i]
        if row.form == codes.BETWEEN:
            world.numbers[i, lane] = uniform(world.random_aside, lane, row.low, row.high)
        elif row.form == codes.CHOSEN:
            world.numbers[i, lane] = tables.choices[row.of + any_of(world.random_aside, int(row.high), lane)]


def set_numbers(tables, world, lane):
    """Draw the numbers of a lane that vary, after its world: it is the same world whatever varies in it."""
    numbers, random = world.numbers, world.random
    for i in range(len(tables.parameters)):
        row = tables.parameters[i]
        if row.form == codes.CONSTANT:
            numbers[i, lane] = row.low
        elif row.form == codes.DRAWN:
            numbers[i, lane] = uniform(random, lane, row.low, row.high)
        elif row.form == codes.DRAWN_WHOLE:
            numbers[i, lane] = min(np.floor(uniform(random, lane, row.low, row.high + 1.0)), row.high)
        elif row.form == codes.FAILING:
            numbers[i, lane] = fails_at(uniform(random, lane, 0.0, 1.0), row.low, tables.world[0].ticks)
        elif row.form < codes.CHOSEN:  # all others are known already
            numbers[i, lane] = computed(row.form, numbers[row.of, lane], row.low)


def fails_at(chance, keep, ticks):
    """The tick in which something fails that lasts through each with a probability of `keep`; `chance` is in 0..1."""
    tick, left = 0, keep
    while left > chance and tick < ticks:
        left *= keep
        tick += 1
    return tick


@unit_where(lambda tables: len(tables.makings) > 0)
def make_numbers(tables: Tables, state: State, lane: int) -> None:
    """Compute the numbers of a lane that are made of those that its task draws."""
    for i in range(len(tables.makings)):
        making = tables.makings[i]
        state.world.numbers[making.row, lane] = of_drawn(tables, state, making.code, making.length, lane)


@unit_where(lambda tables: len(tables.presences) > 0)
def leave_out(tables: Tables, state: State, lane: int) -> None:
    """Remove the things and boxes of a lane that are not there in its run."""
    for i in range(len(tables.presences)):
        presence = tables.presences[i]
        if not of_drawn(tables, state, presence.when, presence.whens, lane) > 0.0:
            if presence.thing >= 0:
                vanish(tables, state.world, presence.thing, lane)
            for b in range(presence.box, presence.box + presence.boxes):
                remove_box(state.world.boxes[lane], b)


def of_drawn(tables, state, code, length, lane):
    """The value of a program of what the task of a lane draws, when its run begins."""
    for i in range(len(tables.measures)):
        if tables.measures[i].kind == codes.DRAWN_NUMBER:
            state.judge.measures[i, lane] = state.world.numbers[tables.measures[i].row, lane]
    state.mind.active[0] = lane
    run_program(tables, state, code, length, 0, 1, False)
    return state.mind.stack[0, 0]


def reset(tables, state, lane):
    """Set all of a lane but its world, its genome and its generator to the beginning of a run."""
    world, mind, judge, run = state.world, state.mind, state.judge, state.run
    world.held[lane], world.tick[lane], world.battery[lane] = -1, 0, tables.world[0].start
    world.heading[SINE, lane], world.heading[COSINE, lane] = sine_cosine(world.body[ANGLE, lane])
    world.reached[:, lane], world.delivered[:, lane] = 0, 0
    for place in range(0, PLACE_ROWS * TRAIL_TICKS, PLACE_ROWS):
        world.trail[place + X, lane], world.trail[place + Y, lane] = middle_of(world.body, lane)
    mind.recurrent[:, lane] = 0.0
    for i in range(len(tables.actuators)):
        actuator = tables.actuators[i]
        judge.last_commands[i, lane] = actuator.neutral
        if actuator.kind == codes.SERVO:
            world.swivel[i, lane] = (1.0 - 2.0 * actuator.neutral) * world.numbers[actuator.turn, lane]
        for k in range(actuator.delay):
            mind.late[actuator.ring + k, lane] = actuator.neutral
    for i in range(len(tables.memories)):
        for k in range(tables.memories[i].kept):
            mind.readings[tables.memories[i].row + k, lane] = tables.memories[i].start
    judge.lines[:, lane], judge.left_changes[:, lane], judge.right_changes[:, lane] = 0.0, 0.0, 0.0
    judge.tallies[:, lane], judge.stretches[:, lane] = 0.0, 0.0
    judge.counts[:, lane], judge.visited[lane], judge.arrived[:, lane], judge.left[:, lane] = 0, 0, 0, 0
    for i in range(len(tables.events)):
        if tables.events[i].kind == codes.VISIT:  # the patch that the robot starts in
            patch = patch_of(world.body, tables.world[0], tables.events[i], lane)
            judge.visited[lane, tables.events[i].board + patch] = 1
        elif tables.events[i].kind == codes.LEAVE:
            begin_inside(tables, state, i, lane)
    state.sight.anchor[:, lane] = np.nan
    state.contact.near[lane], state.contact.touching[lane], state.contact.mates[:, lane] = 0, 0, 0
    state.contact.space[lane].seconds = 0.0
    run.ended[lane], run.met[lane], run.faults[lane] = codes.GOING_ON, codes.GOING_ON, 0


def finish(tables, state, jobs, home):
    """Write down what came of the job of a world: the mean of what its robots are paid, the sum of what happened.

    What is common to all of them has happened once.
    """
    judge, run, robots = state.judge, state.run, len(tables.robots)
    job = run.job[home]
    jobs.lines[job, : len(tables.rewards)], jobs.counts[job, : len(tables.events)], jobs.faults[job] = 0.0, 0, 0
    for number in range(robots):
        lane = home + number
        for i in range(len(tables.rewards) if is_paid(tables, number) else 0):
            jobs.lines[job, i] += judge.lines[i, lane]
        for i in range(len(tables.events)):
            jobs.counts[job, i] += judge.counts[i, lane] if lane == home or not tables.events[i].is_common else 0
        jobs.faults[job] += run.faults[lane]
        run.job[lane] = -1
    for i in range(len(tables.rewards) if robots > 1 else 0):
        jobs.lines[job, i] /= tables.world[0].paid
    jobs.ticks[job], jobs.ended[job], jobs.met[job] = state.world.tick[home], run.ended[home], run.met[home]


def move(state, source, target):
    """Move a lane to the place of one whose run is over, but for what is of this tick."""
    world, mind, sight, judge = state.world, state.mind, state.sight, state.judge
    contact, run = state.contact, state.run
    for rows in (
        world.body, world.heading, world.things, world.trail, world.loose, world.numbers, world.direction,
        world.swivel, sight.nearby, sight.anchor, judge.left_changes, judge.right_changes, judge.lines,
        judge.tallies, judge.stretches,
    ):  # fmt: skip
        copy_lane(rows, source, target)
    for rows in (world.reached, world.delivered, judge.arrived):
        copy_lane(rows, source, target)
    for rows in (world.still, world.goal, judge.counts, judge.left, contact.mates):
        copy_lane(rows, source, target)
    for rows in (
        mind.readings, mind.before, mind.measured, mind.rings, mind.genome, mind.recurrent, mind.late, mind.commands,
        mind.influence, judge.last_commands,
    ):  # fmt: skip
        copy_lane(rows, source, target)
    copy_row(world.boxes, source, target)
    copy_row(judge.visited, source, target)
    copy_row(contact.solids, source, target)
    copy_row(contact.pairs, source, target)
    copy_row(contact.order, source, target)
    contact.space[target] = contact.space[source]
    for numbers in (
        world.restless, world.held, world.tick, sight.nearby_count, contact.near, contact.touching, run.job, run.ended,
        run.met, run.faults,
    ):  # fmt: skip
        numbers[target] = numbers[source]
    for numbers in (world.battery, contact.last):
        numbers[target] = numbers[source]
    for numbers in (world.random, world.random_aside, world.seed):
        numbers[target] = numbers[source]


def copy_lane(rows, source, target):
    """Copy one lane of rows [row, lane] to another."""
    for i in range(rows.shape[0]):
        rows[i, target] = rows[i, source]


def copy_row(columns, source, target):
    """Copy one lane of columns [lane, column] to another."""
    for i in range(columns.shape[1]):
        columns[target, i] = columns[source, i]


@unit
def begin_again(tables: Tables, state: State, jobs: Jobs, lane: int) -> None:
    """End the run of a world, and begin there the job with the number of the world; its first lane is given."""
    finish(tables, state, jobs, lane)
    jobs.next[0] = lane // len(tables.robots)
    begin_job(tables, state, jobs, lane)
