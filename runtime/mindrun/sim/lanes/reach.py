"""Reach: which things are reached and delivered in this tick, and what becomes of them.

Nothing here depends on whether a line of the task names the event: what measures changes nothing.
"""

from mindrun.arithmetic import THING_ROWS, X, Y
from mindrun.sim.arithmetic import in_claw, inside
from mindrun.sim.codes import ITEM, MOVES, STAYS, VANISHES, ZONE
from mindrun.sim.compiling import compiled
from mindrun.sim.lanes.placement import succeed, vanish

BEGUN = 1  # in this tick and not in the one before


@compiled
def meet(t, s, n):
    """Note which things are in reach and which are delivered, those of which anything depends on it.

    How many begin to be so, in all lanes.
    """
    world, begun = t.world[0], 0
    for i in range(len(t.things)):
        thing = t.things[i]
        if thing.is_reached and thing.kind == ITEM:
            for p in range(n):
                now = in_claw(s.body, s.heading, s.things, world.radius, world.claw, i, p)
                begun += note(s.reached, i, p, now)
        elif thing.is_reached:
            for p in range(n):
                begun += note(s.reached, i, p, inside(s.things, i, s.body[X, p], s.body[Y, p], p))
        if thing.is_delivered:
            for p in range(n):
                was = s.delivered[i, p] & 1 == 1
                begun += note(s.delivered, i, p, (was or s.held[p] == i) and in_zone(t, s.things, i, p))
    return begun


@compiled
def note(rows, i, p, now):
    """One more tick of thing i; 1 where it begins to be so."""
    rows[i, p] = (rows[i, p] & 1) << 1 | (1 if now else 0)
    return 1 if rows[i, p] == BEGUN else 0


@compiled
def in_zone(t, things, i, p):
    """Whether the middle of thing i is inside any zone."""
    x, y = things[THING_ROWS * i + X, p], things[THING_ROWS * i + Y, p]
    found = False
    for z in range(len(t.things)):
        found = found or (t.things[z].kind == ZONE and inside(things, z, x, y, p))
    return found


@compiled
def become(t, s, n):
    """What has been reached or delivered moves or vanishes where its kind says so; once, where it was both."""
    for i in range(len(t.things)):
        thing = t.things[i]
        if thing.reached == STAYS and thing.delivered == STAYS:
            continue
        for p in range(n):
            outcome = thing.reached if s.reached[i, p] == BEGUN else STAYS
            if s.delivered[i, p] == BEGUN:
                outcome = max(outcome, thing.delivered)
            if outcome == MOVES:
                succeed(t, s, i, p)
            elif outcome == VANISHES:
                vanish(s, i, p)
