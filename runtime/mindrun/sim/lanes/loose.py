"""Motion of loose things, boxes and balls, while nothing touches them: they slide, turn, slow down and rest.

A thing is **settled** when it has not moved for SETTLED_TICKS: nothing looks at it again until the robot, or something
else that moves, comes near. Where all are, a lane has nothing to do. Contacts that are still there do not change any
more by then: what Chipmunk remembers of them has become too small to move anything.
"""

import numpy as np

from mindrun.numbers.arithmetic import *
from mindrun.sim.codes import HALF_DIAGONAL, Tables
from mindrun.sim.lanes.solid import drift_of, extent_of, first_loose, is_free, loose_place, loose_size, turn_of, within
from mindrun.sim.state import PLACE_ROWS, ContactState, WorldState
from mindrun.sim.units import unit_where

REST_SPEED = 1e-3  # units and radians per second: what is slower stands still
SETTLED_TICKS = 32
LOOSE_MARGIN_UNITS = 0.01  # beyond the rounding of any distance here
OF_LOOSE = unit_where(lambda tables: len(tables.loose) > 0)


@OF_LOOSE
def slow_down(tables: Tables, world: WorldState, contact: ContactState, lane: int) -> None:
    """Damp what has not settled, v / (1 + dt·c), and let it rest where it is slow enough.

    Its solid is not asleep: it may have appeared elsewhere, and settles there without a contact. What drives itself
    never settles.
    """
    loose, dt, restless = world.loose, tables.world[0].dt, 0
    for i in range(len(tables.loose)):
        if world.still[i, lane] < SETTLED_TICKS:
            contact.solids[lane, first_loose(tables) + i].is_asleep = 0
            thing, slower = tables.loose[i].thing, world.numbers[tables.loose[i].slower, lane]
            vx, vy, spin = drift_of(loose, i, lane)
            vx, vy, spin = vx * slower, vy * slower, spin * slower
            x, y = place_of(world.things, thing, lane)
            there = within(x + vx * dt, y + vy * dt, turn_of(loose, i, lane) + spin * dt)
            if not there:  # gone, or beyond all places
                put_thing(world.things, thing, np.nan, np.nan, lane)
            rests = is_at_rest(vx, vy, spin) or not there
            put_drift(loose, i, vx, vy, spin, rests, lane)
            settles = rests and (tables.loose[i].aim == 0 or not there)
            world.still[i, lane] = (world.still[i, lane] + 1 if there else SETTLED_TICKS) if settles else 0
            restless += 1
            if tables.loose[i].aim != 0:
                drive(tables, world, i, lane)
    world.restless[lane] = restless


def wanted_way(world, robots, row, x, y, lane):
    """The way along x and y that something at a place wants to go in this tick, as its row of a table says.

    It leads straight towards the nearest that it seeks and not past that, or away from what it flees. It is no number
    where that is too far away, or where there is no direction away from it.
    """
    dx, dy, far = 0.0, 0.0, np.inf
    for its in range(lane, lane + (robots if row.afters == 0 else 0)):
        its_x, its_y = middle_of(world.body, its)
        away = length(its_x - x, its_y - y)
        if its == lane or away < far:
            dx, dy, far = its_x - x, its_y - y, away
    for other in range(row.after, row.after + row.afters):
        its_x, its_y = place_of(world.things, other, lane)
        away = length(its_x - x, its_y - y)
        if other != row.thing and away < far:  # one that has vanished is no number away
            dx, dy, far = its_x - x, its_y - y, away
    if not far <= row.range or (far == 0.0 and row.aim < 0):
        return np.nan, np.nan
    share = row.aim * world.numbers[row.step, lane] / far if far > 0.0 else 0.0
    share = min(share, 1.0)
    return dx * share, dy * share


@unit_where(lambda tables: bool(tables.loose["aim"].any()))
def drive(tables: Tables, world: WorldState, i: int, lane: int) -> None:
    """Write down the force by which loose thing i drives itself, none where it knows no way.

    Of at most its thrust, it is the one by which the next tick, once it has been damped, takes it along its way.
    """
    loose, dt = tables.loose[i], tables.world[0].dt
    x, y = next_place_of(tables, world, i, lane)
    dx, dy = wanted_way(world, len(tables.robots), loose, x, y, lane)
    slower, mass = world.numbers[loose.slower, lane], mass_of(tables, world, i, lane)
    vx, vy, _ = drift_of(world.loose, i, lane)
    along, across = (dx / dt / slower - vx) * mass / dt, (dy / dt / slower - vy) * mass / dt
    wanted, most = length(along, across), world.numbers[loose.thrust, lane]
    share = most / wanted if wanted > most else 1.0
    if np.isnan(wanted):
        along, across = 0.0, 0.0
    world.drive[PLACE_ROWS * i + X, lane], world.drive[PLACE_ROWS * i + Y, lane] = along * share, across * share


