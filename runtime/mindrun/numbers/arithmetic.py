"""Arithmetic of the lanes: + − × ÷ only, in a fixed order, nothing fused, so that every processor gives the same bits.

Plain functions, which `mindrun.sim` compiles: the kinds of sensors say in their terms what they read.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.numbers.trigonometry import C1, C2, C3, C4, C5, C6, PART_1, PART_2, PART_3, S1, S2, S3, S4, S5, S6


def _singles(*values: float) -> tuple[float, ...]:
    return tuple(float(np.float32(value)) for value in values)


F = np.float32
Singles = NDArray[F]
X, Y, ANGLE, SPEED_X, SPEED_Y, SPIN = range(6)  # rows of a body; of all else that has a place the first two
COSINE, SINE = range(2)  # rows of a heading
THING_ROWS, SIZE, DISTANCE = 4, 2, 3  # of a thing: how many, its size, how far the robot was as the tick began
BOX_COLUMNS, HALF_X, HALF_Y = 4, 2, 3  # of a box: how many, and half of its sides along x and y
TURN, PUSHED_X, PUSHED_Y, PUSHED_SPIN, LOOSE_ROWS = range(5)  # rows of a loose thing beside those, and how many
SIGHT_COSINE, SIGHT_SINE, SIGHT_X, SIGHT_Y, FIRST_RAY = range(5)  # rows of `sight`
LEFT, RIGHT, LOW, HIGH, SIDES = range(5)  # rows of a box in `sides`, and how many
LOOSE_COSINE, LOOSE_SINE, LOOSE_X, LOOSE_Y, LOOSE_HALF, FRAME_ROWS = range(6)  # of the frame of a loose thing
ZERO, HALF, ONE, NAN = F(0), F(0.5), F(1), F(np.nan)
MIN_DENOMINATOR = F(1e-7)
GOLDEN, MIX_1, MIX_2 = np.uint64(0x9E3779B97F4A7C15), np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)
STREAM = np.uint64(0xA24BAED4963EE407)  # what is drawn by its place and not in turn has a stream of its own
S30, S27, S31, S11 = np.uint64(30), np.uint64(27), np.uint64(31), np.uint64(11)
UNIFORM_STEP = 2.0**-53
# 1/(1 + e^−x) = ½ + ½ tanh(x/2), with tanh as a quotient of two polynomials in float32, within 1e-6 of the true value:
# + − × ÷ alone, and so the same bits on every processor, which `exp` does not give.
# a1, a3, … a13 of the numerator x·(a1 + a3·x² + …), b0, b2, b4, b6 of the denominator; lowest power first.
NUMERATOR = _singles(
    4.89352455891786e-03,
    6.37261928875436e-04,
    1.48572235717979e-05,
    5.12229709037114e-08,
    -8.60467152213735e-11,
    2.00018790482477e-13,
    -2.76076847742355e-16,
)
DENOMINATOR = _singles(4.89352518554385e-03, 2.26843463243900e-03, 1.18534705686654e-04, 1.19825839466702e-06)
(LIMIT,) = _singles(7.90531110763549805)  # from here on tanh is 1 in float32
_LOW, _HIGH = F(-LIMIT), F(LIMIT)
_ABOVE, _BELOW = [F(a) for a in NUMERATOR], [F(b) for b in DENOMINATOR]
MAX_FLOAT32 = np.finfo(F).max


def clamp(v: Any) -> Any:
    """`v` clamped to 0..1; the caller has made sure that it is finite."""
    v = v if v > ZERO else ZERO
    return v if v < ONE else ONE


def wrapped(v: Any) -> Any:
    """A direction that is less than a turn beyond 0..1, where it is within: 1.02 is 0.02. What is within stays."""
    v = v + ONE if v < ZERO else v
    return v - ONE if v > ONE else v


def short_way(d: Any) -> Any:
    """The difference `d` of two directions, the short way round: −0.5 to 0.5 of a turn."""
    return d - np.rint(d)


def finite(v: Any) -> Any:
    """True if a float32 is neither infinite nor NaN."""
    return abs(v) <= MAX_FLOAT32


def sine_cosine(x: Any) -> Any:
    """(sin x, cos x) of a float64: the arithmetic of `mindrun.numbers.trigonometry`, with selects for its branches."""
    k = np.floor(x * 0.6366197723675814 + 0.5)
    r = ((x - k * PART_1) - k * PART_2) - k * PART_3
    z = r * r
    s = r + z * r * (S1 + z * (S2 + z * (S3 + z * (S4 + z * (S5 + z * S6)))))
    half = 0.5 * z
    rest = 1.0 - half
    tail = z * z * (C1 + z * (C2 + z * (C3 + z * (C4 + z * (C5 + z * C6)))))
    c = rest + (((1.0 - rest) - half) + tail)
    q = k - 4.0 * np.floor(k * 0.25)
    odd = (q == 1.0) | (q == 3.0)
    sine = c if odd else s
    cosine = s if odd else c
    sine = -sine if q >= 2.0 else sine
    cosine = -cosine if (q == 1.0) | (q == 2.0) else cosine
    return sine, cosine


PI32, HALF_PI32 = F(np.pi), F(np.pi / 2)
# Abramowitz and Stegun 4.4.49: within 2e-8.
T1, T3, T5, T7 = F(0.9999993329), F(-0.3332985605), F(0.1994653599), F(-0.1390853351)
T9, T11, T13, T15 = F(0.0964200441), F(-0.0559098861), F(0.0218612288), F(-0.0040540580)
PER_TURN = F(0.5 / np.pi)


def bearing(x: Any, y: Any) -> Any:
    """0.5 − atan2(y, x)/2π of float32s; 0.5 at the origin."""
    ax, ay = abs(x), abs(y)
    low = ax if ax < ay else ay
    high = ax if ax > ay else ay
    t = low / (high if high > MIN_DENOMINATOR else ONE)
    z = t * t
    p = T15
    p = p * z + T13
    p = p * z + T11
    p = p * z + T9
    p = p * z + T7
    p = p * z + T5
    p = p * z + T3
    p = p * z + T1
    angle = p * t
    angle = HALF_PI32 - angle if ay > ax else angle
    angle = PI32 - angle if x < ZERO else angle
    angle = -angle if y < ZERO else angle
    return HALF - angle * PER_TURN


def stepped(place: Any, way: Any) -> Any:
    """One number of a place, a float32, after the robot went a float64 `way`; a way that is no way leaves it."""
    return clamp(F(np.float64(place) - (way if abs(way) <= 1.0 else 0.0)))


def reckoned_bearing(east: Any, north: Any, compass: Any) -> Any:
    """The bearing of a place by its readings and that of a compass; NaN where that failed."""
    sine, cosine = sine_cosine(2.0 * np.pi * (np.float64(compass) - 0.25))
    s, c, x, y = F(sine), F(cosine), east - HALF, north - HALF
    v = bearing(c * x + s * y, c * y - s * x)
    return v if finite(compass) else NAN


def reckoned_distance(east: Any, north: Any, unit: Any) -> Any:
    """How far a place is by its readings, in units of the world, float64; `unit` is how many the reading 1 is."""
    return length(np.float64(east) - 0.5, np.float64(north) - 0.5) * unit


def length(x: Any, y: Any) -> Any:
    """The length of a way along both axes."""
    return np.sqrt(x * x + y * y)


def middle_of(body: Any, p: Any) -> Any:
    """The x and y of the robot of lane p."""
    return body[X, p], body[Y, p]


def pose_of(body: Any, p: Any) -> Any:
    """The x, y and angle of the robot of lane p."""
    return body[X, p], body[Y, p], body[ANGLE, p]


def motion_of(body: Any, p: Any) -> Any:
    """The velocity along x and y, and the spin, of the robot of lane p."""
    return body[SPEED_X, p], body[SPEED_Y, p], body[SPIN, p]


def next_middle(body: Any, seconds: Any, p: Any) -> Any:
    """The x and y of the robot of lane p after some seconds, if it touches nothing."""
    return body[X, p] + body[SPEED_X, p] * seconds, body[Y, p] + body[SPEED_Y, p] * seconds


def place_of(things: Any, i: Any, p: Any) -> Any:
    """The x and y of thing i in the world of lane p. Whatever reads or moves things does it by these five functions."""
    return things[THING_ROWS * i + X, p], things[THING_ROWS * i + Y, p]


def put_thing(things: Any, i: Any, x: Any, y: Any, p: Any) -> None:
    """Move thing i to a place in the world of lane p."""
    things[THING_ROWS * i + X, p], things[THING_ROWS * i + Y, p] = x, y


def size_of(things: Any, i: Any, p: Any) -> Any:
    """The side or the diameter of thing i in the world of lane p."""
    return things[THING_ROWS * i + SIZE, p]


def resize_thing(things: Any, i: Any, size: Any, p: Any) -> None:
    """Give thing i a size in the world of lane p."""
    things[THING_ROWS * i + SIZE, p] = size


def distance_of(things: Any, i: Any, p: Any) -> Any:
    """The distance between the robot of lane p and thing i as the tick began."""
    return things[THING_ROWS * i + DISTANCE, p]


def box_of(boxes: Any, b: Any, p: Any) -> Any:
    """The middle of box b in the world of lane p, and half of its sides: x, y, along x, along y."""
    box = BOX_COLUMNS * b
    return boxes[p, box + X], boxes[p, box + Y], boxes[p, box + HALF_X], boxes[p, box + HALF_Y]


def in_claw(body: Any, heading: Any, things: Any, front: Any, reach: Any, i: Any, p: Any) -> Any:
    """True if thing i is ahead of the claw, `front` ahead of the body's middle, and its rim within reach, in lane p."""
    x, y = place_of(things, i, p)
    dx, dy = x - body[X, p], y - body[Y, p]
    ahead = heading[COSINE, p] * dx + heading[SINE, p] * dy - front
    aside = heading[COSINE, p] * dy - heading[SINE, p] * dx
    far = reach + size_of(things, i, p) / 2
    return (ahead >= 0) & (ahead * ahead + aside * aside <= far * far)  # no branch: lanes side by side


