"""The stages of a tick one by one, with a way in from Python: for minds with procedures that numba cannot compile, and
for robots that are commanded from outside.

Functions of their own, not the stages compiled twice: numba would keep both under one name in its cache.
"""

from mindrun.sim.compiling import entry
from mindrun.sim.lanes import act as acting
from mindrun.sim.lanes import advance, think
from mindrun.sim.lanes.runs import begin_job, finish


@entry
def before(tables, state, jobs):
    """As `advance.before`."""
    advance.before(tables, state, jobs)


@entry
def after(tables, state, jobs, interrupt):
    """As `advance.after`."""
    advance.after(tables, state, jobs, interrupt)


@entry
def act(tables, state, lanes, clock):
    """As `act.act`: the commands, for an environment that is stepped outside of the lanes."""
    acting.act(tables, state, lanes, clock)


@entry
def conclude(tables, state, jobs, interrupt):
    """As `advance.conclude`: what follows that step."""
    advance.conclude(tables, state, jobs, interrupt)


@entry
def run_skills(tables, state, lanes, first, last):
    """As `think.think`."""
    think.think(tables, state, lanes, first, last)


@entry
def wake(tables, state, lanes, row):
    """As `think.wake`."""
    return think.wake(tables, state.mind, lanes, row)


@entry
def send(tables, state, row, out, count, lanes):
    """As `think.send`."""
    think.send(tables, state, row, out, count, lanes)


@entry
def begin_again(tables, state, jobs, chosen):
    """End the run of every chosen lane, and begin there the job with the number of the lane."""
    for lane in range(jobs.lanes[0]):
        if chosen[lane]:
            finish(tables, state, jobs, lane)
            jobs.next[0] = lane
            begin_job(tables, state, jobs, lane)
