"""Sense: every reading of every lane, from where the robots and the things are."""

import numpy as np

from mindrun.sim.arithmetic import HALF, MAX_FLOAT32, ONE, ZERO, F, bearing, clamp, sine_cosine
from mindrun.sim.codes import (
    AWAY,
    BATTERY,
    BEARING,
    CONTACT,
    DERIVATIVE,
    HELD,
    INERTIAL,
    INERTIAL_TICKS,
    INSIDE,
    RANGE,
    SINE,
)
from mindrun.sim.compiling import compiled
from mindrun.sim.lanes.placement import uniform
from mindrun.sim.vector import HIGHEST, LOWEST, VECTOR_LANES, load, splat, store, where_ordered

CULLING_SLACK_UNITS = 2.0  # how far a robot may move before the boxes near it are chosen anew


@compiled
def sense(t, s, n, clock):
    """Fill the rows of the sensors that somebody reads, in the order of the table (sources before derivatives)."""
    world = t.world[0]
    see(s.body, s.things, len(t.things), n)
    s.slot_most[0] = choose(s.body, s.boxes, s.anchor, s.nearby, s.slot_count, world.near + CULLING_SLACK_UNITS, n)
    if world.rays > 0:
        look(t, s, n)
    for i in range(len(t.sensors)):
        sensor = t.sensors[i]
        kind, row = sensor.kind, sensor.start
        if kind == RANGE:
            for ray in range(sensor.width):
                distance(s.readings[row + ray], s.sight[4 + sensor.ray + ray], F(world.radius), F(sensor.range),
                         sensor.dead_zone, n)  # fmt: skip
        elif kind == SINE:
            wave(s.readings[row], s.tick, sensor.period, n)
        elif kind == DERIVATIVE:
            for k in range(sensor.width):
                derive(s.readings[row + k], s.readings[sensor.source + k], s.before[sensor.before + k], s.tick,
                       sensor.gain, sensor.dead_zone, sensor.turns, n)  # fmt: skip
        elif kind == INERTIAL:
            oldest = clock % INERTIAL_TICKS
            moved(s.readings[row], s.body, s.trail[2 * oldest], s.trail[2 * oldest + 1], sensor.gain,
                  sensor.dead_zone, n)  # fmt: skip
        elif kind == BATTERY:
            for p in range(n):
                s.readings[row, p] = F(s.battery[p])
        elif sensor.thing < 0:
            s.readings[row, :n] = HALF if kind == BEARING else ZERO
        elif kind == BEARING:
            turn(s.readings[row], s.body, s.heading, s.things[4 * sensor.thing : 4 * sensor.thing + 4], sensor.range,
                 sensor.dead_zone, n)  # fmt: skip
        elif kind == CONTACT:
            for p in range(n):
                s.readings[row, p] = (
                    ONE if in_claw(s.body, s.heading, s.things, world.radius, world.claw, sensor.thing, p) else ZERO
                )
        elif kind == HELD:
            for p in range(n):
                s.readings[row, p] = ONE if s.held[p] == sensor.thing else ZERO
        elif kind == INSIDE:
            for p in range(n):
                s.readings[row, p] = ONE if inside(s.things, sensor.thing, s.body[0, p], s.body[1, p], p) else ZERO
        if sensor.is_rough:
            for k in range(sensor.width):
                roughen(s, sensor, k, n)


@compiled
def roughen(s, sensor, k, n):
    """Reading k of a sensor as it is measured: now and then, with noise, sometimes not at all, and seen later."""
    out, measured = s.readings[sensor.start + k], s.measured[sensor.held + k]
    random = s.aside if sensor.is_aside else s.random
    for p in range(n):
        if s.tick[p] % sensor.every == 0:
            measured[p] = measure(random, sensor, out[p], measured[p] if s.tick[p] > 0 else out[p], p)
        out[p] = measured[p]
    first = sensor.ring + k * sensor.delay
    for p in range(n if sensor.delay > 0 else 0):
        slot = first + s.tick[p] % sensor.delay
        seen = s.rings[slot, p] if s.tick[p] >= sensor.delay else s.rings[first, p] if s.tick[p] > 0 else out[p]
        s.rings[slot, p] = out[p]
        out[p] = seen


