"""The stages of a tick one by one, with a way in from Python: for procedures that numba cannot compile, robots that are
commanded from outside, and environments that are stepped there.
"""

from mindrun.sim.compiling import entry
from mindrun.sim.lanes import act as acting
from mindrun.sim.lanes import advance, think
from mindrun.sim.lanes.runs import begin_job, finish

before, after, conclude = entry(advance.before), entry(advance.after), entry(advance.conclude)
act, run_skills, wake, send = entry(acting.act), entry(think.think), entry(think.wake), entry(think.send)


@entry
def begin_again(tables, state, jobs, chosen):
    """End the run of every chosen lane, and begin there the job with the number of the lane."""
    for lane in range(jobs.lanes[0]):
        if chosen[lane]:
            finish(tables, state, jobs, lane)
            jobs.next[0] = lane
            begin_job(tables, state, jobs, lane)
