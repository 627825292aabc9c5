"""What rays see of loose things: balls, and boxes however they are turned."""

import numpy as np

from mindrun.numbers.arithmetic import COSINE, LOOSE_ROWS, SINE, SIZE, THING_ROWS, TURN, X, Y
from mindrun.sim.arithmetic import ONE, ZERO, F, sine_cosine
from mindrun.sim.compiling import compiled
from mindrun.sim.state import (
    FIRST_RAY,
    LOOSE_COSINE,
    LOOSE_HALF,
    LOOSE_SINE,
    LOOSE_X,
    LOOSE_Y,
    SIGHT_COSINE,
    SIGHT_SINE,
)


@compiled
def look_at_loose(tables, world, sight, lanes):
    """Shorten every ray that meets a loose thing, but for one of those that its own sensor looks for."""
    rows, frame = sight.sight, sight.frame
    for i in range(len(tables.loose)):
        enter_frame(tables, world, frame, i, lanes)
        thing = tables.loose[i].thing
        for ray in range(len(tables.ray_row)):
            cosine, sine, out = tables.rays[COSINE, ray], tables.rays[SINE, ray], rows[FIRST_RAY + ray]
            if (tables.passes[0, ray] <= thing) & (thing < tables.passes[1, ray]):
                continue
            if tables.loose[i].is_round:
                meet_ball(rows, frame, cosine, sine, out, lanes)
            else:
                meet_box(rows, frame, cosine, sine, out, lanes)


@compiled
def enter_frame(tables, world, frame, i, lanes):
    """Where loose thing i is as it sees it itself: its middle from the robot, in axes that turn with it."""
    body, place, turn = world.body, THING_ROWS * tables.loose[i].thing, LOOSE_ROWS * i + TURN
    for lane in range(lanes):
        dx, dy = F(world.things[place + X, lane] - body[X, lane]), F(world.things[place + Y, lane] - body[Y, lane])
        sine, cosine = sine_cosine(world.loose[turn, lane])
        s, c = F(sine), F(cosine)
        frame[LOOSE_COSINE, lane], frame[LOOSE_SINE, lane] = c, s
        frame[LOOSE_X, lane], frame[LOOSE_Y, lane] = c * dx + s * dy, c * dy - s * dx
        frame[LOOSE_HALF, lane] = F(world.things[place + SIZE, lane] / 2)


@compiled
def meet_ball(rows, frame, cosine, sine, out, lanes):
    """A ray of each lane, and the disc around its frame's middle."""
    for lane in range(lanes):
        c, s = direction(rows, frame, cosine, sine, lane)
        x, y, radius = frame[LOOSE_X, lane], frame[LOOSE_Y, lane], frame[LOOSE_HALF, lane]
        aside = x * s - y * c
        room = radius * radius - aside * aside
        enter = x * c + y * s - np.sqrt(room if room > ZERO else ZERO)
        hit = (room >= ZERO) & (enter >= ZERO) & (enter < out[lane])
        out[lane] = enter if hit else out[lane]


@compiled
def meet_box(rows, frame, cosine, sine, out, lanes):
    """A ray of each lane, and the square around its frame's middle (the slab method)."""
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


@compiled
def direction(rows, frame, cosine, sine, lane):
    """Cosine and sine of a ray's direction in a lane's frame."""
    ahead, aside = rows[SIGHT_COSINE, lane], rows[SIGHT_SINE, lane]
    c, s = ahead * cosine - aside * sine, aside * cosine + ahead * sine
    return c * frame[LOOSE_COSINE, lane] + s * frame[LOOSE_SINE, lane], (
        s * frame[LOOSE_COSINE, lane] - c * frame[LOOSE_SINE, lane]
    )
