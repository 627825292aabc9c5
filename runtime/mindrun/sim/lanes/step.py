"""Step: one tick of physics. Free flight is plain arithmetic in Chipmunk's order; Chipmunk steps what could touch.

Walkers touch nothing: they are plain arithmetic, too.
"""

import numpy as np

from mindrun.numbers.arithmetic import *
from mindrun.sim.codes import FORCE, FORCE_ASIDE, FORCE_X, FORCE_Y, ITEM, PUSH, SLOPE, STEERING, TORQUE, Tables
from mindrun.sim.lanes.act import carry
from mindrun.sim.lanes.loose import approach_loose, could_touch, slide, slow_down, wanted_way
from mindrun.sim.lanes.placement import at_drawn
from mindrun.sim.lanes.sense import CULLING_SLACK_UNITS
from mindrun.sim.lanes.sharing import CONTACT_MARGIN_UNITS, CONTACT_TICKS, join, share
from mindrun.sim.lanes.solid import CLOSED_UNITS, find_swift, is_barred, is_free, within
from mindrun.sim.lanes.strides import make_tick
from mindrun.sim.state import State, WorldState
from mindrun.sim.units import unit, unit_where


@unit
def step(tables: Tables, state: State, lanes: int) -> None:
    """Damp, push and move the robots and the loose things; then headings, held items and walkers follow."""
    world, contact, constants = state.world, state.contact, tables.world[0]
    thrust(tables, world, lanes)
    for lane in range(0, lanes if len(tables.loose) > 0 else 0, len(tables.robots)):
        if world.restless[lane] > 0:
            slow_down(tables, world, contact, lane)
    find_near(tables, world, state.sight, contact, lanes)
    if len(tables.robots) > 1:
        join(tables, world, contact, lanes)
    fly(world, contact.near, constants, lanes)
    for lane in range(lanes):
        contact.touching[lane] = contact.touching[lane] << 1 & 3  # bit 0 this tick, bit 1 the tick before
    for home in range(0, lanes, len(tables.robots)):
        near = 0
        for lane in range(home, home + len(tables.robots)):
            near = max(near, contact.near[lane])
        if near > 0:
            make_tick(tables, world, contact, home)
        elif world.restless[home] > 0:
            slide(tables, world, home)
    for lane in range(lanes):
        world.heading[SINE, lane], world.heading[COSINE, lane] = sine_cosine(world.body[ANGLE, lane])
    carry(world, tables.things, lanes)
    if constants.slopes > 0:
        slide_down(tables, world, lanes)
    if len(tables.walkers) > 0:
        walk(tables, world, lanes)
    if len(tables.robots) > 1:
        share(tables, world, lanes)


def thrust(tables, world, lanes):
    """Damp the body's velocities, a car's as its axles let it move, and sum force and torque in `push`."""
    body, heading, push, constants, is_aside = world.body, world.heading, world.push, tables.world[0], False
    push[:, :lanes] = 0.0
    for i in range(len(tables.actuators)):
        actuator = tables.actuators[i]
        if actuator.kind == PUSH:
            drive(world.acting[i], actuator, world.numbers[actuator.thrust], world.grip[i], push, lanes)
            is_aside |= actuator.aside != 0.0
    linear, angular = world.numbers[constants.linear], world.numbers[constants.angular]
    for lane in range(lanes):  # by 1 / (1 + dt·c), as JBox2D does; and the force turns into the world's axes
        body[SPEED_X, lane] = body[SPEED_X, lane] * linear[lane]
        body[SPEED_Y, lane] = body[SPEED_Y, lane] * linear[lane]
        body[SPIN, lane] = body[SPIN, lane] * angular[lane]
        push[FORCE_X, lane] = push[FORCE, lane] * heading[COSINE, lane]
        push[FORCE_Y, lane] = push[FORCE, lane] * heading[SINE, lane]
    for lane in range(lanes if is_aside else 0):
        push[FORCE_X, lane] -= push[FORCE_ASIDE, lane] * heading[SINE, lane]
        push[FORCE_Y, lane] += push[FORCE_ASIDE, lane] * heading[COSINE, lane]
    if constants.slopes > 0:
        draw_down(tables, world, lanes)
    if constants.axles > 0.0:
        roll(tables, world, lanes)


OF_SLOPES = unit_where(lambda tables: (tables.things["kind"] == SLOPE).any())


@OF_SLOPES
def draw_down(tables: Tables, world: WorldState, lanes: int) -> None:
    """Add the force with which slopes draw down robots whose middle is on them to `push`."""
    for i in range(len(tables.things)):
        for lane in range(lanes if tables.things[i].kind == SLOPE else 0):
            x, y = middle_of(world.body, lane)
            if inside(world.things, i, x, y, lane):
                world.push[FORCE_X, lane] += tables.things[i].pull_x
                world.push[FORCE_Y, lane] += tables.things[i].pull_y


