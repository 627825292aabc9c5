"""The direction of a thing."""

from math import inf
from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Physical, Row, Scene
from mindrun.numbers.quantity import LENGTH, RATIO, THING

if TYPE_CHECKING:  # a lane is given these when it is compiled
    from mindrun.numbers.arithmetic import COSINE, DISTANCE, HALF, SINE, F, X, Y, bearing, nearest


@kind("sensor", "bearing")
class Bearing(Physical):
    """Direction of a thing: 0.5 straight ahead, less on the left, more on the right; 0.5 without it.

    It goes round: noise leads from 0 to 1, which are both behind.
    0.5 − atan2(y, x)/2π in the body's frame, of several the nearest's; of an obstacle, a wall or a map its nearest
    point's. Within `dead_zone` of straight ahead it reads 0.5; with a `range`, a thing farther away than that, too.
    """

    of: Annotated[str, THING]
    range: Annotated[float, LENGTH] = 0.0
    dead_zone: Annotated[float, RATIO] = 0.0

    circular = True
    scaled = True
    blank = rest = 0.5
    is_about = staticmethod(lambda kind: True)  # whatever there is

    def row(self, scene: Scene) -> Row:
        """The inherited columns, with an infinite range where none is given."""
        return {**Physical.row(self, scene), "range": self.range or inf}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """0.5 − atan2/2π in the body's frame."""
        out = s.readings[sensor.start]
        if sensor.things == 0 and sensor.boxes == 0:
            for p in range(n):
                out[p] = HALF
            return
        thing = nearest(s, sensor, n)
        x, y, away = thing[X], thing[Y], thing[DISTANCE]
        for p in range(n):
            dx, dy = F(x[p] - s.body[X, p]), F(y[p] - s.body[Y, p])
            cosine, sine = F(s.heading[COSINE, p]), F(s.heading[SINE, p])
            v = bearing(cosine * dx + sine * dy, cosine * dy - sine * dx)
            v = HALF if abs(v - HALF) < sensor.dead_zone else v
            out[p] = v if away[p] <= sensor.range else HALF
