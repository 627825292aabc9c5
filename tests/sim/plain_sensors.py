"""What sensors of places, speeds and touch read in a plain world, the obvious way: (least, most) of each reading."""

import math

import numpy as np
from mindrun.kinds.sensors.bumper import Bumper
from mindrun.kinds.sensors.contact import Floor
from mindrun.kinds.sensors.motion import Odometer, Position, Speed, TurnRate
from mindrun.kinds.sensors.nearest import Distance, Light
from mindrun.kinds.sensors.rays import Eye
from mindrun.kinds.sensors.signal import Signal

from tests.sim.plain_bodies import rim_of, side_of

WORD = (1 << 64) - 1  # the largest number of 64 bits
HAIR = 1e-6  # by which something may be met or missed


def sensed(world, kind, all_of, boxes):
    """The readings of a sensor about these things or boxes, and what is read where one is lost."""
    body = world.body.body
    ahead = body.velocity.x * math.cos(world.angle) + body.velocity.y * math.sin(world.angle)
    match kind:
        case Distance():
            return [distance(world, kind, world.nearest(all_of, boxes))], 1.0
        case Light():
            return [light(world, kind, world.nearest(all_of), all_of)], 0.0
        case Eye():
            return [eye(world, kind, all_of, boxes, world.looks(kind) + at) for at in kind.at], 1.0
        case Signal():  # there is nobody else
            return [(0.0, 0.0)], 0.0
        case TurnRate():
            return [signed(-body.angular_velocity / kind.range, kind.dead_zone)], 0.5
        case Speed():
            return [signed(ahead / kind.range, kind.dead_zone)], 0.5
        case Odometer():
            out = side_of(world.graph.body) * (1 if kind.side == "right" else -1)
            return [signed((ahead + out * body.angular_velocity) / kind.range)], 0.5
        case Position():
            return [signed((world.x if kind.along == "x" else world.y) / kind.range)], 0.5
        case Floor():
            return [floor(world, all_of, kind.ahead, left) for left in kind.at], 0.0
        case Bumper():
            return [bumper(world, at, kind.width_ / 2) for at in kind.at], 0.0
    raise TypeError(kind)


def ordered(kind, tick_seconds, seed, number, tick):
    """The readings of the order with a number among orders, in a tick of a run of that seed."""
    turn = tick // max(1, round(kind.every / tick_seconds)) if kind.every else 0
    drawn, heard = (splitmix(seed ^ 0xA24BAED4963EE407 * (2 * number + 1) & WORD, 2 * turn + k) for k in (1, 2))
    low, high = kind.order.first, kind.order.last
    if high.is_integer() and low == 1:
        value = kind.neutral if heard < kind.lost else 1 + math.floor(drawn * high)
        return [float(value == each) for each in range(1, int(high) + 1)]
    return [float(np.float32((kind.neutral - low) / (high - low) if heard < kind.lost else drawn))]


def splitmix(seed, number):
    """Number `number` that SplitMix64 draws of a seed, from 1 on, in 0..1."""
    z = (seed + number * 0x9E3779B97F4A7C15) & WORD
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9 & WORD
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB & WORD
    return ((z ^ (z >> 31)) >> 11) / 2**53


def signed(share, dead_zone=0.0):
    """(least, most) of what reads 0.5 for nothing and moves by half of a share of its range."""
    value = min(1.0, max(0.0, 0.5 + 0.5 * share))
    off = abs(value - 0.5) - dead_zone
    if abs(off) < HAIR:
        return min(value, 0.5), max(value, 0.5)
    return (value, value) if off > 0 else (0.5, 0.5)


def distance(world, kind, place):
    """Between the rim of the body in the direction of a disc, and that of the disc."""
    if place is None:
        return 1.0, 1.0
    dx, dy = place[0] - world.x, place[1] - world.y
    away = math.hypot(dx, dy)
    rim = rim_of(world.graph.body, math.atan2(dy, dx) - world.angle)
    value = (away - rim - place[2] / 2) / kind.range
    return (min(1.0, max(0.0, value)),) * 2


def light(world, kind, place, all_of):
    """The square law, where nothing solid cuts the line; both where it is grazed."""
    if place is None:
        return 0.0, 0.0
    away = math.hypot(place[0] - world.x, place[1] - world.y)
    angle = math.atan2(place[1] - world.y, place[0] - world.x)
    shaded = [is_cut(world, angle, away + more, more, all_of) for more in (HAIR, -HAIR)]
    value = 1 / (1 + (away / kind.range) ** 2)
    return 0.0 if shaded[0] else value, 0.0 if shaded[1] else value


