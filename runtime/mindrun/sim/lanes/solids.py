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
from mindrun.sim.codes import FORCE_X, FORCE_Y, TORQUE, Tables
from mindrun.sim.lanes.loose import OF_LOOSE, SETTLED_TICKS, is_at_rest, mass_of, put_motion
from mindrun.sim.lanes.shapes import overlap, put_corners, put_held, put_shape, turn
from mindrun.sim.state import FIRST_LOOSE, FIXED, HELD, PLACE_ROWS, ROBOT, ContactState, WorldState


def open_space(tables, world, contact, lane):
    """Begin anew in a lane: nothing is remembered."""
    constants, space, solids = tables.world[0], contact.space[lane], contact.solids[lane]
    space.steps, space.pairs = 0, 0
    for i in range(contact.order.shape[1]):
        contact.order[lane, i] = i
    for a in range(len(solids)):
        solid = solids[a]
        solid.is_asleep, solid.made, solid.turned, solid.cosine, solid.sine = 0, 0.0, 0.0, 1.0, 0.0
        solid.bias.x, solid.bias.y, solid.bias.spin = 0.0, 0.0, 0.0
    solids[FIXED].friction = 1.0
    solids[HELD].is_round, solids[HELD].friction = 1, FRICTION_COEFFICIENT
    robot, x, y = solids[ROBOT], constants.front, constants.side
    robot.is_round, robot.radius, robot.number = constants.is_round, constants.radius, constants.number
    robot.friction = world.numbers[constants.friction, lane]
    robot.mass_inv = world.numbers[constants.mass_inv, lane]
    robot.moment_inv = world.numbers[constants.moment_inv, lane]
    put_corners(robot.own_corners, -x, -y, x, y)


def move_robot(tables, world, contact, seconds, share, lane):
    """Move a lane's robot on with what it holds, and let its force act."""
    robot, body, push, held = contact.solids[lane, ROBOT], world.body, world.push, world.held[lane]
    speed = robot.velocity
    speed.x, speed.y, speed.spin = body[SPEED_X, lane], body[SPEED_Y, lane], body[SPIN, lane]
    angle = move(robot, body[X, lane], body[Y, lane], body[ANGLE, lane], seconds)
    body[ANGLE, lane] = angle
    speed.x += push[FORCE_X, lane] * share * robot.mass_inv * seconds
    speed.y += push[FORCE_Y, lane] * share * robot.mass_inv * seconds
    speed.spin += push[TORQUE, lane] * share * robot.moment_inv * seconds
    if not robot.is_round:
        turn(tables, robot, angle)
    put_shape(robot, robot.middle_x, robot.middle_y)
    if held >= 0:
        put_held(tables, world, contact, held, size_of(world.things, held, lane) / 2, lane)


def move(solid, x, y, angle, seconds):
    """Move a solid on from a place; return the angle to which it has turned."""
    speed, bias = solid.velocity, solid.bias
    solid.middle_x, solid.middle_y = x + (speed.x + bias.x) * seconds, y + (speed.y + bias.y) * seconds
    angle += (speed.spin + bias.spin) * seconds
    bias.x, bias.y, bias.spin = 0.0, 0.0, 0.0
    return angle


@OF_LOOSE
def move_loose(
    tables: Tables, world: WorldState, contact: ContactState, seconds: float, share: float, lane: int
) -> None:
    """Move the loose things of a lane on that are awake with a share of their force, and wake what they come near."""
    loose = world.loose
    for i in range(len(tables.loose)):
        solid, row = contact.solids[lane, FIRST_LOOSE + i], LOOSE_ROWS * i
        if solid.is_asleep:
            continue
        x, y = place_of(world.things, tables.loose[i].thing, lane)
        if np.isnan(x):  # gone
            solid.is_asleep, solid.left, solid.right = 1, np.inf, -np.inf
            continue
        size, speed = size_of(world.things, tables.loose[i].thing, lane), solid.velocity
        if solid.made != size:
            make(tables, world, solid, i, size, lane)
        speed.x, speed.y = loose[row + PUSHED_X, lane], loose[row + PUSHED_Y, lane]
        speed.spin = loose[row + PUSHED_SPIN, lane]
        angle = move(solid, x, y, loose[row + TURN, lane], seconds)
        if tables.loose[i].aim != 0:
            speed.x += world.drive[PLACE_ROWS * i + X, lane] * share * solid.mass_inv * seconds
            speed.y += world.drive[PLACE_ROWS * i + Y, lane] * share * solid.mass_inv * seconds
        if not solid.is_round:
            turn(tables, solid, angle)
        solid.turned = angle
        put_shape(solid, solid.middle_x, solid.middle_y)
    wake(contact.solids[lane], world.held[lane] >= 0)