@OF_SLOPES
def slide_down(tables: Tables, world: WorldState, lanes: int) -> None:
    """Let items that nobody holds slide down the slopes on which they lie: the first of these, in their order."""
    for k in range(len(tables.things)):
        for home in range(0, lanes if tables.things[k].kind == ITEM else 0, len(tables.robots)):
            x, y = place_of(world.things, k, home)
            slides = world.held[home] != k
            for i in range(len(tables.things)):
                if slides and tables.things[i].kind == SLOPE and inside(world.things, i, x, y, home):
                    put_thing(world.things, k, x + tables.things[i].slide_x, y + tables.things[i].slide_y, home)
                    slides = False


def drive(commands, actuator, strength, kept, push, lanes):
    """Add an actuator's force (2v − 1)·thrust, less what slips, and its torque to `push`."""
    ahead, aside, arm, slips = actuator.ahead, actuator.aside, actuator.arm, actuator.is_slipping | actuator.is_sticky
    for lane in range(lanes):
        pushed = (2.0 * commands[lane] - 1.0) * strength[lane]
        pushed *= kept[lane] if slips else 1.0
        push[FORCE, lane] += ahead * pushed
        push[FORCE_ASIDE, lane] += aside * pushed
        push[TORQUE, lane] += arm * pushed


@unit_where(lambda tables: tables.world[0]["axles"] > 0)
def roll(tables: Tables, world: WorldState, lanes: int) -> None:
    """Replace a car's velocity by the one nearest to it, in kinetic energy, that its axles allow: v ahead,
    v·tan δ / 2 to the left and a turn of v·tan δ / distance of the axles.
    """
    body, heading, constants = world.body, world.heading, tables.world[0]
    moment, mass_inv = world.numbers[constants.moment], world.numbers[constants.mass_inv]
    for lane in range(lanes):
        inertia = moment[lane] * mass_inv[lane]
        sine, cosine = sine_cosine(steered(tables, world, lane))
        aside, turn = sine / cosine / 2.0, sine / cosine / constants.axles
        c, s = heading[COSINE, lane], heading[SINE, lane]
        vx, vy, spin = motion_of(body, lane)
        speed = vx * c + vy * s + (vy * c - vx * s) * aside + spin * turn * inertia
        speed /= 1.0 + aside * aside + turn * turn * inertia
        body[SPEED_X, lane] = speed * c - speed * aside * s
        body[SPEED_Y, lane] = speed * s + speed * aside * c
        body[SPIN, lane] = speed * turn


def steered(tables, world, lane):
    """The angle by which a car's front wheels are turned to the left."""
    angle = 0.0
    for i in range(len(tables.actuators)):
        actuator = tables.actuators[i]
        if actuator.kind == STEERING:
            angle = (1.0 - 2.0 * world.acting[i, lane]) * world.numbers[actuator.turn, lane]
    return angle


def fly(world, near, constants, lanes):
    """Make Chipmunk's step of a body that touches nothing: move with the old velocity, then add force and torque.

    A lane that Chipmunk will step keeps its state.
    """
    body, push, dt = world.body, world.push, constants.dt
    mass_inv, moment_inv = world.numbers[constants.mass_inv], world.numbers[constants.moment_inv]
    for lane in range(lanes):
        free = near[lane] == 0
        (x, y, angle), (speed_x, speed_y, spin) = pose_of(body, lane), motion_of(body, lane)
        body[X, lane] = x + speed_x * dt if free else x
        body[Y, lane] = y + speed_y * dt if free else y
        body[ANGLE, lane] = angle + spin * dt if free else angle
        body[SPEED_X, lane] = speed_x + push[FORCE_X, lane] * mass_inv[lane] * dt if free else speed_x
        body[SPEED_Y, lane] = speed_y + push[FORCE_Y, lane] * mass_inv[lane] * dt if free else speed_y
        body[SPIN, lane] = spin + push[TORQUE, lane] * moment_inv[lane] * dt if free else spin


def find_near(tables, world, sight, contact, lanes):
    """Count down `near`, and begin anew where the robot or what it holds could touch something after this tick.

    A robot that would leave all places flies there alone.
    """
    body, near, gap, dt = world.body, contact.near, contact.gap, tables.world[0].dt
    half_x, half_y = tables.world[0].half_x, tables.world[0].half_y
    for lane in range(lanes):
        x, y = next_middle(body, dt, lane)
        x, y = half_x - abs(x), half_y - abs(y)
        gap[lane] = x if x < y else y
    if len(tables.loose) > 0:
        approach_loose(tables, world, contact, lanes)
    for k in range(sight.nearby_most[0]):
        approach(sight.nearby[BOX_COLUMNS * k : BOX_COLUMNS * (k + 1)], body, dt, gap, lanes)
    reach = tables.world[0].radius + CONTACT_MARGIN_UNITS
    for lane in range(lanes):
        x, y = next_middle(body, dt, lane)
        away = (x - sight.anchor[X, lane]) ** 2 + (y - sight.anchor[Y, lane]) ** 2
        leap = away > CULLING_SLACK_UNITS * CULLING_SLACK_UNITS  # away from the boxes it knows
        near[lane] = CONTACT_TICKS if leap | (gap[lane] < reach) else max(0, near[lane] - 1)
    for lane in range(lanes):
        held = world.held[lane]
        if held >= 0:  # how far from the robot's centre that could touch something
            reach = tables.things[held].hold + size_of(world.things, held, lane) / 2 + CONTACT_MARGIN_UNITS
            near[lane] = CONTACT_TICKS if gap[lane] < reach else near[lane]
    for lane in range(lanes if len(tables.loose) > 0 else 0):
        if world.restless[lane] > 0 and could_touch(tables, world, lane):
            near[lane] = CONTACT_TICKS
    for lane in range(lanes):
        x, y = next_middle(body, dt, lane)
        there = within(x, y, body[ANGLE, lane] + body[SPIN, lane] * dt)
        near[lane] = near[lane] if there else 0
    if find_swift(tables, world, contact.swift, lanes) > 0:
        for lane in range(lanes):
            near[lane] = CONTACT_TICKS if contact.swift[lane - lane % len(tables.robots)] > 0 else near[lane]


