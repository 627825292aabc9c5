"""What moves in a lane on its way into a step and out of it: where it stands, how it is turned, how fast it is.

A solid that has settled and touches nothing that it would push, or be pushed by, is **asleep**: until something awake
comes so near that the rectangles around both meet, a step changes nothing of it, and it takes no part.
"""

import numpy as np

from mindrun.kinds.bodies.body import FRICTION_COEFFICIENT
from mindrun.numbers.arithmetic import (
    ANGLE,
    LOOSE_ROWS,
    PUSHED_SPIN,
    PUSHED_X,
    PUSHED_Y,
    SPEED_X,
    SPEED_Y,
    SPIN,
    TURN,
    X,
    Y,
    place_of,
    put_thing,
    size_of,
)
from mindrun.sim.codes import FORCE_X, FORCE_Y, TORQUE
from mindrun.sim.lanes.loose import OF_LOOSE, SETTLED_TICKS, is_at_rest, put_motion
from mindrun.sim.lanes.shapes import overlap, put_corners, put_held, put_shape, turn
from mindrun.sim.state import (
    ACROSS,
    ALONG,
    AWAKE,
    AWAY_SPIN,
    AWAY_X,
    AWAY_Y,
    CONTACT,
    CONTACT_COLUMNS,
    CONTACTS,
    CORNERS,
    COSINE_OF,
    FIRST_LOOSE,
    FIXED,
    HELD,
    LEFT,
    MADE,
    MASS_INV,
    MIDDLE_X,
    MIDDLE_Y,
    MOMENT_INV,
    NUMBER,
    OTHER,
    OWN,
    OWN_CORNER,
    PAIR_COLUMNS,
    PARTING,
    RADIUS,
    RIGHT,
    ROBOT,
    ROUGHNESS,
    SOLID_COLUMNS,
    TOUCHING,
    TURNED,
    VSPIN,
    VX,
    VY,
    ContactState,
    WorldState,
)
from mindrun.sim.tables import Tables


