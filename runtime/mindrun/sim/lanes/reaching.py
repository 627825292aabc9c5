"""Reaching: the things that are reached or delivered in a tick, or meet others, or leave, and what becomes of them.

Which things are reached does not depend on whether a line of the task names the event: measuring changes nothing.
"""

from mindrun.numbers.arithmetic import *
from mindrun.sim.codes import LEAVE, MOVES, REACH, STAYS, VANISHES, ZONE, Tables
from mindrun.sim.lanes.loose import SETTLED_TICKS
from mindrun.sim.lanes.placement import succeed, vanish
from mindrun.sim.state import State
from mindrun.sim.units import unit_where

REACH_BEGUN, REACH_LEFT = 1, 2  # in this tick and not in the one before; or the other way round


def meet(tables, world, lanes):
    """Set the bits of `reached` and `delivered` where anything asks for them; return how many begin, in all lanes."""
    body, things, begun = world.body, world.things, 0
    front, claw = tables.world[0].front, tables.world[0].claw
    for i in range(len(tables.things)):
        thing = tables.things[i]
        if thing.is_reached and not thing.is_area:
            for lane in range(lanes):
                now = in_claw(body, world.heading, things, front, claw, i, lane)
                begun += note(world.reached, i, lane, world.reached[i, lane], now)
        elif thing.is_reached:
            for lane in range(lanes):
                x, y = middle_of(body, lane)
                begun += note(world.reached, i, lane, world.reached[i, lane], inside(things, i, x, y, lane))
        if thing.is_delivered:
            robots = len(tables.robots)
            for home in range(0, lanes, robots):
                if thing.settles and world.still[thing.loose, home] >= SETTLED_TICKS:
                    continue  # neither it nor any zone has moved since it was looked at
                before = by_any(world.delivered, i, home, robots)
                for lane in range(home, home + robots):
                    carried = thing.loose >= 0 or world.delivered[i, lane] & 1 == 1 or world.held[lane] == i
                    begun += note(world.delivered, i, lane, before, carried and in_zone(tables, things, i, lane))
    return begun


def note(rows, i, lane, before, now):
    """Write the bits of thing i, one for now and one for `before`; return 1 where it begins, else 0."""
    rows[i, lane] = (before & 1) << 1 | (1 if now else 0)
    return 1 if rows[i, lane] == REACH_BEGUN else 0


def by_any(rows, i, home, robots):
    """Bit 0 of thing i, set where it is for any robot of a world, whose first lane is given."""
    found = 0
    for lane in range(home, home + robots):
        found |= rows[i, lane] & 1
    return found


def in_zone(tables, things, i, lane):
    """True if the middle of thing i is inside any zone."""
    x, y = place_of(things, i, lane)
    found = False
    for zone in range(len(tables.things)):
        found = found or (tables.things[zone].kind == ZONE and inside(things, zone, x, y, lane))
    return found


def begun_of(out, rows, event, lanes):
    """Count the things that an event is about and that begin to be reached, or delivered, into `out` [lane]."""
    out[:lanes] = 0
    for i in range(event.thing, event.thing + event.things):
        for lane in range(lanes):
            out[lane] += 1 if rows[i, lane] == REACH_BEGUN else 0


def arrivals(world, arrived, event, out, robots, lanes):
    """Count the things that an event is about and that begin to be delivered into one of its zones into `out` [lane].

    Once for all robots of a world.
    """
    out[:lanes] = 0
    for k in range(event.things):
        for home in range(0, lanes, robots):
            before = by_any(arrived, event.arrival + k, home, robots)
            for lane in range(home, home + robots):
                now = world.delivered[event.thing + k, lane] & 1 == 1 and lies_in(world.things, event, k, lane)
                out[lane] += note(arrived, event.arrival + k, lane, before, now)


def lies_in(things, event, k, lane):
    """True if the middle of the k-th thing of an event is in one of the zones that it is about."""
    found = False
    x, y = place_of(things, event.thing + k, lane)
    for zone in range(event.to, event.to + event.tos):
        found = found or inside(things, zone, x, y, lane)
    return found


@unit_where(lambda tables: is_crossing(tables.events).any())
def cross(tables: Tables, state: State, i: int, lanes: int) -> None:
    """Count the things of event i, or the robot, that come to what it is about in this tick, or leave it."""
    event, world, judged = tables.events[i], state.world, state.judge
    wanted = REACH_LEFT if event.kind == LEAVE else REACH_BEGUN
    for lane in range(lanes):
        judged.events[i, lane] = 0.0
        for k in range(max(1, event.tos)):
            row = event.arrival + k
            note(judged.arrived, row, lane, judged.arrived[row, lane], is_there(tables, world, event, k, lane))
            judged.events[i, lane] += 1.0 if judged.arrived[row, lane] == wanted else 0.0


@unit_where(lambda tables: (tables.events["kind"] == LEAVE).any())
def begin_inside(tables: Tables, state: State, i: int, lane: int) -> None:
    """Remember which things of event i, or whether the robot, are in its zones as a run begins."""
    event = tables.events[i]
    for k in range(max(1, event.tos)):
        state.judge.arrived[event.arrival + k, lane] = 1 if is_there(tables, state.world, event, k, lane) else 0


def is_crossing(events):
    """A mask of the events of things that come to others, or of what leaves a zone."""
    return (events["kind"] == LEAVE) | ((events["kind"] == REACH) & (events["tos"] > 0))


def is_there(tables, world, event, k, lane):
    """True if the k-th thing of an event, or the robot where it names none, is at any of what the event is about."""
    (x, y), rim = middle_of(world.body, lane), 0.0
    if event.tos > 0:
        x, y = place_of(world.things, event.to + k, lane)
        rim = tables.world[0].claw + size_of(world.things, event.to + k, lane) / 2
    found = False
    for i in range(event.thing, event.thing + event.things):
        if tables.things[i].is_area:
            found = found or inside(world.things, i, x, y, lane)
        else:
            its_x, its_y = place_of(world.things, i, lane)
            most = rim + size_of(world.things, i, lane) / 2
            found = found or (x - its_x) * (x - its_x) + (y - its_y) * (y - its_y) <= most * most
    return found


def become(tables, world, lanes):
    """Move or remove what has been reached or delivered, as its arguments say; once, where it was both."""
    for i in range(len(tables.things)):
        thing = tables.things[i]
        if thing.reached == STAYS and thing.delivered == STAYS:
            continue
        for home in range(0, lanes, len(tables.robots)):
            outcome = STAYS
            for lane in range(home, home + len(tables.robots)):
                outcome = max(outcome, thing.reached if world.reached[i, lane] == REACH_BEGUN else STAYS)
                outcome = max(outcome, thing.delivered if world.delivered[i, lane] == REACH_BEGUN else STAYS)
            if outcome == MOVES:
                succeed(tables, world, i, home)
            elif outcome == VANISHES:
                vanish(tables, world, i, home)