def is_cut(world, angle, away, more, but):
    """Whether what is solid and `more` larger lies on the way so far from the robot, or the robot in it."""
    spans = [crossed(world, (x, y, 2 * wide, 2 * high), angle, more, False) for x, y, wide, high in world.boxes]
    spans += [world.body.loose.span(world, i, angle, more) for i in world.body.loose.there if i not in but]
    return any(span and span[0] <= away and span[1] >= 0 for span in spans)


def eye(world, kind, all_of, boxes, angle):
    """What a ray meets first of the things or boxes, if nothing solid is before it."""
    found = []
    others = [box for box in world.boxes if not any(np.array_equal(box, own) for own in boxes)]
    loose = [i for i in world.body.loose.there if i not in all_of]
    for more in (1e-3, -1e-3):
        near = math.inf
        for i in all_of:
            kind_of = world.things[i].kind
            span = crossed(world, world.places[i], angle, more, kind_of.is_round or kind_of.is_loose)
            if span and span[1] >= 0:
                near = min(near, max(0.0, span[0]))
        for x, y, wide, high in boxes:
            span = crossed(world, (x, y, 2 * wide, 2 * high), angle, more, False)
            if span and span[1] >= 0:
                near = min(near, max(0.0, span[0]))
        for grown in (1e-3, -1e-3):
            hiding = [world.body.loose.distance(world, i, angle, grown) for i in loose]
            solid = world.distance(angle, grown, hiding, others)
            share = (near - rim_of(world.graph.body, angle - world.angle)) / kind.range
            found.append(min(1.0, max(0.0, share)) if near <= solid else 1.0)
    return min(found), max(found)


def crossed(world, place, angle, more, is_round):
    """Where the line from the robot in a direction enters a disc or a square and where it leaves it, if it does."""
    dx, dy, half, high = place[0] - world.x, place[1] - world.y, place[2] / 2 + more, place[-1] / 2 + more
    c, s = math.cos(angle), math.sin(angle)
    if math.isnan(dx):
        return None
    if is_round:
        along, aside = c * dx + s * dy, c * dy - s * dx
        if half < 0 or abs(aside) > half:
            return None
        chord = math.sqrt(half**2 - aside**2)
        return along - chord, along + chord
    enter, leave = -math.inf, math.inf
    for middle, way, side in ((dx, c, half), (dy, s, high)):
        if abs(way) > 1e-12:
            ends = sorted(((middle - side) / way, (middle + side) / way))
            enter, leave = max(enter, ends[0]), min(leave, ends[1])
        elif abs(middle) > side:
            return None
    return (enter, leave) if enter <= leave else None


def floor(world, all_of, ahead, left):
    """Whether a point of the body lies on one of the things."""
    c, s = math.cos(world.angle), math.sin(world.angle)
    x, y = world.x + c * ahead - s * left, world.y + s * ahead + c * left
    inner = outer = False
    for i in all_of:
        dx, dy, half = abs(world.places[i][0] - x), abs(world.places[i][1] - y), world.places[i][2] / 2
        far = math.hypot(dx, dy) if world.things[i].kind.is_round else max(dx, dy)
        inner, outer = inner or far <= half - HAIR, outer or far <= half + HAIR
    return float(inner), float(outer)


def bumper(world, at, half):
    """Whether the body touches something in the sector around an angle."""
    walls = world.half
    points = [(sign * walls[0], world.y) for sign in (-1, 1)] + [(world.x, sign * walls[1]) for sign in (-1, 1)]
    for x, y, wide, high in world.boxes:
        points.append((min(x + wide, max(x - wide, world.x)), min(y + high, max(y - high, world.y))))
    points += [touched_at(world, i) for i in world.body.loose.there if not math.isnan(world.places[i][0])]
    inner = outer = False
    for x, y in points:
        far = math.hypot(x - world.x, y - world.y)
        turned = math.atan2(y - world.y, x - world.x) - world.angle - at
        off = abs(math.remainder(turned, 2 * math.pi)) if far > HAIR else 0.0
        rim = rim_of(world.graph.body, turned + at)
        inner = inner or (far <= rim - HAIR and off <= half - HAIR)
        outer = outer or (far <= world.radius + HAIR and off <= half + HAIR)
    return float(inner), float(outer)


def touched_at(world, i):
    """The point of a box or ball that is nearest to the robot's middle."""
    body, half = world.body.loose.there[i][0], world.places[i][2] / 2
    away = body.position - (world.x, world.y)
    if world.things[i].kind.is_round:
        return away * max(0.0, 1 - half / away.length if away.length else 0.0) + (world.x, world.y)
    x, y = (-away).rotated(-body.angle)
    return body.position + type(away)(min(half, max(-half, x)), min(half, max(-half, y))).rotated(body.angle)
