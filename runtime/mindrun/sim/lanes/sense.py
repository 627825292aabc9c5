"""Sense: every reading of every lane, from the places of the robots and the things."""

import numpy as np

from mindrun.numbers.arithmetic import *
from mindrun.sim.codes import Tables
from mindrun.sim.kind_lanes import read
from mindrun.sim.lanes.solid import count_of, put_box, remove_box
from mindrun.sim.state import MindState, SightState, State, WorldState
from mindrun.sim.units import unit, unit_where

CULLING_SLACK_UNITS = 2.0  # how far a robot may move before the boxes near it are chosen anew


@unit
def sense(tables: Tables, state: State, lanes: int, clock: int) -> None:
    """Fill the rows of the sensors that somebody reads, in the order of the table (sources before derivatives)."""
    world, sight, mind = state.world, state.sight, state.mind
    for i in range(len(tables.things)):
        for lane in range(lanes):
            x, y = place_of(world.things, i, lane)
            far = length(x - world.body[X, lane], y - world.body[Y, lane])
            world.things[THING_ROWS * i + DISTANCE, lane] = far
    choose(world, sight, tables.world[0].near + CULLING_SLACK_UNITS, lanes)
    if tables.world[0].rays > 0:
        look(tables, world, sight, lanes)
        if len(tables.loose) > 0:
            look_at_loose(tables, world, sight, 0, len(tables.ray_row), lanes)
        if len(tables.robots) > 1:
            look_at_robots(tables, world, sight, 0, len(tables.ray_row), lanes)
    sight.nearest_of[0] = -1
    for i in range(len(tables.sensors)):
        sensor = tables.sensors[i]
        if sensor.servo >= 0:
            face(tables, world, sight, i, 1, lanes)
        read(sensor.lane, tables, state.senses, lanes, clock, sensor)
        if sensor.servo >= 0:
            face(tables, world, sight, i, 0, lanes)
        if sensor.is_rough:
            roughen(tables, world, mind, i, lanes)


@unit_where(lambda tables: (tables.sensors["servo"] >= 0).any())
def face(tables: Tables, world: WorldState, sight: SightState, i: int, is_turned: int, lanes: int) -> None:
    """Let the heading be that of the servo that sensor i is on, and its rays too; or the robot's own again."""
    sensor, angles = tables.sensors[i], world.swivel[tables.sensors[i].servo]
    for lane in range(lanes):
        angle = world.body[ANGLE, lane] + (angles[lane] if is_turned else 0.0)
        world.heading[SINE, lane], world.heading[COSINE, lane] = sine_cosine(angle)
    set_out(world, sight, lanes)
    first, last = sensor.ray, sensor.ray + sensor.width
    if is_turned and first < len(tables.ray_row) and tables.ray_row[first] == sensor.start:
        cast(tables, sight, first, last, lanes)
        if len(tables.loose) > 0:
            look_at_loose(tables, world, sight, first, last, lanes)
        if len(tables.robots) > 1:
            look_at_robots(tables, world, sight, first, last, lanes)


@unit_where(lambda tables: tables.sensors["is_rough"].any())
def roughen(tables: Tables, world: WorldState, mind: MindState, i: int, lanes: int) -> None:
    """Make the readings of sensor i imperfect: taken now and then, with noise, sometimes lost, and seen later."""
    sensor, tick = tables.sensors[i], world.tick
    random = world.random_aside if sensor.is_aside else world.random
    for k in range(sensor.width):
        out, measured, first = (
            mind.readings[sensor.start + k],
            mind.measured[sensor.held + k],
            sensor.ring + k * sensor.delay,
        )
        for lane in range(lanes):
            if tick[lane] % sensor.every == 0:
                before = measured[lane] if tick[lane] > 0 else out[lane]
                measured[lane] = measure(random, world.numbers, sensor, out[lane], before, lane)
            out[lane] = measured[lane]
        for lane in range(lanes if sensor.delay > 0 else 0):
            delay = int(world.numbers[sensor.wait, lane])
            if delay > 0:
                slot = first + tick[lane] % delay
                oldest = mind.rings[slot, lane] if tick[lane] >= delay else mind.rings[first, lane]
                seen = oldest if tick[lane] > 0 else out[lane]
                mind.rings[slot, lane] = out[lane]
                out[lane] = seen


