"""Sensors that look along rays: at whatever is solid, and at one thing alone, as a line of a camera does."""

from typing import TYPE_CHECKING, Any

from mindrun.kinds.registry import kind, left_out
from mindrun.kinds.sensors.sensor import Ranging
from mindrun.kinds.things.thing import WorldFacts
from mindrun.numbers.quantity import Angles, Positive, Ratio, ServoName, ThingName

if TYPE_CHECKING:  # a lane is given these when it is compiled
    import numpy as np

    from mindrun.numbers.arithmetic import *


@kind("sensor", "range_finder")
class RangeFinder(Ranging):
    """Distance from the body's rim to what is solid, one reading per angle: 0 touching, 1 clear within `range`.

    Angles turn counterclockwise from straight ahead, or from where the servo looks that it is `on`. A reading below
    `dead_zone` is 0.
    """

    at: Angles = (0.0,)
    range: Positive = 12.0
    dead_zone: Ratio = 0.005
    on: ServoName = left_out("")

    looks = True

    def constant(self, world: WorldFacts) -> float | None:
        return None if world.is_solid else 1.0

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        scale = ONE / F(sensor.range)
        for ray in range(sensor.width):
            out, far = s.readings[sensor.start + ray], s.sight[FIRST_RAY + sensor.ray + ray]
            rim = t.rims[sensor.ray + ray]
            if sensor.servo >= 0 and not t.world[0].is_round:
                for p in range(n):
                    v = clamp((far[p] - turned_rim(t, s, sensor, ray, p)) * scale)
                    out[p] = ZERO if v < sensor.dead_zone else v
                continue
            for p in range(n):
                v = clamp((far[p] - rim) * scale)
                out[p] = ZERO if v < sensor.dead_zone else v


@kind("sensor", "eye")
class Eye(Ranging):
    """Distance from the body's rim to a thing, one reading per angle: 0 touching or inside, 1 where the ray meets none.

    A range finder that sees all things of that name and no other, obstacles and walls too; whatever is solid before one
    hides it, but for those of its own name that can be pushed. Angles turn counterclockwise from straight ahead, or
    from where the servo looks that it is `on`. Of a box that can be pushed it sees the disc in it, of another robot
    that around it.
    """

    of: ThingName
    at: Angles = (0.0,)
    range: Positive = 30.0
    on: ServoName = left_out("")

    looks = True
    remedy = "Let a task contain what it is about"
    is_about = staticmethod(lambda kind: True)  # whatever there is

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """The distance along each ray to the thing that it meets first, if nothing solid comes before."""
        scale, out = ONE / F(sensor.range), s.readings[sensor.start : sensor.start + sensor.width]
        for k in range(sensor.width):
            for p in range(n):
                out[k, p] = MAX_FLOAT32
        for i in range(sensor.thing, sensor.thing + sensor.things):
            locate(s.body, s.things, i, s.frame, n)
            is_disc = t.things[i].is_round or t.things[i].loose >= 0
            for k in range(sensor.width):
                cosine, sine = t.rays[COSINE, sensor.ray + k], t.rays[SINE, sensor.ray + k]
                if is_disc:
                    meet_disc(s.sight, s.frame, cosine, sine, out[k], n)
                else:
                    meet_rectangle(s.sight, s.frame, cosine, sine, out[k], n)
        for b in range(sensor.box, sensor.box + sensor.boxes):
            locate_box(s.body, s.boxes, b, s.frame, n)
            for k in range(sensor.width):
                cosine, sine = t.rays[COSINE, sensor.ray + k], t.rays[SINE, sensor.ray + k]
                meet_rectangle(s.sight, s.frame, cosine, sine, out[k], n)
        for k in range(sensor.width):
            solid, rim = s.sight[FIRST_RAY + sensor.ray + k], t.rims[sensor.ray + k]
            is_turned = sensor.servo >= 0 and not t.world[0].is_round
            for p in range(n if is_turned else 0):
                rim = turned_rim(t, s, sensor, k, p)
                out[k, p] = clamp((out[k, p] - rim) * scale) if out[k, p] <= solid[p] else ONE
            for p in range(0 if is_turned else n):
                out[k, p] = clamp((out[k, p] - rim) * scale) if out[k, p] <= solid[p] else ONE


