"""Judge: the measures and events of the tick, the rewards that they earn, and the ends of runs."""

import numpy as np

from mindrun.kinds.sensors.motion import TRAIL_TICKS
from mindrun.numbers.arithmetic import *
from mindrun.sim import codes
from mindrun.sim.codes import DELIVERY, GOING_ON, LEAVE, REACH, Tables
from mindrun.sim.lanes.placement import OF_SEVERAL
from mindrun.sim.lanes.reaching import arrivals, become, begun_of, cross, meet
from mindrun.sim.lanes.sharing import is_paid, share
from mindrun.sim.lanes.solid import remove_box
from mindrun.sim.lanes.think import run_program
from mindrun.sim.state import PLACE_ROWS, JudgeState, State, WorldState
from mindrun.sim.units import unit, unit_where


@unit
def judge(tables: Tables, state: State, lanes: int, clock: int, interrupt: int) -> None:
    """Do everything that a task does with a tick once the robot has moved."""
    world, judged = state.world, state.judge
    take_measures(tables, state, lanes, clock)
    if tables.world[0].battery:
        drain(tables, world, lanes)
    begun = meet(tables, world, lanes)
    for i in range(len(tables.events)):
        judged.happened[i] = notice(tables, state, i, judged.events[i], lanes)
    if tables.world[0].paid < len(tables.robots):
        pass_over(tables, judged, lanes)
    for i in range(len(tables.events)):
        if tables.events[i].after >= 0:
            judged.happened[i] = keep_soon(tables, state, i, lanes)
    for i in range(len(tables.events)):
        for lane in range(lanes if judged.happened[i] > 0 else 0):
            judged.counts[i, lane] += int(judged.events[i, lane])
    if len(tables.tallies) > 0:
        keep_tallies(tables, state, lanes)
    for i in range(len(tables.ends)):
        meet_end(tables, state, tables.ends[i], i, lanes, interrupt)
    for i in range(len(tables.rewards)):
        reward(tables, state, tables.rewards[i], judged.lines[i], lanes)
    if begun > 0:
        become(tables, world, lanes)
        if len(tables.robots) > 1:
            share(tables, world, lanes)
    oldest = PLACE_ROWS * (clock % TRAIL_TICKS)
    for lane in range(lanes):
        world.tick[lane] += 1
        world.trail[oldest + X, lane], world.trail[oldest + Y, lane] = middle_of(world.begun_at, lane)


@unit_where(lambda tables: (tables.events["after"] >= 0).any())
def keep_soon(tables: Tables, state: State, i: int, lanes: int) -> int:
    """Keep of event i what happens soon after the other that it names, in this tick or after one before.

    Return the number of lanes in which it does.
    """
    event, judged = tables.events[i], state.judge
    for lane in range(lanes):
        left = max(0, judged.left[event.left, lane] - 1)
        judged.left[event.left, lane] = left = event.window if judged.events[event.after, lane] > 0.0 else left
        judged.events[i, lane] = judged.events[i, lane] if left > 0 else 0.0
    count: int = count_positive(judged.events[i], lanes)
    return count


@unit_where(lambda tables: len(tables.tallies) > 0)
def keep_tallies(tables: Tables, state: State, lanes: int) -> None:
    """Add what happened in this tick to the tallies, each after those that its condition may be about."""
    judged, values = state.judge, state.mind.stack[0]
    for i in range(len(tables.tallies)):
        tally = tables.tallies[i]
        if tally.whens > 0:
            run_program(tables, state, tally.when, tally.whens, 0, lanes, True)
        for lane in range(lanes):
            judged.paid[lane] = 1.0 if tally.whens == 0 or values[lane] > 0.0 else 0.0
        if tally.length > 0:
            run_program(tables, state, tally.code, tally.length, 0, lanes, True)
        for lane in range(lanes):
            is_open = judged.paid[lane] > 0.0
            times = values[lane] if tally.length > 0 else judged.events[tally.event, lane] if tally.event >= 0 else 1.0
            times = times if is_open else 0.0
            judged.stretches[i, lane] = stretch = times + (judged.stretches[i, lane] if is_open else 0.0)
            before = judged.tallies[i, lane]
            judged.tallies[i, lane] = max(before, stretch) if tally.longest else before + times
            judged.measures[tally.row, lane] = judged.tallies[i, lane]