def measure(random, numbers, sensor, true, before, lane):
    """The measured value of a true one: with noise, or where it is lost, `blank` or the one before."""
    lost, noise = F(numbers[sensor.lost, lane]), F(numbers[sensor.noise, lane])
    if lost > ZERO and uniform(random, lane, 0.0, 1.0) < lost:
        return before if sensor.blank < ZERO else sensor.blank
    if noise > ZERO:
        value = true + noise * F(uniform(random, lane, -1.0, 1.0))
        return wrapped(value) if sensor.turns else clamp(value)
    return true


def look(tables, world, sight, lanes):
    """Compute the distance from each robot's centre along each ray into `sight`, after heading and place."""
    for k in range(sight.nearby_most[0]):
        box = sight.nearby[BOX_COLUMNS * k : BOX_COLUMNS * (k + 1)]
        place(world.body, box, sight.sides[SIDES * k : SIDES * (k + 1)], lanes)
    set_out(world, sight, lanes)
    cast(tables, sight, 0, len(tables.ray_row), lanes)


def set_out(world, sight, lanes):
    """Write where each robot is and its heading into `sight`."""
    rows, heading, body = sight.sight, world.heading, world.body
    for lane in range(lanes):
        rows[SIGHT_COSINE, lane], rows[SIGHT_SINE, lane] = F(heading[COSINE, lane]), F(heading[SINE, lane])
        rows[SIGHT_X, lane], rows[SIGHT_Y, lane] = F(body[X, lane]), F(body[Y, lane])


def cast(tables, sight, first, last, lanes):
    """Compute how far the rays from `first` to before `last` go, among what is fixed."""
    rows, count, constants = sight.sight, sight.nearby_most[0], tables.world[0]
    half_x, half_y = F(constants.half_x), F(constants.half_y)
    for lane in range(0, lanes, LANES):
        for ray in range(first, last):
            cosine, sine = tables.rays[COSINE, ray], tables.rays[SINE, ray]
            store(rows, FIRST_RAY + ray, lane, along(rows, cosine, sine, half_x, half_y, sight.sides, count, lane))


def along(sight, cosine, sine, half_x, half_y, sides, count, lane):
    """The distance to what a ray meets first in sixteen lanes: a wall, or one of the boxes (the slab method)."""
    c, s = load(sight, SIGHT_COSINE, lane), load(sight, SIGHT_SINE, lane)
    ix = splat(ONE) / (c * splat(cosine) - s * splat(sine))
    iy = splat(ONE) / (s * splat(cosine) + c * splat(sine))
    x, y = load(sight, SIGHT_X, lane), load(sight, SIGHT_Y, lane)
    to_x = highest((splat(half_x) - x) * ix, (splat(-half_x) - x) * ix)
    to_y = highest((splat(half_y) - y) * iy, (splat(-half_y) - y) * iy)
    nearest = lowest(to_x, to_y)
    for k in range(count):
        box = SIDES * k
        left, right = load(sides, box + LEFT, lane) * ix, load(sides, box + RIGHT, lane) * ix
        low, high = load(sides, box + LOW, lane) * iy, load(sides, box + HIGH, lane) * iy
        enter = highest(lowest(left, right), lowest(low, high))
        leave = lowest(highest(left, right), highest(low, high))
        nearest = nearer(enter, leave, nearest)
    return nearest


def choose(world, sight, reach, lanes):
    """Copy the boxes that each lane's rays or robot can meet, anew for a lane that has moved; count them.

    The choice is only ever too generous, so that nothing depends on when it was made. What is left over is AWAY.
    """
    body, anchor = world.body, sight.anchor
    most = 0
    for lane in range(lanes):
        dx, dy = body[X, lane] - anchor[X, lane], body[Y, lane] - anchor[Y, lane]
        if not dx * dx + dy * dy < (CULLING_SLACK_UNITS * 0.9) ** 2:
            anchor[X, lane], anchor[Y, lane] = middle_of(body, lane)
            choose_in(world.boxes, sight, reach, lane)
        most = max(most, sight.nearby_count[lane])
    sight.nearby_most[0] = most


