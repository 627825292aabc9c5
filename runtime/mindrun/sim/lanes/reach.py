"""Reach: which things are reached and delivered in this tick, and what becomes of them.

Nothing here depends on whether a line of the task names the event: what measures changes nothing.
"""

from mindrun.numbers.arithmetic import THING_ROWS, X, Y
from mindrun.sim.arithmetic import in_claw, inside
from mindrun.sim.codes import MOVES, STAYS, VANISHES, ZONE
from mindrun.sim.compiling import compiled
from mindrun.sim.lanes.loose import SETTLED_TICKS
from mindrun.sim.lanes.placement import succeed, vanish

REACH_BEGUN = 1  # in this tick and not in the one before


@compiled
def meet(tables, world, lanes):
    """Note which things are in reach and which are delivered, those of which anything depends on it.

    How many begin to be so, in all lanes.
    """
    body, things, begun = world.body, world.things, 0
    front, claw = tables.world[0].front, tables.world[0].claw
    for i in range(len(tables.things)):
        thing = tables.things[i]
        if thing.is_reached and not thing.is_area:
            for lane in range(lanes):
                now = in_claw(body, world.heading, things, front, claw, i, lane)
                begun += note(world.reached, i, lane, now)
        elif thing.is_reached:
            for lane in range(lanes):
                begun += note(world.reached, i, lane, inside(things, i, body[X, lane], body[Y, lane], lane))
        if thing.is_delivered:
            for lane in range(lanes):
                if thing.settles and world.still[thing.loose, lane] >= SETTLED_TICKS:
                    continue  # neither it nor any zone has moved since it was looked at
                carried = thing.loose >= 0 or world.delivered[i, lane] & 1 == 1 or world.held[lane] == i
                begun += note(world.delivered, i, lane, carried and in_zone(tables, things, i, lane))
    return begun


@compiled
def note(rows, i, lane, now):
    """One more tick of thing i; 1 where it begins to be so."""
    rows[i, lane] = (rows[i, lane] & 1) << 1 | (1 if now else 0)
    return 1 if rows[i, lane] == REACH_BEGUN else 0


@compiled
def in_zone(tables, things, i, lane):
    """Whether the middle of thing i is inside any zone."""
    x, y = things[THING_ROWS * i + X, lane], things[THING_ROWS * i + Y, lane]
    found = False
    for zone in range(len(tables.things)):
        found = found or (tables.things[zone].kind == ZONE and inside(things, zone, x, y, lane))
    return found


@compiled
def begun_of(out, rows, event, lanes):
    """How many of the things that an event is about begin to be reached, or delivered."""
    for lane in range(lanes):
        out[lane] = 0
    for i in range(event.thing, event.thing + event.things):
        for lane in range(lanes):
            out[lane] += 1 if rows[i, lane] == REACH_BEGUN else 0


@compiled
def begins(row, lanes):
    """In how many lanes a thing begins to be reached, or delivered."""
    count = 0
    for lane in range(lanes):
        count += 1 if row[lane] == REACH_BEGUN else 0
    return count


@compiled
def arrivals(world, arrived, event, lane):
    """How many of the items that an event is about begin to be delivered into one of its zones."""
    things, begun = world.things, 0
    for k in range(event.things):
        item, found = THING_ROWS * (event.thing + k), False
        for zone in range(event.to, event.to + event.tos):
            found = found or inside(things, zone, things[item + X, lane], things[item + Y, lane], lane)
        begun += note(arrived, event.arrival + k, lane, found and world.delivered[event.thing + k, lane] & 1 == 1)
    return begun


@compiled
def become(tables, world, lanes):
    """What has been reached or delivered moves or vanishes where its kind says so; once, where it was both."""
    for i in range(len(tables.things)):
        thing = tables.things[i]
        if thing.reached == STAYS and thing.delivered == STAYS:
            continue
        if begins(world.reached[i], lanes) + begins(world.delivered[i], lanes) == 0:
            continue
        for lane in range(lanes):
            outcome = thing.reached if world.reached[i, lane] == REACH_BEGUN else STAYS
            if world.delivered[i, lane] == REACH_BEGUN:
                outcome = max(outcome, thing.delivered)
            if outcome == MOVES:
                succeed(tables, world, i, lane)
            elif outcome == VANISHES:
                vanish(tables, world, i, lane)