def inside(things: Any, i: Any, x: Any, y: Any, p: Any) -> Any:
    """True if a point is inside the square of thing i, in lane p."""
    its_x, its_y = place_of(things, i, p)
    half = size_of(things, i, p) / 2
    return (abs(its_x - x) <= half) & (abs(its_y - y) <= half)


MOST_ROWS = 1 << 20  # more than a task has of things


def nearest(s: Any, sensor: Any, n: Any) -> Any:
    """The rows [THING_ROWS, lane] of the thing that a sensor speaks of: of several, in each lane the nearest one.

    The first where two are as near; one that has vanished is nowhere, and NaN where all have. Sensors that follow one
    another and are about the same things look for it once. Of obstacles it is the nearest point of any of them.
    """
    if sensor.things == 0:
        find_nearest_point(s, sensor, n)
        return s.nearest
    if sensor.things == 1:
        return s.things[THING_ROWS * sensor.thing : THING_ROWS * (sensor.thing + 1)]
    found, asked = s.nearest, MOST_ROWS * sensor.things + sensor.thing
    if s.nearest_of[0] == asked:
        return found
    s.nearest_of[0] = asked
    for p in range(n):  # lane by lane: in numbers, not in rows
        x, y = place_of(s.things, sensor.thing, p)
        size, far = size_of(s.things, sensor.thing, p), distance_of(s.things, sensor.thing, p)
        for i in range(sensor.thing + 1, sensor.thing + sensor.things):
            its_x, its_y = place_of(s.things, i, p)
            closer = (distance_of(s.things, i, p) < far) | (far != far)
            x, y = its_x if closer else x, its_y if closer else y
            size = size_of(s.things, i, p) if closer else size
            far = distance_of(s.things, i, p) if closer else far
        found[X, p], found[Y, p], found[SIZE, p], found[DISTANCE, p] = x, y, size, far
    return found


