"""Places drawn at random: the obstacles, where the robot starts, where things appear and reappear.

Every world has its own generator (SplitMix64), seeded by the layout alone, so that all genomes of a generation meet
the same world. Everything is placed clear of everything else, with room for the robot between.
"""

import numpy as np

from mindrun.arithmetic import ANGLE, BOX_COLUMNS, HALF_SIDE, SIZE, THING_ROWS, X, Y
from mindrun.sim.arithmetic import sine_cosine
from mindrun.sim.codes import FAR
from mindrun.sim.compiling import compiled

GOLDEN, MIX_1, MIX_2 = np.uint64(0x9E3779B97F4A7C15), np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)
S30, S27, S31, S11 = np.uint64(30), np.uint64(27), np.uint64(31), np.uint64(11)
UNIT = 2.0**-53
MAX_TRIES = 1000


@compiled
def uniform(random, p, low, high):
    """The next number of lane p's generator, between low and high."""
    random[p] += GOLDEN
    z = random[p]
    z = (z ^ (z >> S30)) * MIX_1
    z = (z ^ (z >> S27)) * MIX_2
    z = z ^ (z >> S31)
    return low + (high - low) * (np.float64(z >> S11) * UNIT)


@compiled
def draw(t, s, p):
    """A fresh world in lane p: grids of obstacles, the robot, loose obstacles, then the things in their order."""
    world, obstacles = t.world[0], t.obstacles
    s.boxes[p, :] = FAR
    s.boxes[p, 2::3] = 0.0
    s.things[:, p] = FAR
    box = 0
    for i in range(len(obstacles)):
        box = draw_grid(s, obstacles[i], box, p)
    start(s, world.half, world.radius, p)
    for i in range(len(obstacles)):
        for _ in range(obstacles[i].count):
            size = uniform(s.random, p, obstacles[i].first, obstacles[i].last)
            x, y = find(s, world.half, world.radius, obstacles[i].low, obstacles[i].high, size / 2, -1, p)
            put_box(s.boxes, box, x, y, size / 2, p)
            box += 1
    for i in range(len(t.things)):
        thing = t.things[i]
        size = uniform(s.random, p, thing.first, thing.last) if thing.drawn else thing.first
        s.things[THING_ROWS * i + SIZE, p] = size
        put(t, s, i, p)


@compiled
def put_box(boxes, b, x, y, half, p):
    """Box number b stands at a place."""
    box = BOX_COLUMNS * b
    boxes[p, box + X], boxes[p, box + Y], boxes[p, box + HALF_SIDE] = x, y, half


@compiled
def draw_grid(s, obstacle, box, p):
    """One obstacle at each crossing of the grid, a little off it; the number of the next box."""
    for row in range(obstacle.lines):
        for column in range(obstacle.lines):
            middle = (obstacle.lines - 1) / 2
            x = (column - middle) * obstacle.grid + uniform(s.random, p, -obstacle.jitter, obstacle.jitter)
            y = (row - middle) * obstacle.grid + uniform(s.random, p, -obstacle.jitter, obstacle.jitter)
            size = uniform(s.random, p, obstacle.first, obstacle.last)
            put_box(s.boxes, box, x, y, size / 2, p)
            box += 1
    return box


@compiled
def start(s, half, radius, p):
    """The robot at rest: in the origin of a plain scene, anywhere clear in an arena; facing anywhere."""
    s.body[:, p] = 0.0
    if half < 1e300:
        for _ in range(MAX_TRIES):
            s.body[X, p] = uniform(s.random, p, -half + 3 * radius, half - 3 * radius)
            s.body[Y, p] = uniform(s.random, p, -half + 3 * radius, half - 3 * radius)
            if clear(s, s.body[X, p], s.body[Y, p], 3 * radius, p):
                break
    s.body[ANGLE, p] = uniform(s.random, p, 0.0, 2 * np.pi)


@compiled
def clear(s, x, y, margin, p):
    """Whether no obstacle comes within `margin` of a point, along the axes."""
    for b in range(s.boxes.shape[1] // 3):
        box = BOX_COLUMNS * b
        gap = s.boxes[p, box + HALF_SIDE] + margin
        if abs(s.boxes[p, box + X] - x) < gap and abs(s.boxes[p, box + Y] - y) < gap:
            return False
    return True


@compiled
def find(s, half, radius, low, high, extent, but, p):
    """A place for something of that half size: low..high from the robot, clear of obstacles, walls and other things.

    The last one tried where no try succeeds.
    """
    x, y = 0.0, 0.0
    for _ in range(MAX_TRIES):
        if half < 1e300:
            room = max(half - extent - 2 * radius, 0.0)
            x, y = uniform(s.random, p, -room, room), uniform(s.random, p, -room, room)
        else:
            sine, cosine = sine_cosine(uniform(s.random, p, 0.0, 2 * np.pi))
            far = uniform(s.random, p, low, high)
            x, y = s.body[X, p] + far * cosine, s.body[Y, p] + far * sine
        dx, dy = x - s.body[X, p], y - s.body[Y, p]
        far = np.sqrt(dx * dx + dy * dy)
        ok = far > low - 1e-9 and far < high + 1e-9 and clear(s, x, y, extent + 2 * radius, p)
        for i in range(s.things.shape[0] // 4):
            thing = THING_ROWS * i
            gap = extent + s.things[thing + SIZE, p] / 2
            if i != but and abs(s.things[thing + X, p] - x) < gap and abs(s.things[thing + Y, p] - y) < gap:
                ok = False
        if ok:
            break
    return x, y


@compiled
def put(t, s, i, p):
    """Thing i somewhere else in lane p."""
    world, thing = t.world[0], t.things[i]
    x, y = find(s, world.half, world.radius, thing.low, thing.high, s.things[THING_ROWS * i + SIZE, p] / 2, i, p)
    s.things[THING_ROWS * i + X, p], s.things[THING_ROWS * i + Y, p] = x, y


@compiled
def succeed(t, s, i, p):
    """Thing i moves: it takes the next step of its schedule and appears elsewhere, let go and not yet reached."""
    thing = t.things[i]
    size = s.things[THING_ROWS * i + SIZE, p]
    if thing.drawn:
        size = uniform(s.random, p, thing.first, thing.last)
    elif thing.first > thing.last:
        size = max(thing.last, size - thing.by)
    elif thing.first < thing.last:
        size = min(thing.last, size + thing.by)
    s.things[THING_ROWS * i + SIZE, p] = size
    forget(s, i, p)
    put(t, s, i, p)


@compiled
def vanish(s, i, p):
    """Thing i is nowhere for the rest of the run: a place that is no number is in nobody's reach or way."""
    forget(s, i, p)
    s.things[THING_ROWS * i + X, p], s.things[THING_ROWS * i + Y, p] = np.nan, np.nan


@compiled
def forget(s, i, p):
    """Thing i is let go, and where it has been reached or delivered does not count any more."""
    s.held[p] = -1 if s.held[p] == i else s.held[p]
    s.reached[i, p], s.delivered[i, p] = 0, 0
