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
    record(state, jobs)
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
def record(state: State, jobs: Jobs) -> None:
    """Write a row of what the first lane's world and mind are after a tick, where there is room for one.

    Before the memory cells recall: a row has them as the skills read them.
    """
    if jobs.recorded[0] == len(jobs.singles):
        return
    wide, narrow = recorded(state)
    row = jobs.doubles[jobs.recorded[0]]
    at = 0
    for rows in wide:
        at = copy(rows, row, at)
    row[at], row[at + 1], row[at + 2] = state.world.held[0], state.world.battery[0], state.contact.touching[0] & 1
    at = 0
    for rows in narrow:
        at = copy(rows, jobs.singles[jobs.recorded[0]], at)
    jobs.recorded[0] += 1


def copy(rows, target, at):
    """Copy the first lane of all rows into `target` from `at` on; return where the next ones begin."""
    for row in range(len(rows)):
        target[at + row] = rows[row, 0]
    return at + len(rows)
