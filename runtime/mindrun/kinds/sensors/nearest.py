"""Sensors of a thing, of several the nearest: where it is, how far away, and how bright."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from math import inf
from typing import TYPE_CHECKING, Any

from mindrun.kinds.registry import kind, left_out
from mindrun.kinds.sensors.sensor import Flaw, Physical, Ranging, Row, Scene
from mindrun.numbers.quantity import Length, Positive, Ratio, ServoName, ThingName

if TYPE_CHECKING:  # a lane is given these when it is compiled
    import numpy as np

    from mindrun.numbers.arithmetic import *
    from mindrun.numbers.arrays import Reader, Readings

ROUGH = {"noise": 0.0, "lost": 0.0, "every": 1, "delay": 0, "on": ""}  # what only a sensor that measures has


class AboutPlace(Physical):
    """A sensor of a thing, or of a memory that is a place: then it `is_reckoned` from that, and nothing measures it."""

    __slots__ = ()

    of: str
    is_reckoned: bool

    can_be_reckoned = True

    @property
    def things(self) -> tuple[str, ...]:
        return () if self.is_reckoned else super().things

    @property
    def source(self) -> str:
        return self.of if self.is_reckoned else ""

    @property
    def is_given(self) -> bool:  # type: ignore[override]
        return not self.is_reckoned

    def flaw(self, widths: Mapping[str, int], directions: Collection[str]) -> Flaw | None:
        """The argument of a sensor that measures; it is not said where a memory is meant."""
        for field, unsaid in ROUGH.items() if self.is_reckoned else ():
            if getattr(self, field, unsaid) != unsaid:
                message = f"{self.of} is a memory, so this is reckoned, and has no {field}."
                hint = "Leave it out; what is imperfect are the odometers and the compass."
                return Flaw("reckoned-sensor", field, message, hint)
        return None

    def row(self, scene: Scene) -> Row:
        compass = {"part": scene.starts[scene.kinds[self.of].compass]} if self.is_reckoned else {}
        return {**Physical.row(self, scene), **compass}

    def gain(self, scene: Scene) -> float:
        """How many units 1 is in the readings of the place; 0 of a thing."""
        return 2.0 * scene.kinds[self.of].range if self.is_reckoned else 0.0


@kind("sensor", "bearing")
class Bearing(AboutPlace):
    """Direction of a thing: 0.5 straight ahead, less on the left, more on the right; 0.5 without it.

    It goes round: noise leads from 0 to 1, which are both behind.
    0.5 − atan2(y, x)/2π in the body's frame, of several the nearest's; of an obstacle, a wall or a map its nearest
    point's. Within `dead_zone` of straight ahead it reads 0.5; with a `range`, a thing farther away than that, too.
    `on` a servo, straight ahead is where that looks. Of a memory that is a place it is reckoned, by its compass.
    """

    of: ThingName
    range: Length = 0.0
    dead_zone: Ratio = 0.0
    on: ServoName = left_out("")
    is_reckoned: bool = left_out(False, is_argument=False)

    circular = True
    scaled = True
    blank = rest = 0.5
    is_about = staticmethod(lambda kind: True)  # whatever there is

    def row(self, scene: Scene) -> Row:
        return {**AboutPlace.row(self, scene), "range": self.range or inf}

    def reader(self, scene: Scene) -> Reader | None:
        if not self.is_reckoned:
            return None
        import numpy as np

        from mindrun.numbers.arithmetic import HALF, reckoned_bearing, reckoned_distance

        place, compass = scene.starts[self.of], scene.starts[scene.kinds[self.of].compass]
        unit, dead_zone, most = np.float32(self.gain(scene)), np.float32(self.dead_zone), self.range or inf

        def read(number: int, now: Readings, before: Readings | None) -> np.float32:
            v = reckoned_bearing(now[place], now[place + 1], now[compass])
            v = HALF if abs(v - HALF) < dead_zone else v
            return np.float32(v if reckoned_distance(now[place], now[place + 1], unit) <= most else HALF)

        return read

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        out = s.readings[sensor.start]
        if sensor.gain > ZERO:
            east, north, facing = s.readings[sensor.source], s.readings[sensor.source + 1], s.readings[sensor.part]
            for p in range(n):
                v = reckoned_bearing(east[p], north[p], facing[p])
                v = HALF if abs(v - HALF) < sensor.dead_zone else v
                out[p] = v if reckoned_distance(east[p], north[p], sensor.gain) <= sensor.range else HALF
            return
        thing = nearest(s, sensor, n)
        x, y, away = thing[X], thing[Y], thing[DISTANCE]
        for p in range(n):
            dx, dy = F(x[p] - s.body[X, p]), F(y[p] - s.body[Y, p])
            cosine, sine = F(s.heading[COSINE, p]), F(s.heading[SINE, p])
            v = bearing(cosine * dx + sine * dy, cosine * dy - sine * dx)
            v = HALF if abs(v - HALF) < sensor.dead_zone else v
            out[p] = v if away[p] <= sensor.range else HALF


@kind("sensor", "distance")
class Distance(AboutPlace, Ranging):
    """Distance from the body's rim to that of a thing, of several the nearest: 0 touching, 1 from `range` on or none.

    (distance of the middles − where the body ends in that direction − size / 2) / range: a square is taken for the disc
    in it. Of an obstacle, a wall or a map it is to the nearest point, which has no size. Of a memory that is a place it
    is reckoned, from the body's middle.
    """

    of: ThingName
    range: Positive = 40.0
    is_reckoned: bool = left_out(False, is_argument=False)

    remedy = "Let a task contain what it is about"
    is_about = staticmethod(lambda kind: True)  # whatever there is

    def reader(self, scene: Scene) -> Reader | None:
        if not self.is_reckoned:
            return None
        import numpy as np

        from mindrun.numbers.arithmetic import clamp, reckoned_distance

        place, unit, most = scene.starts[self.of], np.float32(self.gain(scene)), self.range

        def read(number: int, now: Readings, before: Readings | None) -> np.float32:
            return np.float32(clamp(np.float32(reckoned_distance(now[place], now[place + 1], unit) / most)))

        return read

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        out = s.readings[sensor.start]
        if sensor.gain > ZERO:
            east, north = s.readings[sensor.source], s.readings[sensor.source + 1]
            for p in range(n):
                out[p] = clamp(F(reckoned_distance(east[p], north[p], sensor.gain) / sensor.range))
            return
        thing, body = nearest(s, sensor, n), t.world[0]
        away, size, radius = thing[DISTANCE], thing[SIZE], body.radius
        if body.is_round:
            for p in range(n):
                share = (away[p] - radius - size[p] / 2) / sensor.range
                out[p] = ONE if np.isnan(share) else clamp(F(share))
        else:
            for p in range(n):
                share = (away[p] - rim_towards(body, s, thing, p) - size[p] / 2) / sensor.range
                out[p] = ONE if np.isnan(share) else clamp(F(share))


def rim_towards(body: Any, s: Any, thing: Any, p: Any) -> Any:
    """The distance from a rectangular body's middle to its rim towards a thing, at most to the thing's middle."""
    dx, dy = thing[X, p] - s.body[X, p], thing[Y, p] - s.body[Y, p]
    cosine, sine = s.heading[COSINE, p], s.heading[SINE, p]
    ahead, aside = abs(cosine * dx + sine * dy) / body.front, abs(cosine * dy - sine * dx) / body.side
    most = ahead if ahead > aside else aside
    return thing[DISTANCE, p] / (most if most > 1.0 else 1.0)


@kind("sensor", "light")
class Light(Physical):
    """Light of a thing, of several the nearest: 1 at its middle, 0.5 at `range`, far away falling with the square.

    1 / (1 + (distance of the middles / range)²); 0 without it, and where something solid is between the middles: an
    obstacle, a wall, or a box, ball or robot of another name.
    """

    of: ThingName
    range: Positive = 10.0

    near = 1
    remedy = "Let a task contain what it is about"

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        out = s.readings[sensor.start]
        thing = nearest(s, sensor, n)
        x, y, away = thing[X], thing[Y], thing[DISTANCE]
        for p in range(n):
            share = away[p] / sensor.range
            v = F(1.0 / (1.0 + share * share))
            middle_x, middle_y = s.body[X, p], s.body[Y, p]
            half_x, half_y = (x[p] - middle_x) / 2, (y[p] - middle_y) / 2
            middle_x, middle_y = middle_x + half_x, middle_y + half_y
            is_dark = (
                np.isnan(share)
                or is_shaded(s.boxes, middle_x, middle_y, half_x, half_y, p)
                or is_shaded_by_loose(t, s, sensor, middle_x, middle_y, half_x, half_y, p)
                or is_shaded_by_robot(t, s, sensor, middle_x, middle_y, half_x, half_y, p)
            )
            out[p] = ZERO if is_dark else v


def is_shaded(boxes: Any, x: Any, y: Any, half_x: Any, half_y: Any, p: Any) -> Any:
    """True if a box of lane p meets a straight line, given by its middle (x, y) and half of its way."""
    for b in range(boxes.shape[1] // BOX_COLUMNS):
        its_x, its_y, wide, high = box_of(boxes, b, p)
        if meets_rectangle(x - its_x, y - its_y, half_x, half_y, wide, high):
            return True
    return False


def is_shaded_by_loose(t: Any, s: Any, sensor: Any, x: Any, y: Any, half_x: Any, half_y: Any, p: Any) -> Any:
    """True if a loose thing of lane p meets that line, however it is turned; not one of those the sensor is about."""
    for i in range(len(t.loose)):
        thing = t.loose[i].thing
        if (sensor.thing <= thing) & (thing < sensor.thing + sensor.things):
            continue
        its_x, its_y = place_of(s.things, thing, p)
        dx, dy, half = x - its_x, y - its_y, size_of(s.things, thing, p) / 2
        if t.loose[i].is_round:
            is_met = meets_disc(dx, dy, half_x, half_y, half)
        else:
            sine, cosine = sine_cosine(s.loose[LOOSE_ROWS * i + TURN, p])
            is_met = meets_turned(dx, dy, half_x, half_y, half, half, cosine, sine)
        if is_met:
            return True
    return False


def is_shaded_by_robot(t: Any, s: Any, sensor: Any, x: Any, y: Any, half_x: Any, half_y: Any, p: Any) -> Any:
    """True if another robot of the world of lane p meets that line; not one of those the sensor is about."""
    home, body = p - p % len(t.robots), t.world[0]
    for number in range(len(t.robots)):
        thing, other = t.robots[number].thing, home + number
        if (other == p) | ((sensor.thing <= thing) & (thing < sensor.thing + sensor.things)):
            continue
        dx, dy = x - s.body[X, other], y - s.body[Y, other]
        if body.is_round:
            is_met = meets_disc(dx, dy, half_x, half_y, body.radius)
        else:
            cosine, sine = s.heading[COSINE, other], s.heading[SINE, other]
            is_met = meets_turned(dx, dy, half_x, half_y, body.front, body.side, cosine, sine)
        if is_met:
            return True
    return False


def meets_turned(dx: Any, dy: Any, half_x: Any, half_y: Any, wide: Any, high: Any, cosine: Any, sine: Any) -> Any:
    """True if a line meets a rectangle that is turned by the angle of that cosine and sine."""
    along, across = cosine * half_x + sine * half_y, cosine * half_y - sine * half_x
    return meets_rectangle(cosine * dx + sine * dy, cosine * dy - sine * dx, along, across, wide, high)


def meets_rectangle(dx: Any, dy: Any, half_x: Any, half_y: Any, wide: Any, high: Any) -> Any:
    """True if a line, whose middle is (dx, dy) from a rectangle's, meets it: no axis separates them; False of NaN."""
    return (
        abs(dx) <= wide + abs(half_x)
        and abs(dy) <= high + abs(half_y)
        and abs(half_x * dy - half_y * dx) <= high * abs(half_x) + wide * abs(half_y)
    )


def meets_disc(dx: Any, dy: Any, half_x: Any, half_y: Any, radius: Any) -> Any:
    """True if a line, whose middle is (dx, dy) from a disc's, meets it: its nearest point, perhaps an end, is in it."""
    along, square = dx * half_x + dy * half_y, half_x * half_x + half_y * half_y
    if abs(along) < square:
        aside = half_x * dy - half_y * dx
        return aside * aside <= radius * radius * square
    way = -1.0 if along > 0.0 else 1.0
    end_x, end_y = dx + way * half_x, dy + way * half_y
    return end_x * end_x + end_y * end_y <= radius * radius