def approach(box, body, dt, gap, lanes):
    """Lower `gap` to the distance along the axes between the robot's next centre and a box of each lane."""
    for lane in range(lanes):
        x, y = next_middle(body, dt, lane)
        x, y = abs(x - box[X, lane]) - box[HALF_X, lane], abs(y - box[Y, lane]) - box[HALF_Y, lane]
        far = x if x > y else y
        gap[lane] = far if far < gap[lane] else gap[lane]


@unit_where(lambda tables: len(tables.walkers) > 0)
def walk(tables: Tables, world: WorldState, lanes: int) -> None:
    """Let every walker that has not vanished take its step."""
    for i in range(len(tables.walkers)):
        for lane in range(0, lanes, len(tables.robots)):
            x, y = place_of(world.things, tables.walkers[i].thing, lane)
            if np.isnan(x):
                continue
            if tables.walkers[i].ways > 0:
                go_along(tables, world, i, x, y, lane)
            elif tables.walkers[i].aim == 0 or not chase(tables, world, i, x, y, lane):
                wander(tables, world, i, x, y, lane)


def chase(tables, world, i, x, y, lane):
    """Step straight towards the nearest that a walker seeks, or away from what it flees; True if it could."""
    walker = tables.walkers[i]
    dx, dy = wanted_way(world, len(tables.robots), walker, x, y, lane)
    if np.isnan(dx) or (dx == 0.0 and dy == 0.0):
        return not np.isnan(dx)
    step, half = world.numbers[walker.step, lane], size_of(world.things, walker.thing, lane) / 2
    if not may_step(tables, world, step, x, y, x + dx, y + dy, half, lane):
        return False
    put_thing(world.things, walker.thing, x + dx, y + dy, lane)
    return True


def wander(tables, world, i, x, y, lane):
    """Step ahead, and let the direction drift; where that is not free, stand and face anywhere."""
    sine, cosine = sine_cosine(world.direction[i, lane])
    walker = tables.walkers[i]
    step, half = world.numbers[walker.step, lane], size_of(world.things, walker.thing, lane) / 2
    to_x, to_y = x + cosine * step, y + sine * step
    if may_step(tables, world, step, x, y, to_x, to_y, half, lane):
        put_thing(world.things, walker.thing, to_x, to_y, lane)
        turn = world.numbers[walker.turn, lane]
        world.direction[i, lane] += uniform(world.random, lane, -turn, turn)
    else:
        world.direction[i, lane] = uniform(world.random, lane, 0.0, 2 * np.pi)


def may_step(tables, world, step, x, y, to_x, to_y, half, lane):
    """True if a square of half side `half` is free to step; its middle alone, where it has no room already.

    What steps by no more than a quarter of its side passes nothing where it arrives free.
    """
    boxes, constants = world.boxes, tables.world[0]
    if not (within(x, y, 0.0) and is_free(tables, world, x, y, half, lane)):
        return not is_barred(boxes, constants, x, y, to_x, to_y, CLOSED_UNITS, lane)
    if not (within(to_x, to_y, 0.0) and is_free(tables, world, to_x, to_y, half, lane)):
        return False
    return step <= half / 2 or not is_barred(boxes, constants, x, y, to_x, to_y, half, lane)


def go_along(tables, world, i, x, y, lane):
    """Step towards the next place of its way; where it would come past that, stop there for this tick."""
    walker, goal = tables.walkers[i], world.goal[i, lane]
    step = world.numbers[walker.step, lane]
    to_x, to_y = at_drawn(world, tables.corners[goal], lane)
    dx, dy = to_x - x, to_y - y
    far = length(dx, dy)
    if far <= step:
        put_thing(world.things, walker.thing, to_x, to_y, lane)
        world.goal[i, lane] = tables.corners[goal].next
    else:
        share = step / far
        put_thing(world.things, walker.thing, x + dx * share, y + dy * share, lane)