OPENED_SQUARE = 1e40  # of a distance: between any place and a box that has been opened, and any other


def find_nearest_point(s: Any, sensor: Any, n: Any) -> None:
    """Write the point of a sensor's boxes that is nearest to the robot's middle into `s.nearest`, with size 0.

    The first where two are as near; the robot's middle itself where that is in a box. NaN where all have
    opened, or where there are none.
    """
    found, asked = s.nearest, -3 - sensor.box
    if s.nearest_of[0] == asked:
        return
    s.nearest_of[0] = asked
    for p in range(n):
        x, y = middle_of(s.body, p)
        least, to_x, to_y = OPENED_SQUARE, np.nan, np.nan
        for b in range(sensor.box, sensor.box + sensor.boxes):
            its_x, its_y, wide, tall = box_of(s.boxes, b, p)
            low, high = its_x - wide, its_x + wide
            near_x = low if x < low else (high if x > high else x)
            low, high = its_y - tall, its_y + tall
            near_y = low if y < low else (high if y > high else y)
            dx, dy = near_x - x, near_y - y
            square = dx * dx + dy * dy
            closer = square < least
            to_x, to_y = near_x if closer else to_x, near_y if closer else to_y
            least = square if closer else least
        found[X, p], found[Y, p], found[SIZE, p], found[DISTANCE, p] = to_x, to_y, 0.0, length(to_x - x, to_y - y)


