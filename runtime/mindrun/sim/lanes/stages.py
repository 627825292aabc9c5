"""The stages of a tick one by one, with a way in from Python: for minds with procedures that numba cannot compile.

Functions of their own, not the stages compiled twice: numba would keep both under one name in its cache.
"""

from mindrun.sim.compiling import entry
from mindrun.sim.lanes import advance, think


@entry
def before(t, s, jobs):
    """As `advance.before`."""
    advance.before(t, s, jobs)


@entry
def after(t, s, jobs, interrupt):
    """As `advance.after`."""
    advance.after(t, s, jobs, interrupt)


@entry
def run_skills(t, s, n, first, last):
    """As `think.think`."""
    think.think(t, s, n, first, last)


@entry
def wake(t, s, n, i):
    """As `think.wake`."""
    return think.wake(t, s, n, i)


@entry
def send(t, s, i, out, n, lanes):
    """As `think.send`."""
    think.send(t, s, i, out, n, lanes)