@compiled
def measure(random, sensor, true, before, p):
    """What is measured of a true value."""
    if sensor.lost > ZERO and uniform(random, p, 0.0, 1.0) < sensor.lost:
        return before if sensor.blank < ZERO else sensor.blank
    if sensor.noise > ZERO:
        return clamp(true + sensor.noise * F(uniform(random, p, -1.0, 1.0)))
    return true


@compiled
def see(body, things, count, n):
    """The distance of every thing when the tick begins."""
    for i in range(count):
        for p in range(n):
            dx, dy = things[4 * i, p] - body[0, p], things[4 * i + 1, p] - body[1, p]
            things[4 * i + 3, p] = np.sqrt(dx * dx + dy * dy)


@compiled
def turn(out, body, heading, thing, reach, dead_zone, n):
    """A bearing: 0.5 − atan2/2π in the body's frame."""
    for p in range(n):
        dx, dy = F(thing[0, p] - body[0, p]), F(thing[1, p] - body[1, p])
        c, q = F(heading[0, p]), F(heading[1, p])
        v = bearing(c * dx + q * dy, c * dy - q * dx)
        v = HALF if abs(v - HALF) < dead_zone else v
        out[p] = v if thing[3, p] <= reach else HALF


@compiled
def wave(out, tick, period, n):
    """0.5 + 0.5 sin(2πt/T)."""
    for p in range(n):
        turns = tick[p] / period
        sine, _ = sine_cosine(2 * np.pi * (turns - np.floor(turns)))
        out[p] = F(0.5 + 0.5 * sine)


@compiled
def derive(out, now, before, tick, gain, dead_zone, turns, n):
    """0.5 + change · gain, the short way round a circle; 0.5 in the first tick."""
    for p in range(n):
        d = now[p] - before[p]
        over = F(1 if d > HALF else 0) - F(1 if d < -HALF else 0)
        d = d - over if turns else d
        v = clamp(HALF + d * gain)
        v = HALF if abs(v - HALF) < dead_zone else v
        out[p] = v if tick[p] > 0 else HALF
    for p in range(n):
        before[p] = now[p]


@compiled
def moved(out, body, x, y, gain, dead_zone, n):
    """The displacement since the oldest place of the trail, as a share of `range`."""
    for p in range(n):
        dx, dy = body[0, p] - x[p], body[1, p] - y[p]
        v = clamp(F(np.sqrt(dx * dx + dy * dy)) * gain)
        out[p] = ZERO if v < dead_zone else v


@compiled
def in_claw(body, heading, things, radius, reach, i, p):
    """Whether thing i is ahead of the claw and its rim within the claw's reach."""
    dx, dy = things[4 * i, p] - body[0, p], things[4 * i + 1, p] - body[1, p]
    ahead = heading[0, p] * dx + heading[1, p] * dy - radius
    aside = heading[0, p] * dy - heading[1, p] * dx
    far = reach + things[4 * i + 2, p] / 2
    return ahead >= 0 and ahead * ahead + aside * aside <= far * far


@compiled
def inside(things, i, x, y, p):
    """Whether a point is inside the square of thing i."""
    half = things[4 * i + 2, p] / 2
    return abs(things[4 * i, p] - x) <= half and abs(things[4 * i + 1, p] - y) <= half