@unit_where(lambda tables: tables.world[0]["battery"] > 0)
def drain(tables: Tables, world: WorldState, lanes: int) -> None:
    """Charge the battery inside a power zone, and drain it elsewhere."""
    charge, drained = tables.world[0].charge, tables.world[0].drain
    for lane in range(lanes):
        charged = False
        for i in range(len(tables.things)):
            if tables.things[i].kind == codes.POWER:
                x, y = middle_of(world.body, lane)
                charged = charged or inside(world.things, i, x, y, lane)
        left = world.battery[lane] + charge if charged else world.battery[lane] - drained
        world.battery[lane] = min(1.0, max(0.0, left))


def notice(tables, state, i, out, lanes):
    """Write how often event i happened in this tick to `out` [lane]; return the number of lanes in which it did."""
    world, contact, judged, event = state.world, state.contact, state.judge, tables.events[i]
    if event.kind == LEAVE or (event.kind == REACH and event.tos > 0):
        cross(tables, state, i, lanes)
    elif event.kind == REACH:
        begun_of(out, world.reached, event, lanes)
    elif event.kind == DELIVERY and event.tos == 0:
        begun_of(out, world.delivered, event, lanes)
    elif event.kind == DELIVERY:
        arrivals(world, judged.arrived, event, out, len(tables.robots), lanes)
    elif event.kind == codes.VISIT:
        for lane in range(lanes):  # the first time that the robot's centre is in a patch
            patch = event.board + patch_of(world.body, tables.world[0], event, lane)
            out[lane] = 1 - judged.visited[lane, patch]
            judged.visited[lane, patch] = 1
    elif event.kind == codes.COLLISION and event.things > 0:
        bump(tables, state, i, lanes)
    elif event.kind == codes.COLLISION:
        for lane in range(lanes):
            out[lane] = 1 if contact.touching[lane] == 1 else 0
    elif event.kind == codes.EXHAUSTION:
        for lane in range(lanes):
            out[lane] = 1 if world.battery[lane] == 0.0 else 0
    elif event.kind != codes.ITS_END:  # which stands there already
        out[:lanes] = 0  # a success comes later in the tick
    return count_positive(out, lanes)


@OF_SEVERAL
def bump(tables: Tables, state: State, i: int, lanes: int) -> None:
    """Count the robots of event i that each begins to touch in this tick."""
    event, mates, robots, out = tables.events[i], state.contact.mates, len(tables.robots), state.judge.events[i]
    for lane in range(lanes):
        begun, out[lane] = mates[0, lane] & ~mates[1, lane], 0.0
        for number in range(robots):
            thing = tables.robots[number].thing
            is_about = event.thing <= thing < event.thing + event.things
            out[lane] += 1.0 if begun >> number & 1 == 1 and is_about else 0.0


def count_positive(row, lanes):
    """The number of lanes in which a row is above zero."""
    count = 0
    for lane in range(lanes):
        count += 1 if row[lane] > 0.0 else 0
    return count


def patch_of(body, constants, event, lane):
    """The number of the patch that the robot's centre is in."""
    x = min(event.columns - 1, max(0, int((body[X, lane] + constants.half_x) / event.patch)))
    y = min(event.rows - 1, max(0, int((body[Y, lane] + constants.half_y) / event.patch)))
    return y * event.columns + x


def reward(tables, state, line, total, lanes):
    """Add what a reward line pays in this tick to its sums."""
    mind, judged = state.mind, state.judge
    if line.on >= 0 and judged.happened[line.on] == 0:
        return
    paid, amount, is_always = judged.paid, mind.stack[0], line.on < 0 and line.whens == 0
    for k in range(max(1, line.eachs)):
        each = line.each + k
        if not is_always and find_paid(tables, state, line, paid, each, lanes) == 0:
            continue
        run_program(tables, state, line.code, line.length, each, lanes, True)
        if line.last:
            for lane in range(lanes):
                total[lane] = amount[lane] if is_always or paid[lane] > 0.0 else total[lane]
        elif is_always:
            for lane in range(lanes):
                total[lane] += amount[lane]
        else:
            for lane in range(lanes):
                total[lane] += amount[lane] * paid[lane] if paid[lane] > 0.0 else 0.0


def find_paid(tables, state, line, paid, each, lanes):
    """Set how often a line is paid in this tick: once, or as often as its event happens, where its condition holds.

    Return the number of lanes in which it is paid.
    """
    holds = state.mind.stack[0]
    if line.on >= 0:
        for lane in range(lanes):
            paid[lane] = state.judge.events[line.on, lane]
    else:
        paid[:lanes] = 1.0
    if line.whens > 0:
        run_program(tables, state, line.when, line.whens, each, lanes, True)
        for lane in range(lanes):
            paid[lane] = paid[lane] if holds[lane] > 0.0 else 0.0
    return count_positive(paid, lanes)


