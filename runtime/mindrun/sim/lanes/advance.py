"""Many ticks of many worlds: a lane that ends takes the next job, and the lanes close ranks when none is left."""

import numpy as np

from mindrun.arithmetic import ANGLE, COSINE, SINE, X, Y
from mindrun.sensors.inertial import TRAIL_TICKS
from mindrun.sim.arithmetic import sine_cosine
from mindrun.sim.codes import GOING_ON, LOST, VISIT
from mindrun.sim.compiling import compiled, entry
from mindrun.sim.lanes.act import act, recall
from mindrun.sim.lanes.chipmunk import close_space
from mindrun.sim.lanes.judge import judge, patch_of
from mindrun.sim.lanes.placement import draw
from mindrun.sim.lanes.sense import sense
from mindrun.sim.lanes.step import is_lost, step, within
from mindrun.sim.lanes.think import begin, think

MEASURED_ASIDE = np.uint64(0xD1B54A32D192ED03)  # what no skill reads draws from a generator of its own


@entry
def advance(t, s, jobs, ticks, interrupt):
    """Run all lanes for so many ticks, until every job is done, or until a procedure fails."""
    for _ in range(ticks):
        if jobs.lanes[0] == 0:
            break
        before(t, s, jobs)
        think(t, s, jobs.lanes[0], 0, len(t.skills))
        if s.failed[0] >= 0:
            break
        after(t, s, jobs, interrupt)


@compiled
def before(t, s, jobs):
    """The first half of a tick: sense, and the master's influence."""
    sense(t, s, jobs.lanes[0], jobs.clock[0])
    begin(t, s, jobs.lanes[0])


@compiled
def after(t, s, jobs, interrupt):
    """The second half of a tick: act, step, judge, recall.

    Lanes whose run is over write their result and begin the next.
    """
    n, clock = jobs.lanes[0], jobs.clock[0]
    act(t, s, n, clock)
    for p in range(n):
        s.was[X, p], s.was[Y, p] = s.body[X, p], s.body[Y, p]
    step(t, s, n)
    judge(t, s, n, clock, interrupt)
    recall(t, s, n)
    for i in range(len(t.actuators)):
        for p in range(n):
            s.last[i, p] = s.commands[i, p]
    jobs.clock[0] = clock + 1
    if going_on(s.body, s.ended, s.tick, t.world[0].ticks, n) < n:
        for k in range(n):
            end(t, s, jobs, n - 1 - k)


@compiled
def going_on(body, ended, tick, ticks, n):
    """In how many lanes the run is not over: most often in all of them, and then nothing else looks."""
    count = 0
    for p in range(n):
        placed = within(body[X, p], body[Y, p], body[ANGLE, p])
        count += 1 if placed & (ended[p] == GOING_ON) & (tick[p] < ticks) else 0
    return count


@compiled
def end(t, s, jobs, p):
    """Lane p's run written down where it is over, and the next one begun, or the last lane in its place."""
    if is_lost(s.body, p):
        s.faults[p] += 1
        s.ended[p] = LOST
    if s.ended[p] != GOING_ON or s.tick[p] >= t.world[0].ticks:
        finish(t, s, jobs, p)
        if not begin_job(t, s, jobs, p):
            last = jobs.lanes[0] - 1
            if p != last:
                move(s, last, p)
            jobs.lanes[0] = last


@entry
def fill(t, s, jobs, lanes):
    """Begin as many jobs as there are lanes."""
    for p in range(lanes):
        if not begin_job(t, s, jobs, p):
            break
        jobs.lanes[0] = p + 1


@compiled
def begin_job(t, s, jobs, p):
    """Lane p begins the next job from nothing; False where there is none."""
    job = jobs.next[0]
    if job >= len(jobs.genome):
        return False
    jobs.next[0] = job + 1
    s.job[p] = job
    s.random[p] = jobs.seeds[jobs.seed[job]]
    s.aside[p] = s.random[p] ^ MEASURED_ASIDE
    draw(t, s, p)
    genome = jobs.genomes[jobs.genome[job]]
    for i in range(len(genome)):
        s.genome[i, p] = genome[i]
    reset(t, s, p)
    return True


@compiled
def reset(t, s, p):
    """Everything of lane p that is not its world, its genome or its generator, as at the beginning of a run."""
    s.held[p], s.near[p], s.touching[p], s.faults[p] = -1, 0, 0, 0
    s.tick[p], s.ended[p] = 0, GOING_ON
    s.battery[p] = t.world[0].start
    s.heading[SINE, p], s.heading[COSINE, p] = sine_cosine(s.body[ANGLE, p])
    s.lines[:, p] = 0.0
    s.counts[:, p] = 0
    s.reached[:, p], s.delivered[:, p] = 0, 0
    s.changes[:, p] = 0.0
    s.recurrent[:, p] = 0.0
    s.anchor[:, p] = np.nan
    for i in range(TRAIL_TICKS):
        s.trail[2 * i, p], s.trail[2 * i + 1, p] = s.body[X, p], s.body[Y, p]
    for i in range(len(t.actuators)):
        actuator = t.actuators[i]
        s.last[i, p] = actuator.neutral
        for k in range(actuator.delay):
            s.late[actuator.ring + k, p] = actuator.neutral
    for i in range(len(t.memories)):
        s.readings[t.memories[i].row, p] = t.memories[i].start
    s.board[p] = 0
    for i in range(len(t.events)):
        event = t.events[i]
        if event.kind == VISIT:
            s.board[p, event.board + patch_of(s.body, t.world[0].half, event.patch, event.columns, p)] = 1


@compiled
def finish(t, s, jobs, p):
    """Write down what came of lane p's job, and free its Space."""
    job = s.job[p]
    for i in range(len(t.rewards)):
        jobs.lines[job, i] = s.lines[i, p]
    for i in range(len(t.events)):
        jobs.counts[job, i] = s.counts[i, p]
    jobs.ticks[job], jobs.ended[job], jobs.faults[job] = s.tick[p], s.ended[p], s.faults[p]
    close_space(t.library, s.handles[p], 1 + len(t.things))
    s.job[p] = -1


@compiled
def move(s, a, b):
    """Lane a becomes lane b, whose own run is over. Scratch rows stay; the circles change places with their Space."""
    for rows in (s.body, s.heading, s.nearby, s.things, s.trail, s.changes, s.lines, s.anchor):
        for i in range(rows.shape[0]):
            rows[i, b] = rows[i, a]
    for rows in (s.readings, s.before, s.measured, s.rings, s.genome, s.recurrent, s.late, s.last, s.commands):
        for i in range(rows.shape[0]):
            rows[i, b] = rows[i, a]
    for row in (s.held, s.tick, s.ended, s.faults, s.job, s.near, s.touching, s.slot_count):
        row[b] = row[a]
    s.battery[b], s.random[b], s.aside[b] = s.battery[a], s.random[a], s.aside[a]
    for i in range(s.board.shape[1]):
        s.board[b, i] = s.board[a, i]
    for i in range(s.boxes.shape[1]):
        s.boxes[b, i] = s.boxes[a, i]
    for i in range(s.counts.shape[0]):
        s.counts[i, b] = s.counts[i, a]
    for rows in (s.reached, s.delivered):
        for i in range(rows.shape[0]):
            rows[i, b] = rows[i, a]
    for i in range(s.handles.shape[1]):
        s.handles[a, i], s.handles[b, i] = s.handles[b, i], s.handles[a, i]
