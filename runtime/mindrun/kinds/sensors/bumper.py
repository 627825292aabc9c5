"""Switches around the body that feel what is solid."""

from math import pi
from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Physical
from mindrun.kinds.things.thing import WorldFacts
from mindrun.numbers.quantity import Angles, Quantity
from mindrun.numbers.trigonometry import cosine, sine

if TYPE_CHECKING:  # a lane is given these when it is compiled
    import numpy as np

    from mindrun.numbers.arithmetic import *

WIDTH = Quantity("an angle", {"deg": pi / 180}, low=pi / 180, high=2 * pi)


@kind("sensor", "bumper")
class Bumper(Physical):
    """Switches around the body, one reading per angle: 1 while something solid touches it there, else 0.

    That is an obstacle, a wall, another robot, or a box or ball that can be pushed; what the claw holds has no switch.
    Angles turn counterclockwise from straight ahead; each switch is `width` wide, half of it to either side.
    """

    at: Angles = (0.0,)
    width_: Annotated[float, WIDTH] = pi / 4

    near = 1
    remedy = "Let a task contain something solid"

    @property
    def sector(self) -> float:  # type: ignore[override]
        return self.width_

    @property
    def numbers(self) -> tuple[float, ...]:  # type: ignore[override]
        """The cosine of half the width, then cosine and sine of each angle."""
        return cosine(self.width_ / 2), *(f(angle) for angle in self.at for f in (cosine, sine))

    def constant(self, world: WorldFacts) -> float | None:
        return None if world.is_solid else 0.0

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        half_x, half_y = t.world[0].half_x, t.world[0].half_y
        for p in range(n):
            for k in range(sensor.width):
                s.readings[sensor.start + k, p] = ZERO
            x, y = s.body[X, p], s.body[Y, p]
            for b in range(s.nearby_count[p]):
                box = BOX_COLUMNS * b
                dx = beyond(s.nearby[box + X, p] - x, s.nearby[box + HALF_X, p])
                dy = beyond(s.nearby[box + Y, p] - y, s.nearby[box + HALF_Y, p])
                press(t, s, sensor, dx, dy, dx == 0.0 or dy == 0.0, p)
            press(t, s, sensor, half_x - x, 0.0, True, p)
            press(t, s, sensor, -half_x - x, 0.0, True, p)
            press(t, s, sensor, 0.0, half_y - y, True, p)
            press(t, s, sensor, 0.0, -half_y - y, True, p)
            for i in range(len(t.loose)):
                lean(t, s, sensor, i, p)
            robots = len(t.robots)
            for other in range(p - p % robots, p - p % robots + robots):
                if other != p:
                    lean_robot(t, s, sensor, other, p)


def lean(t: Any, s: Any, sensor: Any, i: Any, p: Any) -> None:
    """Press the switches of lane p that loose thing i touches, however it is turned."""
    x, y = place_of(s.things, t.loose[i].thing, p)
    dx, dy = x - s.body[X, p], y - s.body[Y, p]
    half = size_of(s.things, t.loose[i].thing, p) / 2
    if np.isnan(dx):
        return  # it has vanished
    if t.loose[i].is_round:
        lean_disc(t, s, sensor, dx, dy, half, p)
    else:
        sn, c = sine_cosine(s.loose[LOOSE_ROWS * i + TURN, p])
        lean_box(t, s, sensor, dx, dy, half, half, c, sn, p)


def lean_robot(t: Any, s: Any, sensor: Any, other: Any, p: Any) -> None:
    """Press the switches of lane p that the robot of another lane touches."""
    dx, dy, body = s.body[X, other] - s.body[X, p], s.body[Y, other] - s.body[Y, p], t.world[0]
    if body.is_round:
        lean_disc(t, s, sensor, dx, dy, body.radius, p)
    else:
        lean_box(t, s, sensor, dx, dy, body.front, body.side, s.heading[COSINE, other], s.heading[SINE, other], p)


def lean_disc(t: Any, s: Any, sensor: Any, dx: Any, dy: Any, half: Any, p: Any) -> None:
    """Press the switches of lane p that a disc touches, whose middle is (dx, dy) from the body's."""
    far = np.sqrt(dx * dx + dy * dy)
    share = 1.0 - half / far if far > half else 0.0
    press(t, s, sensor, dx * share, dy * share, False, p)


def lean_box(t: Any, s: Any, sensor: Any, dx: Any, dy: Any, half_x: Any, half_y: Any, c: Any, sn: Any, p: Any) -> None:
    """Press the switches of lane p that a rectangle touches, turned by the angle of that cosine and sine."""
    along, across = beyond(c * dx + sn * dy, half_x), beyond(c * dy - sn * dx, half_y)
    is_flat = along == 0.0 or across == 0.0
    press(t, s, sensor, c * along - sn * across, sn * along + c * across, is_flat, p)


def beyond(away: Any, side: Any) -> Any:
    """The signed distance along an axis to something whose middle is `away` and half side is `side`; 0 within."""
    if away > side:
        return away - side
    return away + side if away < -side else 0.0


def touches(body: Any, ahead: Any, aside: Any, is_flat: Any) -> Any:
    """True if something touches the body, by its nearest point, which is within the circle around the body.

    `ahead` and `aside` are that point's distances along the body's axes. What `is_flat` there meets a corner of a
    rectangle before that point is in it.
    """
    if body.is_round:
        return True
    if is_flat:
        return ahead * ahead + aside * aside <= body.front * ahead + body.side * aside
    return ahead <= body.front and aside <= body.side


def press(t: Any, s: Any, sensor: Any, dx: Any, dy: Any, is_flat: Any, p: Any) -> None:
    """Set the readings of lane p to 1 whose sector has the direction (dx, dy), if the body reaches to that point."""
    far = np.sqrt(dx * dx + dy * dy)
    if not far <= t.world[0].radius:  # infinitely far, where there is no wall, and no number, where it has vanished
        return
    c, sn = s.heading[COSINE, p], s.heading[SINE, p]
    ahead, aside = c * dx + sn * dy, c * dy - sn * dx
    if touches(t.world[0], abs(ahead), abs(aside), is_flat):
        for k in range(sensor.width):
            first = sensor.number + 1 + 2 * k
            if ahead * t.numbers[first + COSINE] + aside * t.numbers[first + SINE] >= t.numbers[sensor.number] * far:
                s.readings[sensor.start + k, p] = ONE
