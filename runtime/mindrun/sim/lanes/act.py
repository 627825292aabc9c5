"""Act: the commands that the influence makes (Eq. 3), their delays, and the claw; the memories when all is done."""

import numpy as np

from mindrun.kinds.memory import UNDRIVEN_COMMAND
from mindrun.numbers.arithmetic import *
from mindrun.sim.codes import GRIPPER, ITEM, SERVO, Tables
from mindrun.sim.kind_lanes import remember
from mindrun.sim.lanes.placement import OF_SEVERAL
from mindrun.sim.lanes.solid import CLOSED_UNITS, comes_nearer, is_barred, is_blocked, is_walled
from mindrun.sim.state import State, WorldState
from mindrun.sim.units import unit, unit_where

STANDING_UNITS = 1e-3  # a second: what rolls more slowly stands still


@unit
def act(tables: Tables, state: State, lanes: int) -> None:
    """Compute the commands as they act in this tick, and close or open the claw."""
    mind, world, faults = state.mind, state.world, state.run.faults
    for i in range(len(tables.actuators)):
        actuator, commands = tables.actuators[i], mind.commands[i]
        means(mind.command_sums[i], mind.influence_sums[i], actuator.neutral, commands, faults, lanes)
        if actuator.delay > 0:
            wait(tables, state, i, lanes)
        for lane in range(lanes):
            world.acting[i, lane] = commands[lane]
        if actuator.is_rough:
            disturb(tables, state, i, lanes)
        if actuator.is_slipping:
            for lane in range(lanes):
                slip = world.numbers[actuator.slip, lane]
                world.grip[i, lane] = 1.0 - slip * uniform(world.random, lane, 0.0, 1.0)
        if actuator.is_sticky:
            stick(tables, state, i, lanes)
        if actuator.kind == GRIPPER:
            grip(tables, state, i, lanes)
        if actuator.kind == SERVO:
            turn(tables, state, i, lanes)


def recall(tables, state, lanes):
    """Update the memories for the next tick; rewards of this one have read them as its skills did."""
    mind, faults = state.mind, state.run.faults
    for i in range(len(tables.memories)):
        memory, sink = tables.memories[i], len(tables.actuators) + i
        means(mind.command_sums[sink], mind.influence_sums[sink], F(UNDRIVEN_COMMAND), mind.sent, faults, lanes)
        remember(memory.lane, tables, mind, memory, lanes)


def means(total, weight, neutral, out, faults, lanes):
    """Write the influence-weighted mean of the commands (Eq. 3) to `out`; `neutral` where there are none.

    A mean that is no finite number, because sums overflowed, is a fault and gives `neutral` too.
    """
    for lane in range(lanes):
        driven = weight[lane] != ZERO  # NaN too, where influence overflowed
        value = total[lane] / (weight[lane] if driven else ONE)
        sound = finite(value)
        out[lane] = clamp(value) if driven & sound else neutral
        faults[lane] += 1 if driven & (not sound) else 0


@unit_where(lambda tables: (tables.actuators["delay"] > 0).any())
def wait(tables: Tables, state: State, i: int, lanes: int) -> None:
    """Exchange each command of actuator i with one that has waited in the ring, as its own lane's delay says."""
    actuator, commands, late = tables.actuators[i], state.mind.commands[i], state.mind.late
    for lane in range(lanes):
        delay = int(state.world.numbers[actuator.wait, lane])
        if delay > 0:
            slot = actuator.ring + state.world.tick[lane] % delay
            commands[lane], late[slot, lane] = late[slot, lane], commands[lane]


@unit_where(lambda tables: tables.actuators["is_rough"].any())
def disturb(tables: Tables, state: State, i: int, lanes: int) -> None:
    """Let each command of actuator i act with some noise, or stuck at neutral."""
    world, actuator = state.world, tables.actuators[i]
    acting, noise, stuck = world.acting[i], world.numbers[actuator.noise], world.numbers[max(actuator.fails, 0)]
    for lane in range(lanes):
        if actuator.is_noisy:
            acting[lane] = clamp(acting[lane] + F(noise[lane]) * F(uniform(world.random, lane, -1.0, 1.0)))
        if actuator.fails >= 0 and world.tick[lane] >= stuck[lane]:
            acting[lane] = actuator.neutral


@unit_where(lambda tables: tables.actuators["is_sticky"].any())
def stick(tables: Tables, state: State, i: int, lanes: int) -> None:
    """Let actuator i keep nothing of its force where it stands still and its command is too small to start it."""
    world, actuator, body, heading = state.world, tables.actuators[i], state.world.body, state.world.heading
    commands, kept, starts = world.acting[i], world.grip[i], world.numbers[actuator.starts]
    for lane in range(lanes):
        vx, vy, spin = motion_of(body, lane)
        ahead = vx * heading[COSINE, lane] + vy * heading[SINE, lane]
        rolls = abs(ahead + actuator.arm * spin) >= STANDING_UNITS
        starts_now = abs(2.0 * np.float64(commands[lane]) - 1.0) >= starts[lane]
        share = kept[lane] if actuator.is_slipping else 1.0
        kept[lane] = share if rolls or starts_now else 0.0