def uniform(random: Any, lane: Any, low: Any, high: Any) -> Any:
    """The next number of a lane's generator, between low and high."""
    random[lane] += GOLDEN
    z = random[lane]
    z = (z ^ (z >> S30)) * MIX_1
    z = (z ^ (z >> S27)) * MIX_2
    z = z ^ (z >> S31)
    return low + (high - low) * (np.float64(z >> S11) * UNIFORM_STEP)


def seek(random: Any, lane: Any, seed: Any, stream: Any, place: Any) -> None:
    """Set a lane's generator to a place of one of a seed's streams; the next numbers are those that stand there."""
    random[lane] = seed ^ (STREAM * np.uint64(2 * stream + 1))
    random[lane] += GOLDEN * np.uint64(place)


LANES = 16  # side by side, as one value


def splat(value: Any) -> Any:
    """Sixteen lanes of one number."""
    return np.full(LANES, value, F)


def load(array: Any, row: Any, lane: Any) -> Any:
    """Sixteen lanes of a row of an array [row, lane], from `lane` on; of a flat one an element, in all lanes."""
    return splat(array[row]) if array.ndim == 1 else array[row, lane : lane + LANES].copy()


def store(array: Any, row: Any, lane: Any, value: Any) -> None:
    """Write sixteen lanes into a row of an array [row, lane], from `lane` on."""
    array[row, lane : lane + LANES] = value


def lowest(a: Any, b: Any) -> Any:
    """The lower of two numbers in each of sixteen lanes, the second where one is NaN."""
    return np.where(a < b, a, b)


def highest(a: Any, b: Any) -> Any:
    """The higher of two numbers in each of sixteen lanes, the second where one is NaN."""
    return np.where(a > b, a, b)


def nearer(enter: Any, leave: Any, nearest: Any) -> Any:
    """`enter` in the lanes where 0 <= enter <= leave and enter < nearest; `nearest` elsewhere, and beside a NaN."""
    return np.where((enter >= ZERO) & (enter <= leave) & (enter < nearest), enter, nearest)


def sigmoid(values: Singles) -> Singles:
    """The sigmoid of each value, float32 in and out; NaN gives what −∞ gives."""
    x: Singles = np.fmin(np.fmax(values * HALF, _LOW), _HIGH)
    y = x * x
    return _polynomial(y, _ABOVE) * x / _polynomial(y, _BELOW) * HALF + HALF


def _polynomial(x: Singles, coefficients: Sequence[np.float32]) -> Singles:
    """The value of a polynomial, of the coefficients of its powers from the lowest on."""
    value: Singles = x * coefficients[-1]
    for coefficient in coefficients[-2:0:-1]:
        value += coefficient
        value *= x
    value += coefficients[0]
    return value


def sigmoids(*values: Any) -> Any:
    """The sigmoid of each of some vectors of sixteen lanes."""
    return tuple(sigmoid(value) for value in values)