@compiled
def look(t, s, n):
    """The distance from each robot's centre along each ray: rows 4 and on of `sight`, after heading and place."""
    world = t.world[0]
    count = s.slot_most[0]
    for k in range(count):
        place(s.body, s.nearby[3 * k : 3 * k + 3], s.slots[4 * k : 4 * k + 4], n)
    for p in range(n):
        s.sight[0, p], s.sight[1, p] = F(s.heading[0, p]), F(s.heading[1, p])
        s.sight[2, p], s.sight[3, p] = F(s.body[0, p]), F(s.body[1, p])
    for p in range(0, n, VECTOR_LANES):
        for ray in range(len(t.ray_row)):
            store(s.sight, 4 + ray, p, along(s.sight, t.rays[0, ray], t.rays[1, ray], F(world.half), s.slots, count, p))


@compiled
def along(sight, cosine, sine, half, slots, count, p):
    """The distance to what a ray meets first in sixteen lanes: a wall, or one of the boxes (the slab method)."""
    c, q = load(sight, 0, p), load(sight, 1, p)
    ix = splat(ONE) / (c * splat(cosine) - q * splat(sine))
    iy = splat(ONE) / (q * splat(cosine) + c * splat(sine))
    x, y = load(sight, 2, p), load(sight, 3, p)
    tx = HIGHEST((splat(half) - x) * ix, (splat(-half) - x) * ix)
    ty = HIGHEST((splat(half) - y) * iy, (splat(-half) - y) * iy)
    nearest = LOWEST(tx, ty)
    for k in range(count):
        a, b = load(slots, 4 * k, p) * ix, load(slots, 4 * k + 1, p) * ix
        c, d = load(slots, 4 * k + 2, p) * iy, load(slots, 4 * k + 3, p) * iy
        enter = HIGHEST(LOWEST(a, b), LOWEST(c, d))
        leave = LOWEST(HIGHEST(a, b), HIGHEST(c, d))
        hit = where_ordered(enter, leave, enter, splat(MAX_FLOAT32))
        nearest = LOWEST(where_ordered(splat(ZERO), hit, hit, splat(MAX_FLOAT32)), nearest)
    return nearest


@compiled
def distance(out, far, radius, reach, dead_zone, n):
    """A range finder's reading from the distance along its ray."""
    scale = ONE / reach
    for p in range(n):
        v = clamp((far[p] - radius) * scale)
        out[p] = ZERO if v < dead_zone else v


@compiled
def choose(body, boxes, anchor, nearby, slot_count, reach, n):
    """Copy the boxes that each lane's rays or robot can meet, anew for a lane that has moved; the most of any lane.

    The choice is only ever too generous, so that nothing depends on when it was made. What is left over is AWAY.
    """
    total = boxes.shape[1] // 3
    most = 0
    for p in range(n):
        dx, dy = body[0, p] - anchor[0, p], body[1, p] - anchor[1, p]
        if not dx * dx + dy * dy < (CULLING_SLACK_UNITS * 0.9) ** 2:
            x, y = body[0, p], body[1, p]
            anchor[0, p], anchor[1, p] = x, y
            found = 0
            for b in range(total):
                margin = boxes[p, 3 * b + 2] + reach
                if abs(boxes[p, 3 * b] - x) < margin and abs(boxes[p, 3 * b + 1] - y) < margin:
                    for i in range(3):
                        nearby[3 * found + i, p] = boxes[p, 3 * b + i]
                    found += 1
            for k in range(found, slot_count[p]):
                nearby[3 * k, p], nearby[3 * k + 1, p], nearby[3 * k + 2, p] = AWAY, AWAY, 0.0
            slot_count[p] = found
        most = max(most, slot_count[p])
    return most


@compiled
def place(body, box, sides, n):
    """The sides of a box of each lane relative to the robot; no ray meets one that is AWAY before a wall."""
    for p in range(n):
        dx, dy, half = F(box[0, p] - body[0, p]), F(box[1, p] - body[1, p]), F(box[2, p])
        sides[0, p], sides[1, p] = dx - half, dx + half
        sides[2, p], sides[3, p] = dy - half, dy + half