@unit_where(lambda tables: (tables.actuators["kind"] == SERVO).any())
def turn(tables: Tables, state: State, i: int, lanes: int) -> None:
    """Turn servo i towards its command, by no more than its speed."""
    world, actuator = state.world, tables.actuators[i]
    commands, angles = world.acting[i], world.swivel[i]
    for lane in range(lanes):
        most = world.numbers[actuator.speed, lane]
        left = (1.0 - 2.0 * np.float64(commands[lane])) * world.numbers[actuator.turn, lane] - angles[lane]
        angles[lane] += most if left > most else -most if left < -most else left


@unit_where(lambda tables: (tables.actuators["kind"] == GRIPPER).any())
def grip(tables: Tables, state: State, i: int, lanes: int) -> None:
    """Close above 0.5 on the first item in reach that can come into the claw; open and the item stays where it is.

    Of several robots the nearest to an item has it, of equally near ones the first.
    """
    world, kinds, commands, robots = state.world, tables.things, state.world.acting[i], len(tables.robots)
    held, things, changing = world.held, world.things, 0
    for lane in range(lanes):
        changing += (commands[lane] > HALF) != (held[lane] >= 0)
    for lane in range(lanes if changing > 0 else 0):
        if commands[lane] <= HALF and held[lane] >= 0:
            x, y = place_of(things, held[lane], lane)
            put_thing(things, held[lane], x, y, lane - lane % robots)
            held[lane] = -1
    for home in range(0, lanes if changing > 0 else 0, robots):
        wanting = 0
        for lane in range(home, home + robots):
            wanting += 1 if commands[lane] > HALF and held[lane] < 0 else 0
        for k in range(len(kinds) if wanting > 0 else 0):
            taker, nearest = -1, np.inf
            for lane in range(home, home + (robots if kinds[k].kind == ITEM else 0)):
                if commands[lane] > HALF and held[lane] < 0 and can_take(tables, world, i, k, lane):
                    x, y = place_of(things, k, lane)
                    far = (x - world.body[X, lane]) ** 2 + (y - world.body[Y, lane]) ** 2
                    taker, nearest = (lane, far) if far < nearest else (taker, nearest)
            if taker >= 0:
                held[taker] = k


def can_take(tables, world, i, k, lane):
    """True if item k is in reach of claw i, and can come into it."""
    front, reach = tables.world[0].front, tables.actuators[i].reach
    is_near = in_claw(world.body, world.heading, world.things, front, reach, k, lane)
    return is_near and has_room(tables, world, k, lane)


def has_room(tables, world, i, lane):
    """True if nothing solid is between the robot and the rim of item i in its claw, or in the item's way there."""
    hold, cosine, sine = tables.things[i].hold, world.heading[COSINE, lane], world.heading[SINE, lane]
    x, y = place_of(world.things, i, lane)
    half, (own_x, own_y) = size_of(world.things, i, lane) / 2, middle_of(world.body, lane)
    to_x, to_y = own_x + cosine * hold, own_y + sine * hold
    if len(tables.robots) > 1 and meets_robot(tables, world, i, to_x, to_y, lane):
        return False
    for from_x, from_y in ((own_x, own_y), (x, y)):
        if is_barred(world.boxes, tables.world[0], from_x, from_y, to_x, to_y, CLOSED_UNITS, lane):
            return False
        if is_blocked(tables, world, from_x, from_y, to_x, to_y, lane):
            return False
    for ahead, aside in ((1.0, 0.0), (0.0, 1.0), (0.0, -1.0)):
        rim_x, rim_y = ahead * cosine - aside * sine, ahead * sine + aside * cosine
        if is_walled(world.boxes, own_x, own_y, to_x + half * rim_x, to_y + half * rim_y, lane):
            return False
    return True


@OF_SEVERAL
def meets_robot(tables: Tables, world: WorldState, i: int, to_x: float, to_y: float, lane: int) -> int:
    """True if item i would meet another robot, or what that holds, on its way to a place in the claw of a lane."""
    robots, things = len(tables.robots), world.things
    (x, y), half = place_of(things, i, lane), size_of(things, i, lane) / 2
    home, found = lane - lane % robots, False
    for other in range(home, home + robots):
        if other != lane:
            its_x, its_y = middle_of(world.body, other)
            found = found or comes_to(its_x, its_y, x, y, to_x, to_y, half + tables.world[0].radius)
            if world.held[other] >= 0:
                its_x, its_y = place_of(things, world.held[other], other)
                gap = half + size_of(things, world.held[other], other) / 2
                found = found or comes_to(its_x, its_y, x, y, to_x, to_y, gap)
    return found


def comes_to(its_x, its_y, x, y, to_x, to_y, near):
    """True if a way between two places begins or ends nearer than `near` to another, or comes nearer on the way."""
    dx, dy, from_x, from_y = its_x - to_x, its_y - to_y, its_x - x, its_y - y
    is_near = dx * dx + dy * dy < near * near or from_x * from_x + from_y * from_y < near * near
    return is_near or comes_nearer(from_x, from_y, to_x - x, to_y - y, near)


def carry(world, kinds, lanes):
    """Move a held item with the claw."""
    body, heading = world.body, world.heading
    for lane in range(lanes):
        if world.held[lane] >= 0:
            ahead = kinds[world.held[lane]].hold
            x, y = middle_of(body, lane)
            x, y = x + heading[COSINE, lane] * ahead, y + heading[SINE, lane] * ahead
            put_thing(world.things, world.held[lane], x, y, lane)
