"""Measures: what a tick is rewarded for that is no event: progress, moving forward, restless wheels."""

import numpy as np

from mindrun.numbers.arithmetic import COSINE, DISTANCE, SINE, THING_ROWS, X, Y
from mindrun.sim.codes import ADVANCE, CHANGE, FORWARD, ITS_REWARD, PUSH, RETREAT
from mindrun.sim.compiling import compiled


@compiled
def take_measures(tables, world, commands, judged, lanes, clock):
    """The measures of the tick."""
    for i in range(len(tables.measures)):
        measure, out = tables.measures[i], judged.measures[i]
        if measure.kind == CHANGE:
            change(tables, commands, judged, measure, out, lanes, clock)
        elif measure.kind == FORWARD:
            forward(out, world.body, world.heading, world.begun_at, lanes)
        elif measure.kind != ITS_REWARD:  # which stands there already
            progress(out, judged.paid, world.body, world.things, measure, lanes)


@compiled
def progress(out, now, body, things, measure, lanes):
    """The distance to the nearest of the things that this tick closed, or its positive or negative part.

    0 where all have vanished. `now` is room for the square of what is left of the distance.
    """
    before, first = out, THING_ROWS * measure.thing
    for lane in range(lanes):
        dx, dy = things[first + X, lane] - body[X, lane], things[first + Y, lane] - body[Y, lane]
        before[lane], now[lane] = things[first + DISTANCE, lane], dx * dx + dy * dy
    for i in range(measure.thing + 1, measure.thing + measure.things):
        thing = THING_ROWS * i
        for lane in range(lanes):
            dx, dy = things[thing + X, lane] - body[X, lane], things[thing + Y, lane] - body[Y, lane]
            away, here = things[thing + DISTANCE, lane], dx * dx + dy * dy
            least, less = before[lane], now[lane]
            before[lane] = away if (away < least) | (least != least) else least
            now[lane] = here if (here < less) | (less != less) else less
    for lane in range(lanes):
        closed = before[lane] - np.sqrt(now[lane])
        if measure.kind == ADVANCE:
            closed = closed if closed > 0.0 else 0.0
        elif measure.kind == RETREAT:
            closed = -closed if closed < 0.0 else 0.0
        out[lane] = 0.0 if np.isnan(closed) else closed


@compiled
def forward(out, body, heading, begun_at, lanes):
    """1 where the robot moved forward in this tick."""
    for lane in range(lanes):
        dx, dy = body[X, lane] - begun_at[X, lane], body[Y, lane] - begun_at[Y, lane]
        along = dx * heading[COSINE, lane] + dy * heading[SINE, lane]
        out[lane] = 1.0 if along > 1e-6 else 0.0


@compiled
def change(tables, commands, judged, measure, out, lanes, clock):
    """How much each side's wheel command changed over the last ticks, beyond a share: ΣΔ of the paper's Table 5."""
    now = measure.ring + clock % measure.over
    for lane in range(lanes):
        judged.left_changes[now, lane] = 0.0
        judged.right_changes[now, lane] = 0.0
        out[lane] = 0.0
    for i in range(len(tables.actuators)):
        actuator = tables.actuators[i]
        if actuator.kind == PUSH:
            changes = judged.right_changes[now] if actuator.is_right else judged.left_changes[now]
            for lane in range(lanes):
                changes[lane] += abs(np.float64(commands[i, lane]) - np.float64(judged.last_commands[i, lane]))
    varied = judged.paid  # which has nothing in it yet
    for changes in (judged.left_changes, judged.right_changes):
        for lane in range(lanes):
            varied[lane] = 0.0
        for k in range(measure.ring, measure.ring + measure.over):
            for lane in range(lanes):
                varied[lane] += changes[k, lane]
        for lane in range(lanes):
            out[lane] += max(0.0, varied[lane] - measure.beyond)