def choose_in(boxes, sight, reach, lane):
    """Copy the boxes around the anchor of a lane, and count them."""
    nearby, x, y = sight.nearby[:, lane], sight.anchor[X, lane], sight.anchor[Y, lane]
    found = 0
    for b in range(count_of(boxes)):
        its_x, its_y, wide, high = box_of(boxes, b, lane)
        if abs(its_x - x) < wide + reach and abs(its_y - y) < high + reach:
            put_box(nearby, found, its_x, its_y, wide, high)
            found += 1
    for k in range(found, sight.nearby_count[lane]):
        remove_box(nearby, k)
    sight.nearby_count[lane] = found


def place(body, box, sides, lanes):
    """Write the sides of a box of each lane relative to the robot; no ray meets one that is AWAY before a wall."""
    for lane in range(lanes):
        dx, dy = F(box[X, lane] - body[X, lane]), F(box[Y, lane] - body[Y, lane])
        half_x, half_y = F(box[HALF_X, lane]), F(box[HALF_Y, lane])
        sides[LEFT, lane], sides[RIGHT, lane] = dx - half_x, dx + half_x
        sides[LOW, lane], sides[HIGH, lane] = dy - half_y, dy + half_y


@unit_where(lambda tables: len(tables.loose) > 0 and tables.world[0]["rays"] > 0)
def look_at_loose(tables: Tables, world: WorldState, sight: SightState, first: int, last: int, lanes: int) -> None:
    """Shorten each of some rays that meets a loose thing, but for one of those that its own sensor looks for."""
    rows, frame = sight.sight, sight.frame
    for i in range(len(tables.loose)):
        enter_frame(tables, world, frame, i, lanes)
        thing = tables.loose[i].thing
        for ray in range(first, last):
            cosine, sine, out = tables.rays[COSINE, ray], tables.rays[SINE, ray], rows[FIRST_RAY + ray]
            if (tables.passes[0, ray] <= thing) & (thing < tables.passes[1, ray]):
                continue
            if tables.loose[i].is_round:
                meet_ball(rows, frame, cosine, sine, out, lanes)
            else:
                meet_box(rows, frame, cosine, sine, out, lanes)


@unit_where(lambda tables: len(tables.robots) > 1 and tables.world[0]["rays"] > 0)
def look_at_robots(tables: Tables, world: WorldState, sight: SightState, first: int, last: int, lanes: int) -> None:
    """Shorten each of some rays that meets another robot, but for one of those that its own sensor looks for.

    One that is farther away than any ray reaches is not looked at.
    """
    rows, body, robots, radius = sight.sight, world.body, len(tables.robots), F(tables.world[0].radius)
    most = tables.world[0].near + tables.world[0].radius
    for lane in range(lanes):
        home = lane - lane % robots
        for other in range(home, home + robots):
            dx, dy = body[X, other] - body[X, lane], body[Y, other] - body[Y, lane]
            if other == lane or not dx * dx + dy * dy < most * most:
                continue
            thing = tables.robots[other - home].thing
            for ray in range(first, last):
                if not (tables.passes[0, ray] <= thing) & (thing < tables.passes[1, ray]):
                    far = rows[FIRST_RAY + ray, lane]
                    if tables.world[0].is_round:
                        far = to_disc(tables, rows, ray, F(dx), F(dy), radius, far, lane)
                    else:
                        far = to_outline(tables, world, rows, ray, F(dx), F(dy), other, far, lane)
                    rows[FIRST_RAY + ray, lane] = far


def to_outline(tables, world, rows, ray, x, y, other, far, lane):
    """How far a ray goes that would go so far, where the rectangle of another robot stands (x, y) from the robot's."""
    ahead, aside = rows[SIGHT_COSINE, lane], rows[SIGHT_SINE, lane]
    cosine, sine = tables.rays[COSINE, ray], tables.rays[SINE, ray]
    c, s = ahead * cosine - aside * sine, aside * cosine + ahead * sine
    half_x, half_y = F(tables.world[0].front), F(tables.world[0].side)
    turned_c, turned_s = F(world.heading[COSINE, other]), F(world.heading[SINE, other])
    x, y = turned_c * x + turned_s * y, turned_c * y - turned_s * x
    ix, iy = ONE / (c * turned_c + s * turned_s), ONE / (s * turned_c - c * turned_s)
    left, right, low, high = (x - half_x) * ix, (x + half_x) * ix, (y - half_y) * iy, (y + half_y) * iy
    enter, leave = max(min(left, right), min(low, high)), min(max(left, right), max(low, high))
    return enter if (enter >= ZERO) & (enter <= leave) & (enter < far) else far