def make(tables, world, solid, i, size, lane):
    """Give loose thing i a size, and with it its corners, its mass and its moment of inertia."""
    half, loose, mass = size / 2, tables.loose[i], mass_of(tables, world, i, lane)
    if loose.is_round:
        moment = mass * (half * half) / 2.0
    else:
        put_corners(solid.own_corners, -half, -half, half, half)
        moment = mass * (size * size + size * size) / 12.0
    solid.is_round, solid.radius, solid.made, solid.number = loose.is_round, half, size, loose.number
    solid.mass_inv, solid.moment_inv = 1.0 / mass, 1.0 / moment
    solid.friction = world.numbers[loose.friction, lane]


def wake(solids, holds):
    """Wake what is asleep where something awake comes near, and what that comes near."""
    a = FIRST_LOOSE
    while a < len(solids):
        b = ROBOT
        while solids[a].is_asleep and b < len(solids):
            if not solids[b].is_asleep and (b != HELD or holds) and overlap(solids[a], solids[b]):
                solids[a].is_asleep, a = 0, FIRST_LOOSE - 1
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
        if tables.loose[i].turn < constants.turn and not contact.solids[lane, FIRST_LOOSE + i].is_asleep:
            awake[count], count = FIRST_LOOSE + i, count + 1
    awake[count], count = ROBOT, count + 1
    if held >= 0 and not is_held_first:
        awake[count], count = HELD, count + 1
    for i in range(len(tables.loose)):
        if tables.loose[i].turn > constants.turn and not contact.solids[lane, FIRST_LOOSE + i].is_asleep:
            awake[count], count = FIRST_LOOSE + i, count + 1
    contact.space[lane].awake = count


def take_robot(world, robot, lane):
    """Take the place and the motion of a lane's robot from its solid."""
    body, speed = world.body, robot.velocity
    body[X, lane], body[Y, lane] = robot.middle_x, robot.middle_y
    body[SPEED_X, lane], body[SPEED_Y, lane], body[SPIN, lane] = speed.x, speed.y, speed.spin


@OF_LOOSE
def take_loose(tables: Tables, world: WorldState, contact: ContactState, lane: int) -> None:
    """Take the places and motions of the loose things that were awake; what has moved has not settled."""
    for i in range(len(tables.loose)):
        solid, row, thing = contact.solids[lane, FIRST_LOOSE + i], LOOSE_ROWS * i, tables.loose[i].thing
        if solid.is_asleep:
            continue
        x, y, angle, speed = solid.middle_x, solid.middle_y, solid.turned, solid.velocity
        stood_x, stood_y = place_of(world.things, thing, lane)
        rests = is_at_rest(speed.x, speed.y, speed.spin)
        if not (rests and stood_x == x and stood_y == y and world.loose[row + TURN, lane] == angle):
            world.still[i, lane], world.restless[lane] = 0, 1
        is_settled = world.still[i, lane] >= SETTLED_TICKS
        solid.is_asleep = 1 if is_settled and is_motionless(speed) and is_motionless(solid.bias) else 0
        put_thing(world.things, thing, x, y, lane)
        world.loose[row + TURN, lane] = angle
        put_motion(world.loose, row, speed.x, speed.y, speed.spin, rests, lane)
    keep_awake(contact.solids[lane], contact.pairs[lane], contact.order[lane], contact.space[lane].touching)


def keep_awake(solids, pairs, order, count):
    """Let nothing fall asleep that is pushed, or is to be parted."""
    for i in range(count):
        pair = pairs[order[i]]
        for k in range(pair.count):
            contact = pair.contacts[k]
            if not (contact.bias == 0.0 and contact.along == 0.0 and contact.across == 0.0):
                solids[pair.own].is_asleep, solids[pair.other].is_asleep = 0, 0


def is_motionless(motion):
    """True if a motion moves nothing on and turns nothing."""
    return motion.x == 0.0 and motion.y == 0.0 and motion.spin == 0.0
