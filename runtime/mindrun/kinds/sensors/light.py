"""The light of a thing where the robot is."""

from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Physical
from mindrun.numbers.quantity import POSITIVE, THING

if TYPE_CHECKING:  # a lane is given these when it is compiled
    import numpy as np

    from mindrun.numbers.arithmetic import (
        BOX_COLUMNS,
        DISTANCE,
        LOOSE_ROWS,
        TURN,
        ZERO,
        F,
        X,
        Y,
        box_of,
        nearest,
        place_of,
        sine_cosine,
        size_of,
    )


@kind("sensor", "light")
class Light(Physical):
    """Light of a thing, of several the nearest: 1 at its middle, 0.5 at `range`, far away falling with the square.

    1 / (1 + (distance of the middles / range)²); 0 without it, and where something solid is between the middles: an
    obstacle, a wall, or a box or ball of another name.
    """

    of: Annotated[str, THING]
    range: Annotated[float, POSITIVE] = 10.0

    near = 1
    remedy = "Let a task contain what it is about"

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """1 / (1 + (distance / range)²) of the nearest thing, and 0 in the shadow of anything solid."""
        out = s.readings[sensor.start]
        if sensor.things == 0:
            for p in range(n):
                out[p] = ZERO
            return
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
            along, across = cosine * half_x + sine * half_y, cosine * half_y - sine * half_x
            is_met = meets_rectangle(cosine * dx + sine * dy, cosine * dy - sine * dx, along, across, half, half)
        if is_met:
            return True
    return False


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
