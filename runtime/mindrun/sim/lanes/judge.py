"""Judge: measures and events of the tick, the rewards they earn, and what becomes of what was reached."""

import numpy as np

from mindrun.arithmetic import COSINE, DISTANCE, SINE, THING_ROWS, X, Y
from mindrun.sensors.inertial import TRAIL_TICKS
from mindrun.sim.arithmetic import inside
from mindrun.sim.codes import (
    ADVANCE,
    CHANGE,
    COLLISION,
    DELIVERY,
    EXHAUSTION,
    FORWARD,
    GREATER,
    LESS,
    LESS_EQUAL,
    POWER,
    REACH,
    RETREAT,
    VISIT,
    WHEEL_LEFT,
    WHEEL_RIGHT,
)
from mindrun.sim.compiling import compiled
from mindrun.sim.lanes.evaluate import evaluate
from mindrun.sim.lanes.reach import BEGUN, become, meet


@compiled
def judge(t, s, n, clock, interrupt):
    """Everything that a task does with a tick once the robot has moved."""
    for i in range(len(t.measures)):
        measure = t.measures[i]
        if measure.kind == CHANGE:
            change(t, s, measure, s.measures[i], n, clock)
        elif measure.kind == FORWARD:
            forward(s.measures[i], s.body, s.heading, s.was, n)
        else:
            progress(s.measures[i], s.body, s.things, measure.thing, measure.kind, n)
    if t.world[0].battery:
        drain(t, s, n)
    begun = meet(t, s, n)
    for i in range(len(t.events)):
        s.happened[i] = notice(t, s, t.events[i], s.events[i], n)
    for i in range(len(t.rewards)):
        reward(t, s, t.rewards[i], s.lines[i], n)
    for i in range(len(t.events)):
        if s.happened[i] > 0:
            settle(t, s, i, n, interrupt)
    if begun > 0:
        become(t, s, n)
    oldest = clock % TRAIL_TICKS
    for p in range(n):
        s.tick[p] += 1
        s.trail[2 * oldest, p], s.trail[2 * oldest + 1, p] = s.was[X, p], s.was[Y, p]


@compiled
def progress(out, body, things, i, kind, n):
    """The distance to thing i that this tick closed, or its positive or negative part; 0 where it has vanished."""
    for p in range(n):
        dx, dy = things[THING_ROWS * i + X, p] - body[X, p], things[THING_ROWS * i + Y, p] - body[Y, p]
        closed = things[THING_ROWS * i + DISTANCE, p] - np.sqrt(dx * dx + dy * dy)
        if kind == ADVANCE:
            closed = closed if closed > 0.0 else 0.0
        elif kind == RETREAT:
            closed = -closed if closed < 0.0 else 0.0
        out[p] = 0.0 if np.isnan(closed) else closed


@compiled
def forward(out, body, heading, before, n):
    """1 where the robot moved forward; `before` holds x and y of the tick's beginning."""
    for p in range(n):
        along = (body[X, p] - before[X, p]) * heading[COSINE, p] + (body[Y, p] - before[Y, p]) * heading[SINE, p]
        out[p] = 1.0 if along > 1e-6 else 0.0


@compiled
def change(t, s, measure, out, n, clock):
    """How much each side's wheel command changed over the last ticks, beyond a share: ΣΔ of the paper's Table 5."""
    slot = measure.ring + clock % measure.over
    total = s.changes.shape[0] // 2
    for p in range(n):
        s.changes[slot, p] = 0.0
        s.changes[total + slot, p] = 0.0
        out[p] = 0.0
    for i in range(len(t.actuators)):
        kind = t.actuators[i].kind
        if kind in (WHEEL_LEFT, WHEEL_RIGHT):
            row = slot if kind == WHEEL_LEFT else total + slot
            for p in range(n):
                s.changes[row, p] += abs(np.float64(s.commands[i, p]) - np.float64(s.last[i, p]))
    for side in range(2):
        first = side * total + measure.ring
        for p in range(n):
            varied = 0.0
            for k in range(measure.over):
                varied += s.changes[first + k, p]
            out[p] += max(0.0, varied - measure.beyond)


@compiled
def drain(t, s, n):
    """The battery charges inside a power zone, and empties elsewhere."""
    world = t.world[0]
    for p in range(n):
        charged = False
        for i in range(len(t.things)):
            if t.things[i].kind == POWER and inside(s.things, i, s.body[X, p], s.body[Y, p], p):
                charged = True
        left = s.battery[p] + world.charge if charged else s.battery[p] - world.drain
        s.battery[p] = min(1.0, max(0.0, left))


@compiled
def notice(t, s, event, out, n):
    """Whether the event happened in this tick, per lane; returns in how many."""
    world, kind, i = t.world[0], event.kind, event.thing
    count = 0
    for p in range(n):
        happened = False
        if kind == REACH:
            happened = s.reached[i, p] == BEGUN
        elif kind == DELIVERY:
            happened = s.delivered[i, p] == BEGUN
        elif kind == VISIT:
            patch = patch_of(s.body, world.half, event.patch, event.columns, p)
            happened = s.board[p, event.board + patch] == 0
            s.board[p, event.board + patch] = 1
        elif kind == COLLISION:
            happened = s.touching[p] == 1
        elif kind == EXHAUSTION:
            happened = s.battery[p] == 0.0
        out[p] = 1.0 if happened else 0.0
        count += 1 if happened else 0
    return count


@compiled
def patch_of(body, half, patch, columns, p):
    """The number of the patch that the robot's centre is in."""
    x = min(columns - 1, max(0, int((body[X, p] + half) / patch)))
    y = min(columns - 1, max(0, int((body[Y, p] + half) / patch)))
    return y * columns + x


@compiled
def reward(t, s, line, total, n):
    """Add what a reward line pays in this tick to its sums."""
    if line.on >= 0 and s.happened[line.on] == 0:
        return
    for k in range(max(1, line.eachs)):
        each = line.each + k
        paid = s.paid
        for p in range(n):
            paid[p] = s.events[line.on, p] if line.on >= 0 else 1.0
        if line.compare >= 0:
            run(t, s, line.right, line.rights, each, n)
            for p in range(n):
                s.limit[p] = s.stack[0, p]
            run(t, s, line.left, line.lefts, each, n)
            only_when(paid, s.stack[0], s.limit, line.compare, n)
        run(t, s, line.code, line.length, each, n)
        for p in range(n):
            total[p] += s.stack[0, p] if paid[p] > 0.0 else 0.0


@compiled
def run(t, s, first, length, each, n):
    """Evaluate a program into stack[0], in every lane."""
    evaluate(t.codes[first : first + length], s.readings, s.measures, each, s.stack, s.active, n, True)


@compiled
def only_when(paid, left, right, compare, n):
    """Nothing is paid where left compare right does not hold."""
    if compare == LESS:
        for p in range(n):
            paid[p] = paid[p] if left[p] < right[p] else 0.0
    elif compare == LESS_EQUAL:
        for p in range(n):
            paid[p] = paid[p] if left[p] <= right[p] else 0.0
    elif compare == GREATER:
        for p in range(n):
            paid[p] = paid[p] if left[p] > right[p] else 0.0
    else:
        for p in range(n):
            paid[p] = paid[p] if left[p] >= right[p] else 0.0


@compiled
def settle(t, s, i, n, interrupt):
    """Count an event, and end the runs that it ends."""
    event = t.events[i]
    for p in range(n):
        if s.events[i, p] > 0.0:
            s.counts[i, p] += 1
            if event.ends and interrupt and s.ended[p] < 0:
                s.ended[p] = i
