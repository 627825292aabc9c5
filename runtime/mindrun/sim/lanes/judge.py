"""Judge: measures and events of the tick, the rewards they earn, and what becomes of what was reached."""

from mindrun.kinds.sensors.inertial import TRAIL_TICKS
from mindrun.numbers.arithmetic import X, Y
from mindrun.sim.arithmetic import inside
from mindrun.sim.codes import (
    COLLISION,
    DELIVERY,
    EXHAUSTION,
    GOING_ON,
    ITS_END,
    POWER,
    REACH,
    SUCCESS,
    VISIT,
)
from mindrun.sim.compiling import compiled, part_of_tick
from mindrun.sim.lanes.evaluate import evaluate
from mindrun.sim.lanes.measure import take_measures
from mindrun.sim.lanes.reach import arrivals, become, begun_of, meet
from mindrun.sim.state import PLACE_ROWS


@part_of_tick
def judge(tables, state, lanes, clock, interrupt):
    """Everything that a task does with a tick once the robot has moved."""
    world, judged = state.world, state.judge
    take_measures(tables, world, state.mind.commands, judged, lanes, clock)
    if tables.world[0].battery:
        drain(tables, world, lanes)
    begun = meet(tables, world, lanes)
    for i in range(len(tables.events)):
        out = judged.events[i]
        judged.happened[i] = notice(tables, world, state.contact, judged, tables.events[i], out, lanes)
    for i in range(len(tables.events)):
        if judged.happened[i] > 0:
            tally(judged.events[i], judged.counts[i], lanes)
    for i in range(len(tables.ends)):
        meet_end(tables, state, tables.ends[i], i, lanes, interrupt)
    for i in range(len(tables.rewards)):
        reward(tables, state.mind, judged, tables.rewards[i], judged.lines[i], lanes)
    if begun > 0:
        become(tables, world, lanes)
    oldest = PLACE_ROWS * (clock % TRAIL_TICKS)
    for lane in range(lanes):
        world.tick[lane] += 1
        world.trail[oldest + X, lane], world.trail[oldest + Y, lane] = world.begun_at[X, lane], world.begun_at[Y, lane]


@compiled
def drain(tables, world, lanes):
    """The battery charges inside a power zone, and empties elsewhere."""
    charge, drained = tables.world[0].charge, tables.world[0].drain
    for lane in range(lanes):
        charged = False
        for i in range(len(tables.things)):
            if tables.things[i].kind == POWER:
                charged = charged or inside(world.things, i, world.body[X, lane], world.body[Y, lane], lane)
        left = world.battery[lane] + charge if charged else world.battery[lane] - drained
        world.battery[lane] = min(1.0, max(0.0, left))


@compiled
def notice(tables, world, contact, judged, event, out, lanes):
    """How often the event happened in this tick, per lane; returns in how many."""
    if event.kind == REACH:
        begun_of(out, world.reached, event, lanes)
    elif event.kind == DELIVERY and event.tos == 0:
        begun_of(out, world.delivered, event, lanes)
    elif event.kind == DELIVERY:
        for lane in range(lanes):
            out[lane] = arrivals(world, judged.arrived, event, lane)
    elif event.kind == VISIT:
        visit(out, tables.world[0], world.body, judged.visited, event, lanes)
    elif event.kind == COLLISION:
        for lane in range(lanes):
            out[lane] = 1 if contact.touching[lane] == 1 else 0
    elif event.kind == EXHAUSTION:
        for lane in range(lanes):
            out[lane] = 1 if world.battery[lane] == 0.0 else 0
    elif event.kind != ITS_END:  # which stands there already
        out[:lanes] = 0  # a success comes later in the tick
    count = 0
    for lane in range(lanes):
        count += 1 if out[lane] > 0 else 0
    return count


@compiled
def visit(out, constants, body, visited, event, lanes):
    """1 where the robot's centre is in a patch for the first time."""
    for lane in range(lanes):
        patch = event.board + patch_of(body, constants, event, lane)
        out[lane] = 1 - visited[lane, patch]
        visited[lane, patch] = 1


@compiled
def patch_of(body, constants, event, lane):
    """The number of the patch that the robot's centre is in."""
    x = min(event.columns - 1, max(0, int((body[X, lane] + constants.half_x) / event.patch)))
    y = min(event.rows - 1, max(0, int((body[Y, lane] + constants.half_y) / event.patch)))
    return y * event.columns + x


@compiled
def reward(tables, mind, judged, line, total, lanes):
    """Add what a reward line pays in this tick to its sums."""
    if line.on >= 0 and judged.happened[line.on] == 0:
        return
    paid, amount, is_always = judged.paid, mind.stack[0], line.on < 0 and line.whens == 0
    for k in range(max(1, line.eachs)):
        each = line.each + k
        if not is_always:
            find_paid(tables, mind, judged, line, paid, each, lanes)
        value(tables, mind, judged.measures, line.code, line.length, each, lanes)
        if is_always:
            for lane in range(lanes):
                total[lane] += amount[lane]
        else:
            for lane in range(lanes):
                total[lane] += amount[lane] * paid[lane] if paid[lane] > 0.0 else 0.0


@compiled
def find_paid(tables, mind, judged, line, paid, each, lanes):
    """How often a line is paid in this tick: once, or as often as its event happens, where its condition holds."""
    for lane in range(lanes):
        paid[lane] = judged.events[line.on, lane] if line.on >= 0 else 1.0
    if line.whens > 0:
        value(tables, mind, judged.measures, line.when, line.whens, each, lanes)
        for lane in range(lanes):
            paid[lane] = paid[lane] if mind.stack[0, lane] > 0.0 else 0.0


@compiled
def value(tables, mind, measures, first, length, each, lanes):
    """Evaluate a program into stack[0], in every lane."""
    codes = tables.codes[first : first + length]
    evaluate(codes, mind.readings, measures, mind.commands, each, mind.stack, mind.active, lanes, True)


@compiled
def tally(happened, counts, lanes):
    """Count an event."""
    for lane in range(lanes):
        counts[lane] += int(happened[lane])


@compiled
def meet_end(tables, state, end, i, lanes, interrupt):
    """End the runs to which end number i has come before any other."""
    judged, run = state.judge, state.run
    if end.event >= 0:
        if judged.happened[end.event] == 0:
            return
        for lane in range(lanes):
            is_last = judged.counts[end.event, lane] >= end.times
            judged.paid[lane] = 1.0 if is_last and judged.events[end.event, lane] > 0.0 else 0.0
    else:
        value(tables, state.mind, judged.measures, end.when, end.whens, 0, lanes)
        for lane in range(lanes):
            judged.paid[lane] = 1.0 if state.mind.stack[0, lane] > 0.0 else 0.0
    met = 0
    for lane in range(lanes):
        if judged.paid[lane] > 0.0 and run.met[lane] == GOING_ON:
            run.met[lane] = i
            run.ended[lane] = i if interrupt else run.ended[lane]
            met += 1
        else:
            judged.paid[lane] = 0.0
    if met > 0 and end.succeeds:
        succeed(tables, judged, lanes)


@compiled
def succeed(tables, judged, lanes):
    """The event of a success happens where a run has succeeded in this tick."""
    for i in range(len(tables.events)):
        if tables.events[i].kind == SUCCESS:
            for lane in range(lanes):
                if judged.paid[lane] > 0.0:
                    judged.events[i, lane] = 1.0
                    judged.counts[i, lane] += 1
                    judged.happened[i] += 1