def turned_rim(t: Any, s: Any, sensor: Any, ray: Any, p: Any) -> Any:
    """The distance from a rectangular body's middle to its rim along a ray of a sensor that is on a servo."""
    sine, cosine = sine_cosine(s.swivel[sensor.servo, p])
    c, d = t.rays[COSINE, sensor.ray + ray], t.rays[SINE, sensor.ray + ray]
    ahead, aside = abs(cosine * c - sine * d) / t.world[0].front, abs(sine * c + cosine * d) / t.world[0].side
    return F(1.0 / (ahead if ahead > aside else aside))


def locate(body: Any, things: Any, i: Any, frame: Any, n: Any) -> None:
    """Write thing i into `frame`: its middle from each robot's, and half of its size along x and y, in float32."""
    for p in range(n):
        x, y = place_of(things, i, p)
        frame[X, p], frame[Y, p] = F(x - body[X, p]), F(y - body[Y, p])
        frame[HALF_X, p] = frame[HALF_Y, p] = F(size_of(things, i, p) / 2)


def locate_box(body: Any, boxes: Any, b: Any, frame: Any, n: Any) -> None:
    """Write box b into `frame`: its middle from each robot's, and half of its sides along x and y, in float32."""
    for p in range(n):
        x, y, wide, high = box_of(boxes, b, p)
        frame[X, p], frame[Y, p] = F(x - body[X, p]), F(y - body[Y, p])
        frame[HALF_X, p], frame[HALF_Y, p] = F(wide), F(high)


def meet_disc(heading: Any, frame: Any, cosine: Any, sine: Any, out: Any, n: Any) -> None:
    """Lower `out` to the distance from each robot's middle along a ray to the disc in `frame`, where that is less."""
    for p in range(n):
        c = heading[COSINE, p] * cosine - heading[SINE, p] * sine
        s = heading[SINE, p] * cosine + heading[COSINE, p] * sine
        dx, dy, half, before = frame[X, p], frame[Y, p], frame[HALF_X, p], out[p]
        along, aside = c * dx + s * dy, c * dy - s * dx
        inner = half * half - aside * aside
        chord = F(np.sqrt(inner if inner > ZERO else ZERO))
        near = along - chord
        near = near if near > ZERO else ZERO
        out[p] = near if (inner >= ZERO) & (along + chord >= ZERO) & (near < before) else before


def meet_rectangle(heading: Any, frame: Any, cosine: Any, sine: Any, out: Any, n: Any) -> None:
    """Lower `out` to the distance along a ray to the rectangle in `frame`, where that is less (the slab method)."""
    for p in range(n):
        ix = ONE / (heading[COSINE, p] * cosine - heading[SINE, p] * sine)
        iy = ONE / (heading[SINE, p] * cosine + heading[COSINE, p] * sine)
        dx, dy, half_x, half_y, before = frame[X, p], frame[Y, p], frame[HALF_X, p], frame[HALF_Y, p], out[p]
        left, right, low, high = (dx - half_x) * ix, (dx + half_x) * ix, (dy - half_y) * iy, (dy + half_y) * iy
        enter_x, leave_x = (left, right) if left < right else (right, left)
        enter_y, leave_y = (low, high) if low < high else (high, low)
        enter = enter_x if enter_x > enter_y else enter_y
        leave = leave_x if leave_x < leave_y else leave_y
        near = enter if enter > ZERO else ZERO
        out[p] = near if (enter <= leave) & (leave >= ZERO) & (near < before) else before
