"""Sense: every reading of every lane, from where the robots and the things are."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from mindrun.arithmetic import BOX_COLUMNS, COSINE, DISTANCE, HALF_SIDE, MAX_FLOAT32, SINE, THING_ROWS, X, Y
from mindrun.registry import kinds
from mindrun.sim.arithmetic import ONE, ZERO, F, clamp, compiled_lane
from mindrun.sim.codes import AWAY, sensor_codes
from mindrun.sim.compiling import compiled
from mindrun.sim.lanes.placement import uniform
from mindrun.sim.vector import HIGHEST, LOWEST, VECTOR_LANES, load, splat, store, where_ordered

CULLING_SLACK_UNITS = 2.0  # how far a robot may move before the boxes near it are chosen anew


def _chain(kinds_left: Sequence[Any], code: int = 0) -> Callable[..., None]:
    """A function that calls the lane function of a sensor's kind: one compilation, whatever the mind is."""
    lane, *rest = kinds_left
    own = compiled_lane(lane)
    if not rest:
        return own
    other = _chain(rest, code + 1)

    @compiled
    def read(t, s, n, clock, sensor):
        if sensor.kind == code:
            own(t, s, n, clock, sensor)
        else:
            other(t, s, n, clock, sensor)

    return read


read = _chain([kinds("sensor")[name].lane for name in sensor_codes()])


@compiled
def sense(t, s, n, clock):
    """Fill the rows of the sensors that somebody reads, in the order of the table (sources before derivatives)."""
    see(s.body, s.things, len(t.things), n)
    reach = t.world[0].near + CULLING_SLACK_UNITS
    s.slot_most[0] = choose(s.body, s.boxes, s.anchor, s.nearby, s.slot_count, reach, n)
    if t.world[0].rays > 0:
        look(t, s, n)
    for i in range(len(t.sensors)):
        sensor = t.sensors[i]
        read(t, s, n, clock, sensor)
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
            dx, dy = things[THING_ROWS * i + X, p] - body[X, p], things[THING_ROWS * i + Y, p] - body[Y, p]
            things[THING_ROWS * i + DISTANCE, p] = np.sqrt(dx * dx + dy * dy)


@compiled
def look(t, s, n):
    """The distance from each robot's centre along each ray: rows 4 and on of `sight`, after heading and place."""
    world = t.world[0]
    count = s.slot_most[0]
    for k in range(count):
        place(s.body, s.nearby[BOX_COLUMNS * k : BOX_COLUMNS * (k + 1)], s.slots[4 * k : 4 * k + 4], n)
    for p in range(n):
        s.sight[0, p], s.sight[1, p] = F(s.heading[COSINE, p]), F(s.heading[SINE, p])
        s.sight[2, p], s.sight[3, p] = F(s.body[X, p]), F(s.body[Y, p])
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
def choose(body, boxes, anchor, nearby, slot_count, reach, n):
    """Copy the boxes that each lane's rays or robot can meet, anew for a lane that has moved; the most of any lane.

    The choice is only ever too generous, so that nothing depends on when it was made. What is left over is AWAY.
    """
    total = boxes.shape[1] // 3
    most = 0
    for p in range(n):
        dx, dy = body[X, p] - anchor[X, p], body[Y, p] - anchor[Y, p]
        if not dx * dx + dy * dy < (CULLING_SLACK_UNITS * 0.9) ** 2:
            x, y = body[X, p], body[Y, p]
            anchor[X, p], anchor[Y, p] = x, y
            found = 0
            for b in range(total):
                box = BOX_COLUMNS * b
                margin = boxes[p, box + HALF_SIDE] + reach
                if abs(boxes[p, box + X] - x) < margin and abs(boxes[p, box + Y] - y) < margin:
                    for i in range(BOX_COLUMNS):
                        nearby[BOX_COLUMNS * found + i, p] = boxes[p, box + i]
                    found += 1
            for k in range(found, slot_count[p]):
                box = BOX_COLUMNS * k
                nearby[box + X, p], nearby[box + Y, p], nearby[box + HALF_SIDE, p] = AWAY, AWAY, 0.0
            slot_count[p] = found
        most = max(most, slot_count[p])
    return most


@compiled
def place(body, box, sides, n):
    """The sides of a box of each lane relative to the robot; no ray meets one that is AWAY before a wall."""
    for p in range(n):
        dx, dy, half = F(box[X, p] - body[X, p]), F(box[Y, p] - body[Y, p]), F(box[HALF_SIDE, p])
        sides[0, p], sides[1, p] = dx - half, dx + half
        sides[2, p], sides[3, p] = dy - half, dy + half