def meet_end(tables, state, end, i, lanes, interrupt):
    """End the runs to which end number i has come before any other, or open what it opens."""
    judged, run = state.judge, state.run
    if end.event >= 0:
        if judged.happened[end.event] == 0:
            return
        come_by_event(tables, judged, end, lanes)
    else:
        run_program(tables, state, end.when, end.whens, 0, lanes, True)
        for lane in range(lanes):
            judged.paid[lane] = 1.0 if state.mind.stack[0, lane] > 0.0 else 0.0
    if len(tables.robots) > 1:
        end_together(tables, judged, lanes)
    if not end.is_end:
        open_boxes(tables, state, i, lanes)
        return
    for lane in range(lanes):
        if judged.paid[lane] > 0.0 and run.met[lane] == GOING_ON:
            run.met[lane] = i
            run.ended[lane] = i if interrupt else run.ended[lane]
        else:
            judged.paid[lane] = 0.0
    if end.succeeds:
        mark_success(tables, judged, lanes)


def come_by_event(tables, judged, end, lanes):
    """Set `paid` to 1 where the event of an end happens, and has so often to the robots of a world together."""
    robots, is_common = len(tables.robots), tables.events[end.event].is_common
    for home in range(0, lanes, robots):
        times = 0
        for lane in range(home, home + (1 if is_common else robots)):
            times += judged.counts[end.event, lane]
        for lane in range(home, home + robots):
            judged.paid[lane] = 1.0 if times >= end.times and judged.events[end.event, lane] > 0.0 else 0.0


@OF_SEVERAL
def pass_over(tables: Tables, judged: JudgeState, lanes: int) -> None:
    """Let nothing have happened to robots to which nothing happens that counts."""
    for lane in range(lanes):
        if not is_paid(tables, lane % len(tables.robots)):
            judged.events[: len(tables.events), lane] = 0.0


@OF_SEVERAL
def end_together(tables: Tables, judged: JudgeState, lanes: int) -> None:
    """Let an end that has come for one robot of a world have come for all of them."""
    for lane in range(lanes):
        number = lane % len(tables.robots)
        if is_paid(tables, number):
            judged.paid[lane - number] = max(judged.paid[lane - number], judged.paid[lane])
    for lane in range(lanes):
        judged.paid[lane] = judged.paid[lane - lane % len(tables.robots)]


@unit_where(lambda tables: (tables.ends["is_end"] == 0).any())
def open_boxes(tables: Tables, state: State, i: int, lanes: int) -> None:
    """Put the boxes that end number i opens out of the world, where it has come; sight is chosen anew there."""
    boxes, end, come = state.world.boxes, tables.ends[i], state.judge.paid
    for lane in range(lanes):
        for b in range(end.box, end.box + (end.boxes if come[lane] > 0.0 else 0)):
            if boxes[lane, BOX_COLUMNS * b + X] != codes.AWAY:
                remove_box(boxes[lane], b)
                state.sight.anchor[X, lane] = np.nan


def mark_success(tables, judged, lanes):
    """Let the event of a success happen where a run has succeeded in this tick."""
    for i in range(len(tables.events)):
        event = tables.events[i]
        if event.kind == codes.SUCCESS:
            for lane in range(lanes):
                if judged.paid[lane] > 0.0 and (event.after < 0 or judged.left[event.left, lane] > 0):
                    judged.events[i, lane] = 1.0
                    judged.counts[i, lane] += 1
                    judged.happened[i] += 1


def take_measures(tables, state, lanes, clock):
    """Compute the measures of the tick."""
    world, judged = state.world, state.judge
    for i in range(len(tables.measures)):
        measure, out = tables.measures[i], judged.measures[i]
        if measure.kind == codes.CHANGE:
            change(tables, state, i, lanes, clock)
        elif measure.kind == codes.FORWARD:
            forward(out, world.body, world.heading, world.begun_at, lanes)
        elif measure.kind == codes.DRAWN_NUMBER:
            for lane in range(lanes):
                out[lane] = world.numbers[measure.row, lane]
        elif measure.kind == codes.TIME:
            for lane in range(lanes):
                out[lane] = world.tick[lane] + 1
        elif measure.ofs > 0:
            compare_places(tables, state, i, lanes, 0)
        elif measure.kind != codes.ITS_REWARD and measure.kind != codes.TALLIED:  # which stand there already
            progress(out, judged.paid, world.body, world.things, measure, lanes)


