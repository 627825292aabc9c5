"""Ticks of all lanes: the stages in their order, in two halves, between which procedures may run in Python."""

from mindrun.numbers.arithmetic import *
from mindrun.sim.codes import GOING_ON, Tables
from mindrun.sim.lanes.act import act, recall
from mindrun.sim.lanes.judge import begin_measures, judge
from mindrun.sim.lanes.runs import end
from mindrun.sim.lanes.sense import sense
from mindrun.sim.lanes.solid import is_lost
from mindrun.sim.lanes.step import step
from mindrun.sim.lanes.think import begin, think
from mindrun.sim.state import FAILED_SKILL, Jobs, State, recorded
from mindrun.sim.units import seldom, unit, unit_where


@unit
def advance(tables: Tables, state: State, jobs: Jobs, ticks: int, interrupt: int) -> None:
    """Run all lanes for so many ticks, until every job is done, or until a procedure fails."""
    for _ in range(ticks):
        if jobs.lanes[0] == 0:
            break
        before(tables, state, jobs)
        think(tables, state, jobs.lanes[0], 0, len(tables.skills))
        if state.run.failed[FAILED_SKILL] >= 0:
            break
        after(tables, state, jobs, interrupt)


@unit
def before(tables: Tables, state: State, jobs: Jobs) -> None:
    """Make the first half of a tick: sense, and the master's influence."""
    sense(tables, state, jobs.lanes[0], jobs.clock[0])
    begin(tables, state.mind, jobs.lanes[0])


@unit
def after(tables: Tables, state: State, jobs: Jobs, interrupt: int) -> None:
    """Make the second half of a tick: act, step, judge, recall."""
    lanes, world = jobs.lanes[0], state.world
    act(tables, state, lanes)
    for lane in range(lanes):
        world.begun_at[X, lane], world.begun_at[Y, lane] = middle_of(world.body, lane)
    begin_measures(tables, state, lanes)
    step(tables, state, lanes)
    conclude(tables, state, jobs, interrupt)


@unit
def conclude(tables: Tables, state: State, jobs: Jobs, interrupt: int) -> None:
    """Judge a step, record it where there is room, and recall; then end the runs that are over."""
    lanes, clock, world = jobs.lanes[0], jobs.clock[0], state.world
    judge(tables, state, lanes, clock, interrupt)
    record(tables, state, jobs)
    recall(tables, state, lanes)
    for row in range(len(tables.actuators)):
        for lane in range(lanes):
            state.judge.last_commands[row, lane] = state.mind.commands[row, lane]
    jobs.clock[0] = clock + 1
    over, ticks, ended = 0, jobs.most[0], state.run.ended
    for lane in range(lanes):
        over += is_lost(world.body, lane) | (ended[lane] != GOING_ON) | (world.tick[lane] >= ticks)
    robots = len(tables.robots)
    for k in range(lanes // robots if over > 0 else 0):
        end(tables, state, jobs, lanes - robots * (k + 1))


@unit_where(seldom)
def record(tables: Tables, state: State, jobs: Jobs) -> None:
    """Write a row of what the world and the mind of the watched robot are after a tick, where there is room for one.

    Before the memory cells recall: a row has them as the skills read them.
    """
    if jobs.recorded[0] == len(jobs.singles):
        return
    wide, narrow = recorded(state)
    row, lane = jobs.doubles[jobs.recorded[0]], jobs.watched[0]
    at = 0
    for rows in wide:
        at = copy(rows, row, at, lane)
    row[at], row[at + 1], row[at + 2] = (
        state.world.held[lane],
        state.world.battery[lane],
        state.contact.touching[lane] & 1,
    )
    add_robots(tables, state.world, row, at + 3, lane)
    at = 0
    for rows in narrow:
        at = copy(rows, jobs.singles[jobs.recorded[0]], at, lane)
    jobs.recorded[0] += 1


def copy(rows, target, at, lane):
    """Copy a lane of all rows into `target` from `at` on; return where the next ones begin."""
    for row in range(len(rows)):
        target[at + row] = rows[row, lane]
    return at + len(rows)


def add_robots(tables, world, row, at, lane):
    """Write the angle of each robot, and where what another one holds is, which is nowhere in the lane's own world."""
    for other in range(len(tables.robots)):
        row[at + other] = world.body[ANGLE, other]
        if other != lane and world.held[other] >= 0:
            place = len(world.body) + THING_ROWS * world.held[other]
            row[place + X], row[place + Y] = place_of(world.things, world.held[other], other)