def open_space(tables, world, contact, lane):
    """Begin anew in a lane: nothing is remembered."""
    contact.space[lane], contact.solids[lane], contact.asleep[lane] = 0.0, 0.0, 0
    constants, solids = tables.world[0], contact.solids[lane]
    for a in range(len(solids) // SOLID_COLUMNS):
        solids[SOLID_COLUMNS * a + COSINE_OF] = 1.0
    p = SOLID_COLUMNS * FIXED
    solids[p + CORNERS], solids[p + ROUGHNESS] = 4.0, 1.0
    p = SOLID_COLUMNS * HELD
    solids[p + CORNERS], solids[p + ROUGHNESS] = 1.0, FRICTION_COEFFICIENT
    p = SOLID_COLUMNS * ROBOT
    solids[p + CORNERS], solids[p + ROUGHNESS] = (
        (1.0 if constants.is_round else 4.0),
        world.numbers[constants.friction, lane],
    )
    solids[p + RADIUS], solids[p + NUMBER] = constants.radius, constants.number
    solids[p + MASS_INV] = world.numbers[constants.mass_inv, lane]
    solids[p + MOMENT_INV] = world.numbers[constants.moment_inv, lane]
    x, y = constants.front, constants.side
    put_corners(solids, p + OWN_CORNER, -x, -y, x, y)


def move_robot(tables, world, contact, seconds, share, lane):
    """Move a lane's robot on with what it holds, and let its force act."""
    solids, body, held, p = contact.solids[lane], world.body, world.held[lane], SOLID_COLUMNS * ROBOT
    solids[p + VX], solids[p + VY], solids[p + VSPIN] = body[SPEED_X, lane], body[SPEED_Y, lane], body[SPIN, lane]
    angle = move(solids, p, body[X, lane], body[Y, lane], body[ANGLE, lane], seconds)
    body[ANGLE, lane] = angle
    solids[p + VX] += world.push[FORCE_X, lane] * share * solids[p + MASS_INV] * seconds
    solids[p + VY] += world.push[FORCE_Y, lane] * share * solids[p + MASS_INV] * seconds
    solids[p + VSPIN] += world.push[TORQUE, lane] * share * solids[p + MOMENT_INV] * seconds
    if solids[p + CORNERS] > 1.0:
        turn(tables, solids, p, angle)
    put_shape(solids, p, solids[p + MIDDLE_X], solids[p + MIDDLE_Y])
    if held >= 0:
        put_held(tables, world, contact, held, size_of(world.things, held, lane) / 2, lane)


def move(solids, p, x, y, angle, seconds):
    """Move a solid on from a place; return the angle to which it has turned."""
    solids[p + MIDDLE_X] = x + (solids[p + VX] + solids[p + AWAY_X]) * seconds
    solids[p + MIDDLE_Y] = y + (solids[p + VY] + solids[p + AWAY_Y]) * seconds
    angle += (solids[p + VSPIN] + solids[p + AWAY_SPIN]) * seconds
    solids[p + AWAY_X], solids[p + AWAY_Y], solids[p + AWAY_SPIN] = 0.0, 0.0, 0.0
    return angle


@OF_LOOSE
def move_loose(tables: Tables, world: WorldState, contact: ContactState, seconds: float, lane: int) -> None:
    """Move the loose things of a lane on that are awake, and wake what they come near."""
    solids, asleep = contact.solids[lane], contact.asleep[lane]
    for i in range(len(tables.loose)):
        a, row = FIRST_LOOSE + i, LOOSE_ROWS * i
        if asleep[a] == 1:
            continue
        p = SOLID_COLUMNS * a
        x, y = place_of(world.things, tables.loose[i].thing, lane)
        if np.isnan(x):  # gone
            asleep[a] = 1
            solids[p + LEFT], solids[p + RIGHT] = np.inf, -np.inf
            continue
        size = size_of(world.things, tables.loose[i].thing, lane)
        if solids[p + MADE] != size:
            make(tables, world, solids, i, size, lane)
        solids[p + VX], solids[p + VY] = world.loose[row + PUSHED_X, lane], world.loose[row + PUSHED_Y, lane]
        solids[p + VSPIN] = world.loose[row + PUSHED_SPIN, lane]
        angle = move(solids, p, x, y, world.loose[row + TURN, lane], seconds)
        if solids[p + CORNERS] > 1.0:
            turn(tables, solids, p, angle)
        solids[p + TURNED] = angle
        put_shape(solids, p, solids[p + MIDDLE_X], solids[p + MIDDLE_Y])
    wake(solids, asleep, world.held[lane] >= 0)


def make(tables, world, solids, i, size, lane):
    """Give loose thing i a size, and with it its corners, its mass and its moment of inertia."""
    half, p = size / 2, SOLID_COLUMNS * (FIRST_LOOSE + i)
    density = world.numbers[tables.loose[i].density, lane]
    if tables.loose[i].is_round:
        mass = density * np.pi * (half * half)
        moment = mass * (half * half) / 2.0
    else:
        put_corners(solids, p + OWN_CORNER, -half, -half, half, half)
        mass = density * (size * size)
        moment = mass * (size * size + size * size) / 12.0
    solids[p + CORNERS], solids[p + RADIUS], solids[p + MADE] = (1.0 if tables.loose[i].is_round else 4.0), half, size
    solids[p + MASS_INV], solids[p + MOMENT_INV] = 1.0 / mass, 1.0 / moment
    solids[p + ROUGHNESS] = world.numbers[tables.loose[i].friction, lane]
    solids[p + NUMBER] = tables.loose[i].number


def wake(solids, asleep, holds):
    """Wake what is asleep where something awake comes near, and what that comes near."""
    a, count = FIRST_LOOSE, len(asleep)
    while a < count:
        b = ROBOT
        while asleep[a] == 1 and b < count:
            if asleep[b] == 0 and (b != HELD or holds) and overlap(solids, a, b):
                asleep[a], a = 0, FIRST_LOOSE - 1
            b += 1
        a += 1


def gather(tables, world, contact, lane):
    """Write down what is awake, in the order in which Chipmunk's hash has it."""
    awake, constants, held = contact.awake[lane], tables.world[0], world.held[lane]
    is_held_first = held >= 0 and tables.things[held].turn < constants.turn
    count = 0
    if is_held_first:
        awake[count], count = HELD, count + 1
    for i in range(len(tables.loose)):
        if tables.loose[i].turn < constants.turn and contact.asleep[lane, FIRST_LOOSE + i] == 0:
            awake[count], count = FIRST_LOOSE + i, count + 1
    awake[count], count = ROBOT, count + 1
    if held >= 0 and not is_held_first:
        awake[count], count = HELD, count + 1
    for i in range(len(tables.loose)):
        if tables.loose[i].turn > constants.turn and contact.asleep[lane, FIRST_LOOSE + i] == 0:
            awake[count], count = FIRST_LOOSE + i, count + 1
    contact.space[lane, AWAKE] = count


def take_robot(world, solids, lane):
    """Take the place and the motion of a lane's robot from its solid."""
    body, p = world.body, SOLID_COLUMNS * ROBOT
    body[X, lane], body[Y, lane] = solids[p + MIDDLE_X], solids[p + MIDDLE_Y]
    body[SPEED_X, lane], body[SPEED_Y, lane], body[SPIN, lane] = solids[p + VX], solids[p + VY], solids[p + VSPIN]


@OF_LOOSE
def take_loose(tables: Tables, world: WorldState, contact: ContactState, lane: int) -> None:
    """Take the places and motions of the loose things that were awake; what has moved has not settled."""
    solids, asleep = contact.solids[lane], contact.asleep[lane]
    for i in range(len(tables.loose)):
        a, row, thing = FIRST_LOOSE + i, LOOSE_ROWS * i, tables.loose[i].thing
        if asleep[a] == 1:
            continue
        p = SOLID_COLUMNS * a
        x, y, angle = solids[p + MIDDLE_X], solids[p + MIDDLE_Y], solids[p + TURNED]
        vx, vy, spin = solids[p + VX], solids[p + VY], solids[p + VSPIN]
        stood_x, stood_y = place_of(world.things, thing, lane)
        rests = is_at_rest(vx, vy, spin)
        if not (rests and stood_x == x and stood_y == y and world.loose[row + TURN, lane] == angle):
            world.still[i, lane], world.restless[lane] = 0, 1
        is_settled = world.still[i, lane] >= SETTLED_TICKS
        asleep[a] = 1 if is_settled and is_motionless(solids, p) else 0
        put_thing(world.things, thing, x, y, lane)
        world.loose[row + TURN, lane] = angle
        put_motion(world.loose, row, vx, vy, spin, rests, lane)
    keep_awake(contact.pairs[lane], asleep, int(contact.space[lane, TOUCHING]))


def keep_awake(pairs, asleep, count):
    """Let nothing fall asleep that is pushed, or is to be parted."""
    for i in range(count):
        pair = PAIR_COLUMNS * i
        for k in range(int(pairs[pair + CONTACTS])):
            c = pair + CONTACT + CONTACT_COLUMNS * k
            if not (pairs[c + PARTING] == 0.0 and pairs[c + ALONG] == 0.0 and pairs[c + ACROSS] == 0.0):
                asleep[int(pairs[pair + OWN]) // SOLID_COLUMNS] = 0
                asleep[int(pairs[pair + OTHER]) // SOLID_COLUMNS] = 0


def is_motionless(solids, p):
    """True if nothing moves a solid on or turns it in the next step."""
    moved = 0
    for column in range(p + VX, p + AWAY_SPIN + 1):
        moved += solids[column] != 0.0
    return moved == 0