def begin_measures(tables, state, lanes):
    """Remember how far from each other things are as a tick begins, where a measure asks."""
    for i in range(len(tables.measures)):
        if tables.measures[i].ofs > 0:
            compare_places(tables, state, i, lanes, 1)


@unit_where(lambda tables: (tables.measures["ofs"] > 0).any())
def compare_places(tables: Tables, state: State, i: int, lanes: int, begins: int) -> None:
    """Measure the least distance between two things of measure i as a tick `begins`, or what the tick made of it."""
    measure, things, judged = tables.measures[i], state.world.things, state.judge
    for lane in range(lanes):
        least = np.inf
        for one in range(measure.of, measure.of + measure.ofs):
            x, y = place_of(things, one, lane)
            for other in range(measure.thing, measure.thing + measure.things):
                its_x, its_y = place_of(things, other, lane)
                square = (x - its_x) * (x - its_x) + (y - its_y) * (y - its_y)
                least = square if square < least else least
        now = np.sqrt(least)
        if begins:
            judged.apart[i, lane] = now
            continue
        found = part_of(judged.apart[i, lane] - now, measure.kind) if measure.kind != codes.APART else now
        judged.measures[i, lane] = found if now < np.inf else 0.0


def part_of(closed, kind):
    """A distance that was closed, or the part of it that is an advance, or a retreat."""
    if kind == codes.ADVANCE:
        return closed if closed > 0.0 else 0.0
    if kind == codes.RETREAT:
        return -closed if closed < 0.0 else 0.0
    return closed


def progress(out, now, body, things, measure, lanes):
    """Write the distance to the nearest of the things that this tick closed, or its positive or negative part.

    Or what is left of it. 0 where all have vanished. `now` is room for the square of what is left of the distance.
    """
    before = out
    before[:lanes], now[:lanes] = np.nan, np.nan
    for i in range(measure.thing, measure.thing + measure.things):
        for lane in range(lanes):
            x, y = place_of(things, i, lane)
            dx, dy = x - body[X, lane], y - body[Y, lane]
            away, here, least, less = distance_of(things, i, lane), dx * dx + dy * dy, before[lane], now[lane]
            before[lane] = away if (away < least) | (least != least) else least
            now[lane] = here if (here < less) | (less != less) else less
    for lane in range(lanes):
        left = np.sqrt(now[lane])
        closed = left if measure.kind == codes.APART else part_of(before[lane] - left, measure.kind)
        out[lane] = 0.0 if np.isnan(closed) else closed


def forward(out, body, heading, begun_at, lanes):
    """Set `out` to 1 where the robot moved forward in this tick, else to 0."""
    for lane in range(lanes):
        dx, dy = body[X, lane] - begun_at[X, lane], body[Y, lane] - begun_at[Y, lane]
        along = dx * heading[COSINE, lane] + dy * heading[SINE, lane]
        out[lane] = 1.0 if along > 1e-6 else 0.0


@unit_where(lambda tables: (tables.measures["kind"] == codes.CHANGE).any())
def change(tables: Tables, state: State, i: int, lanes: int, clock: int) -> None:
    """Compute measure i, the changes of each side's commands over the last ticks, beyond a share: the paper's ΣΔ."""
    commands, judged, measure = state.mind.commands, state.judge, tables.measures[i]
    out, now = judged.measures[i], measure.ring + clock % measure.over
    judged.left_changes[now, :lanes], judged.right_changes[now, :lanes], out[:lanes] = 0.0, 0.0, 0.0
    for k in range(len(tables.actuators)):
        actuator = tables.actuators[k]
        if actuator.kind == codes.PUSH:
            changes = judged.right_changes[now] if actuator.is_right else judged.left_changes[now]
            for lane in range(lanes):
                changes[lane] += abs(np.float64(commands[k, lane]) - np.float64(judged.last_commands[k, lane]))
    varied = judged.paid  # which has nothing in it yet
    for changes in (judged.left_changes, judged.right_changes):
        varied[:lanes] = 0.0
        for k in range(measure.ring, measure.ring + measure.over):
            for lane in range(lanes):
                varied[lane] += changes[k, lane]
        for lane in range(lanes):
            out[lane] += max(0.0, varied[lane] - measure.beyond)
