"""What moves in a lane on its way into a step and out of it: where it stands, how it is turned, how fast it is.

A solid that has settled and touches nothing that it would push, or be pushed by, is **asleep**: until something awake
comes so near that the rectangles around both meet, a step changes nothing of it, and it takes no part.
"""

import numpy as np

from mindrun.kinds.bodies.body import FRICTION_COEFFICIENT
from mindrun.numbers.arithmetic import *
from mindrun.sim import c_library
from mindrun.sim.codes import FORCE_X, FORCE_Y, TORQUE, Tables
from mindrun.sim.lanes.loose import OF_LOOSE, SETTLED_TICKS, is_at_rest, mass_of, put_drift
from mindrun.sim.lanes.solid import drift_of, first_loose, loose_place, loose_size, own_solid, turn_of
from mindrun.sim.state import FIXED, PLACE_ROWS, ROBOT, ContactState, WorldState
from mindrun.sim.units import call_double


def open_space(tables, world, contact, lane):
    """Begin anew in a world: nothing is remembered."""
    space, solids = contact.space[lane], contact.solids[lane]
    space.steps, space.pairs = 0, 0
    for i in range(contact.order.shape[1]):
        contact.order[lane, i] = i
    for a in range(len(solids)):
        solid = solids[a]
        solid.is_asleep, solid.made, solid.turned, solid.cosine, solid.sine = 0, 0.0, 0.0, 1.0, 0.0
        solid.bias.x, solid.bias.y, solid.bias.spin = 0.0, 0.0, 0.0
        solid.body, solid.robot = a, -1
    for i in range(len(tables.loose)):
        solids[first_loose(tables) + i].turn = tables.loose[i].number % tables.world[0].hash_size
    solids[FIXED].friction = 1.0
    for number in range(len(tables.robots)):
        make_robot(tables, world, solids, number, lane + number)


def make_robot(tables, world, solids, number, lane):
    """Let two solids be those of the robot with a number, whose lane is given, and of what it holds."""
    constants = tables.world[0]
    robot, held, x, y = solids[own_solid(number)], solids[own_solid(number) + 1], constants.front, constants.side
    held.is_round, held.friction = 1, FRICTION_COEFFICIENT
    held.body, held.robot, robot.robot = own_solid(number), number, number
    robot.turn = (constants.number + number) % constants.hash_size
    robot.is_round, robot.radius, robot.number = constants.is_round, constants.radius, constants.number + number
    robot.friction = world.numbers[constants.friction, lane]
    robot.mass_inv = world.numbers[constants.mass_inv, lane]
    robot.moment_inv = world.numbers[constants.moment_inv, lane]
    put_corners(robot.own_corners, -x, -y, x, y)


def move_robot(tables, world, robot, held_solid, seconds, share, lane):
    """Move the robot of a lane on with what it holds, and let its force act."""
    body, push, held = world.body, world.push, world.held[lane]
    speed = robot.velocity
    speed.x, speed.y, speed.spin = motion_of(body, lane)
    x, y, angle = pose_of(body, lane)
    angle = move(robot, x, y, angle, seconds)
    body[ANGLE, lane] = angle
    speed.x += push[FORCE_X, lane] * share * robot.mass_inv * seconds
    speed.y += push[FORCE_Y, lane] * share * robot.mass_inv * seconds
    speed.spin += push[TORQUE, lane] * share * robot.moment_inv * seconds
    if not robot.is_round:
        turn(tables, robot, angle)
    put_shape(robot, robot.middle_x, robot.middle_y)
    if held >= 0:
        turn(tables, robot, angle)
        put_held(tables, robot, held_solid, held, size_of(world.things, held, lane) / 2)
        number = tables.things[held].number + held_solid.robot * tables.world[0].items
        held_solid.turn = number % tables.world[0].hash_size


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
        solid = contact.solids[lane, first_loose(tables) + i]
        if solid.is_asleep:
            continue
        x, y = loose_place(tables, world, i, lane)
        if np.isnan(x):  # gone
            solid.is_asleep, solid.left, solid.right = 1, np.inf, -np.inf
            continue
        size, speed = loose_size(tables, world, i, lane), solid.velocity
        if solid.made != size:
            make(tables, world, solid, i, size, lane)
        speed.x, speed.y, speed.spin = drift_of(loose, i, lane)
        angle = move(solid, x, y, turn_of(loose, i, lane), seconds)
        if tables.loose[i].aim != 0:
            speed.x += world.drive[PLACE_ROWS * i + X, lane] * share * solid.mass_inv * seconds
            speed.y += world.drive[PLACE_ROWS * i + Y, lane] * share * solid.mass_inv * seconds
        if not solid.is_round:
            turn(tables, solid, angle)
        solid.turned = angle
        put_shape(solid, solid.middle_x, solid.middle_y)
    wake(world, contact, first_loose(tables), lane)


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


