"""The distance of a thing."""

from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Physical
from mindrun.numbers.quantity import POSITIVE, THING

if TYPE_CHECKING:  # a lane is given these when it is compiled
    import numpy as np

    from mindrun.numbers.arithmetic import COSINE, DISTANCE, ONE, SINE, SIZE, F, X, Y, clamp, nearest


@kind("sensor", "distance")
class Distance(Physical):
    """Distance from the body's rim to that of a thing, of several the nearest: 0 touching, 1 from `range` on or none.

    (distance of the middles − where the body ends in that direction − size / 2) / range: a square is taken for the disc
    in it. Of an obstacle, a wall or a map it is to the nearest point, which has no size.
    """

    of: Annotated[str, THING]
    range: Annotated[float, POSITIVE] = 40.0

    scaled = True
    near = 0
    unit = "m"
    blank = 1.0
    remedy = "Let a task contain what it is about"
    is_about = staticmethod(lambda kind: True)  # whatever there is

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """The distance of the middles less what lies within the two rims, as a share of `range`."""
        out = s.readings[sensor.start]
        if sensor.things == 0 and sensor.boxes == 0:
            for p in range(n):
                out[p] = ONE
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