def to_disc(tables, rows, ray, x, y, radius, far, lane):
    """How far a ray goes that would go so far, where a disc of a radius stands (x, y) from the robot's middle."""
    ahead, aside = rows[SIGHT_COSINE, lane], rows[SIGHT_SINE, lane]
    cosine, sine = tables.rays[COSINE, ray], tables.rays[SINE, ray]
    c, s = ahead * cosine - aside * sine, aside * cosine + ahead * sine
    across = x * s - y * c
    room = radius * radius - across * across
    enter = x * c + y * s - np.sqrt(room if room > ZERO else ZERO)
    return enter if (room >= ZERO) & (enter >= ZERO) & (enter < far) else far


def enter_frame(tables, world, frame, i, lanes):
    """Write the frame of loose thing i: how it is turned, its middle from the robot's in axes that turn with it."""
    body, thing = world.body, tables.loose[i].thing
    for lane in range(lanes):
        x, y = place_of(world.things, thing, lane)
        dx, dy = F(x - body[X, lane]), F(y - body[Y, lane])
        sine, cosine = sine_cosine(world.loose[LOOSE_ROWS * i + TURN, lane])
        s, c = F(sine), F(cosine)
        frame[LOOSE_COSINE, lane], frame[LOOSE_SINE, lane] = c, s
        frame[LOOSE_X, lane], frame[LOOSE_Y, lane] = c * dx + s * dy, c * dy - s * dx
        frame[LOOSE_HALF, lane] = F(size_of(world.things, thing, lane) / 2)


def meet_ball(rows, frame, cosine, sine, out, lanes):
    """Shorten a ray of each lane to the disc of its frame, where it meets that before."""
    for lane in range(lanes):
        c, s = direction(rows, frame, cosine, sine, lane)
        x, y, radius = frame[LOOSE_X, lane], frame[LOOSE_Y, lane], frame[LOOSE_HALF, lane]
        aside = x * s - y * c
        room = radius * radius - aside * aside
        enter = x * c + y * s - np.sqrt(room if room > ZERO else ZERO)
        hit = (room >= ZERO) & (enter >= ZERO) & (enter < out[lane])
        out[lane] = enter if hit else out[lane]


def meet_box(rows, frame, cosine, sine, out, lanes):
    """Shorten a ray of each lane to the square of its frame, where it meets that before (the slab method)."""
    for lane in range(lanes):
        c, s = direction(rows, frame, cosine, sine, lane)
        x, y, half = frame[LOOSE_X, lane], frame[LOOSE_Y, lane], frame[LOOSE_HALF, lane]
        ix, iy = ONE / c, ONE / s
        left, right, low, high = (x - half) * ix, (x + half) * ix, (y - half) * iy, (y + half) * iy
        first_x, last_x = left if left < right else right, right if left < right else left
        first_y, last_y = low if low < high else high, high if low < high else low
        enter = first_x if first_x > first_y else first_y
        leave = last_x if last_x < last_y else last_y
        hit = (enter >= ZERO) & (enter <= leave) & (enter < out[lane])
        out[lane] = enter if hit else out[lane]


def direction(rows, frame, cosine, sine, lane):
    """Cosine and sine of a ray's direction in a lane's frame."""
    ahead, aside = rows[SIGHT_COSINE, lane], rows[SIGHT_SINE, lane]
    c, s = ahead * cosine - aside * sine, aside * cosine + ahead * sine
    turned_c, turned_s = frame[LOOSE_COSINE, lane], frame[LOOSE_SINE, lane]
    return c * turned_c + s * turned_s, s * turned_c - c * turned_s