def wake(world, contact, first, lane):
    """Wake loose solids, from number `first` on, where something awake comes near, and what these come near."""
    solids, a = contact.solids[lane], first
    while a < len(solids):
        b = ROBOT
        while solids[a].is_asleep and b < len(solids):
            if is_awake(world, contact, solids[b], b, lane) and overlap(solids[a], solids[b]):
                solids[a].is_asleep, a = 0, first - 1
            b += 1
        a += 1


def is_awake(world, contact, solid, a, lane):
    """True if solid `a` takes part in a step: not what sleeps, a claw that holds nothing, or a robot that flies."""
    if solid.robot < 0:
        return solid.is_asleep == 0
    own = lane + solid.robot
    return contact.near[own] > 0 and (solid.body == a or world.held[own] >= 0)


def gather(world, contact, lane):
    """Write down what is awake, in the order in which Chipmunk's hash has it."""
    solids, awake, count = contact.solids[lane], contact.awake[lane], 0
    for a in range(ROBOT, len(solids)):
        if is_awake(world, contact, solids[a], a, lane):
            k = count
            while k > 0 and solids[awake[k - 1]].turn > solids[a].turn:
                awake[k], k = awake[k - 1], k - 1
            awake[k], count = a, count + 1
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
        solid, thing = contact.solids[lane, first_loose(tables) + i], tables.loose[i].thing
        if solid.is_asleep:
            continue
        x, y, angle, speed = solid.middle_x, solid.middle_y, solid.turned, solid.velocity
        stood_x, stood_y = place_of(world.things, thing, lane)
        rests = is_at_rest(speed.x, speed.y, speed.spin)
        if not (rests and stood_x == x and stood_y == y and turn_of(world.loose, i, lane) == angle):
            world.still[i, lane], world.restless[lane] = 0, 1
        is_settled = world.still[i, lane] >= SETTLED_TICKS
        solid.is_asleep = 1 if is_settled and is_motionless(speed) and is_motionless(solid.bias) else 0
        put_thing(world.things, thing, x, y, lane)
        world.loose[LOOSE_ROWS * i + TURN, lane] = angle
        put_drift(world.loose, i, speed.x, speed.y, speed.spin, rests, lane)
    for i in range(contact.space[lane].touching):  # nothing falls asleep that is pushed, or is to be parted
        pair = contact.pairs[lane, contact.order[lane, i]]
        for k in range(pair.count):
            met = pair.contacts[k]
            if not (met.bias == 0.0 and met.along == 0.0 and met.across == 0.0):
                contact.solids[lane, pair.own].is_asleep, contact.solids[lane, pair.other].is_asleep = 0, 0


def is_motionless(motion):
    """True if a motion moves nothing on and turns nothing."""
    return motion.x == 0.0 and motion.y == 0.0 and motion.spin == 0.0


def put_corners(corners, left, low, right, top):
    """Write the corners of a rectangle."""
    corners[0].x, corners[0].y = left, low
    corners[1].x, corners[1].y = right, low
    corners[2].x, corners[2].y = right, top
    corners[3].x, corners[3].y = left, top


def turn(tables, solid, angle):
    """Note to which angle a solid is turned, with its sine and cosine by C."""
    if solid.turned != angle:
        solid.sine = call_double(tables.library[c_library.SINE], angle)
        solid.cosine = call_double(tables.library[c_library.COSINE], angle)
        solid.turned = angle


def put_shape(solid, x, y):
    """Write where the corners of a solid are, or its middle, and its sides."""
    if solid.is_round:
        radius = solid.radius
        solid.corners[0].x, solid.corners[0].y = x, y
        solid.left, solid.right, solid.low, solid.high = x - radius, x + radius, y - radius, y + radius
        return
    cosine, sine, left, right, low, high = solid.cosine, solid.sine, np.inf, -np.inf, np.inf, -np.inf
    for i in range(4):
        own = solid.own_corners[i]
        at_x, at_y = cosine * own.x + -sine * own.y + x, sine * own.x + cosine * own.y + y
        solid.corners[i].x, solid.corners[i].y = at_x, at_y
        left, right = left if left < at_x else at_x, right if right > at_x else at_x
        low, high = low if low < at_y else at_y, high if high > at_y else at_y
    solid.left, solid.right, solid.low, solid.high = left, right, low, high


def put_held(tables, robot, held, thing, radius):
    """Write the circle of a thing in the claw of a robot, which turns with it."""
    hold = tables.things[thing].hold
    held.radius, held.middle_x, held.middle_y = radius, robot.middle_x, robot.middle_y
    put_shape(held, robot.cosine * hold + robot.middle_x, robot.sine * hold + robot.middle_y)


def overlap(a, b):
    """True if the rectangles along the axes around two solids meet."""
    return a.left <= b.right and b.left <= a.right and a.low <= b.high and b.low <= a.high
