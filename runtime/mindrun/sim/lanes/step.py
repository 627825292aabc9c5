"""Step: one tick of physics. Free flight is plain arithmetic in Chipmunk's order; Chipmunk steps what could touch."""

from mindrun.arithmetic import (
    ANGLE,
    BOX_COLUMNS,
    COSINE,
    HALF_SIDE,
    SINE,
    SIZE,
    SPEED_X,
    SPEED_Y,
    SPIN,
    THING_ROWS,
    X,
    Y,
)
from mindrun.sim.arithmetic import sine_cosine
from mindrun.sim.codes import FAR, FORCE, FORCE_X, FORCE_Y, TORQUE, WHEEL_LEFT, WHEEL_RIGHT
from mindrun.sim.compiling import compiled
from mindrun.sim.lanes.act import carry
from mindrun.sim.lanes.chipmunk import open_space, push_body, step_space
from mindrun.sim.lanes.sense import CULLING_SLACK_UNITS

CONTACT_MARGIN_UNITS = 0.01  # beyond the rounding of any distance here
CONTACT_TICKS = 5  # Chipmunk forgets a contact after three


@compiled
def step(t, s, n):
    """Damp, push with the wheels, move; then the headings and the held items follow."""
    world = t.world[0]
    thrust(t, s, n)
    find_near(t, s, n)
    fly(s.body, s.push, s.near, world.dt, world.mass_inv, world.moment_inv, n)
    for p in range(n):
        s.touching[p] <<= 1  # bit 0 this tick, bit 1 the tick before
        s.touching[p] &= 3
        if s.near[p] > 0:
            if s.handles[p, 0] == 0:
                open_space(t, s, p)
            push_body(t, s, p)
            if step_space(t, s, p, world.dt) > 0:
                s.touching[p] |= 1
    for p in range(n):
        s.heading[SINE, p], s.heading[COSINE, p] = sine_cosine(s.body[ANGLE, p])
    carry(s.held, s.body, s.heading, s.things, t.things, n)


@compiled
def thrust(t, s, n):
    """Damped velocities into the body; force and torque into `push`."""
    world = t.world[0]
    s.push[:2, :n] = 0.0
    for i in range(len(t.actuators)):
        actuator = t.actuators[i]
        if actuator.kind == WHEEL_LEFT:
            wheel(s.commands[i], actuator.thrust, s.push[FORCE], s.push[TORQUE], -world.radius, n)
        elif actuator.kind == WHEEL_RIGHT:
            wheel(s.commands[i], actuator.thrust, s.push[FORCE], s.push[TORQUE], world.radius, n)
    damp(s.body, s.heading, s.push, world.linear, world.angular, n)


@compiled
def wheel(commands, strength, force, torque, arm, n):
    """(2v − 1)·thrust on the left (arm < 0) or right rim."""
    for p in range(n):
        f = (2.0 * commands[p] - 1.0) * strength
        force[p] += f
        torque[p] += arm * f


@compiled
def damp(body, heading, push, linear, angular, n):
    """v / (1 + dt·c), as JBox2D does; and the force turned into the world."""
    for p in range(n):
        body[SPEED_X, p] = body[SPEED_X, p] * linear
        body[SPEED_Y, p] = body[SPEED_Y, p] * linear
        body[SPIN, p] = body[SPIN, p] * angular
        push[FORCE_X, p] = push[FORCE, p] * heading[COSINE, p]
        push[FORCE_Y, p] = push[FORCE, p] * heading[SINE, p]


@compiled
def fly(body, push, near, dt, mass_inv, moment_inv, n):
    """Chipmunk's step of a body that touches nothing: move with the old velocity, then add force and torque.

    A lane that Chipmunk will step keeps its state.
    """
    for p in range(n):
        free = near[p] == 0
        body[X, p] = body[X, p] + body[SPEED_X, p] * dt if free else body[X, p]
        body[Y, p] = body[Y, p] + body[SPEED_Y, p] * dt if free else body[Y, p]
        body[ANGLE, p] = body[ANGLE, p] + body[SPIN, p] * dt if free else body[ANGLE, p]
        body[SPEED_X, p] = body[SPEED_X, p] + push[FORCE_X, p] * mass_inv * dt if free else body[SPEED_X, p]
        body[SPEED_Y, p] = body[SPEED_Y, p] + push[FORCE_Y, p] * mass_inv * dt if free else body[SPEED_Y, p]
        body[SPIN, p] = body[SPIN, p] + push[TORQUE, p] * moment_inv * dt if free else body[SPIN, p]


@compiled
def find_near(t, s, n):
    """Count down `near`, and begin anew where the robot or what it holds could touch something after this tick.

    A robot that would leave all places flies there alone.
    """
    world = t.world[0]
    reach = world.radius + CONTACT_MARGIN_UNITS
    gap = s.gap
    clearance(s.body, world.half, world.dt, gap, n)
    for k in range(s.slot_most[0]):
        approach(s.nearby[BOX_COLUMNS * k : BOX_COLUMNS * (k + 1)], s.body, world.dt, gap, n)
    for p in range(n):
        s.near[p] = max(0, s.near[p] - 1)
        if s.held[p] >= 0:
            thing = THING_ROWS * s.held[p]
            item_reach = t.things[s.held[p]].hold + s.things[thing + SIZE, p] / 2 + CONTACT_MARGIN_UNITS
            if gap[p] < item_reach:
                s.near[p] = CONTACT_TICKS
        x, y = s.body[X, p] + s.body[SPEED_X, p] * world.dt, s.body[Y, p] + s.body[SPEED_Y, p] * world.dt
        away = (x - s.anchor[X, p]) ** 2 + (y - s.anchor[Y, p]) ** 2
        leap = away > CULLING_SLACK_UNITS * CULLING_SLACK_UNITS  # away from the boxes it knows
        if leap or gap[p] < reach:
            s.near[p] = CONTACT_TICKS
        if not within(x, y, s.body[ANGLE, p] + s.body[SPIN, p] * world.dt):
            s.near[p] = 0


@compiled
def within(x, y, angle):
    """Whether Chipmunk can say anything of such a place; not where it is no number."""
    return (abs(x) <= FAR) & (abs(y) <= FAR) & (abs(angle) <= FAR)


@compiled
def is_lost(body, p):
    """Whether lane p's robot is where no world is."""
    return not within(body[X, p], body[Y, p], body[ANGLE, p])


@compiled
def clearance(body, half, dt, gap, n):
    """The distance between the robot's next centre and the walls."""
    for p in range(n):
        x, y = abs(body[X, p] + body[SPEED_X, p] * dt), abs(body[Y, p] + body[SPEED_Y, p] * dt)
        gap[p] = half - (x if x > y else y)


@compiled
def approach(box, body, dt, gap, n):
    """`gap` lowered to the distance along the axes between the robot's next centre and a box of each lane."""
    for p in range(n):
        x = abs(body[X, p] + body[SPEED_X, p] * dt - box[X, p]) - box[HALF_SIDE, p]
        y = abs(body[Y, p] + body[SPEED_Y, p] * dt - box[Y, p]) - box[HALF_SIDE, p]
        far = x if x > y else y
        gap[p] = far if far < gap[p] else gap[p]