def mass_of(tables, world, i, lane):
    """The mass of loose thing i."""
    body, size = tables.loose[i], loose_size(tables, world, i, lane)
    density = world.numbers[body.density, lane]
    return density * np.pi * (size / 2 * (size / 2)) if body.is_round else density * (size * size)


def is_at_rest(vx, vy, spin):
    """True if something moves and turns so slowly that it rests."""
    return abs(vx) < REST_SPEED and abs(vy) < REST_SPEED and abs(spin) < REST_SPEED


def put_drift(loose, i, vx, vy, spin, rests, lane):
    """Set the velocity and the spin of loose thing i; 0 if it rests."""
    row = LOOSE_ROWS * i
    loose[row + PUSHED_X, lane] = 0.0 if rests else vx
    loose[row + PUSHED_Y, lane] = 0.0 if rests else vy
    loose[row + PUSHED_SPIN, lane] = 0.0 if rests else spin


def next_place_of(tables, world, i, lane):
    """The x and y of loose thing i after this tick, if it touches nothing."""
    dt = tables.world[0].dt
    x, y = loose_place(tables, world, i, lane)
    vx, vy, _ = drift_of(world.loose, i, lane)
    return x + vx * dt, y + vy * dt


@OF_LOOSE
def could_touch(tables: Tables, world: WorldState, lane: int) -> int:
    """True if something that has not settled could touch anything but the robot after this tick."""
    for i in range(len(tables.loose)):
        if world.still[i, lane] < SETTLED_TICKS:
            x, y = next_place_of(tables, world, i, lane)
            extent = extent_of(tables, world, i, lane) + LOOSE_MARGIN_UNITS
            if not is_free(tables, world, x, y, extent, lane) or meets_loose(tables, world, i, x, y, extent, lane):
                return True
    return False


def meets_loose(tables, world, i, x, y, extent, lane):
    """True if a loose thing other than number i could come within `extent` of a point in this tick."""
    for j in range(len(tables.loose)):
        if j != i:
            its_x, its_y = next_place_of(tables, world, j, lane)
            dx, dy, gap = its_x - x, its_y - y, extent_of(tables, world, j, lane) + extent
            if dx * dx + dy * dy < gap * gap:
                return True
    return False


@OF_LOOSE
def approach_loose(tables: Tables, world: WorldState, contact: ContactState, lanes: int) -> None:
    """Lower `gap` to the distance between the robot's next centre and each loose thing, where that is less."""
    body, gap, dt = world.body, contact.gap, tables.world[0].dt
    for i in range(len(tables.loose)):
        of_size = 0.5 if tables.loose[i].is_round else HALF_DIAGONAL
        for lane in range(lanes):
            x, y = next_place_of(tables, world, i, lane)
            own_x, own_y = next_middle(body, dt, lane)
            far = length(x - own_x, y - own_y) - of_size * loose_size(tables, world, i, lane)
            gap[lane] = far if far < gap[lane] else gap[lane]


@OF_LOOSE
def slide(tables: Tables, world: WorldState, lane: int) -> None:
    """Make Chipmunk's step of loose things that touch nothing."""
    loose, dt = world.loose, tables.world[0].dt
    for i in range(len(tables.loose)):
        if world.still[i, lane] == 0:
            x, y = next_place_of(tables, world, i, lane)
            put_thing(world.things, tables.loose[i].thing, x, y, lane)
            vx, vy, spin = drift_of(loose, i, lane)
            loose[LOOSE_ROWS * i + TURN, lane] += spin * dt
            if tables.loose[i].aim != 0:
                mass_inv = 1.0 / mass_of(tables, world, i, lane)
                vx += world.drive[PLACE_ROWS * i + X, lane] * mass_inv * dt
                vy += world.drive[PLACE_ROWS * i + Y, lane] * mass_inv * dt
                put_drift(loose, i, vx, vy, spin, is_at_rest(vx, vy, spin), lane)
