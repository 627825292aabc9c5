"""The distance to whatever is solid, in some directions."""

from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Physical
from mindrun.kinds.things.thing import WorldFacts
from mindrun.numbers.quantity import ANGLE, POSITIVE, RATIO

if TYPE_CHECKING:  # a lane is given these when it is compiled
    from mindrun.numbers.arithmetic import ONE, ZERO, F, clamp


@kind("sensor", "range_finder")
class RangeFinder(Physical):
    """Distance from the body's rim to what is solid, one reading per angle: 0 touching, 1 clear within `range`.

    Angles turn counterclockwise from straight ahead. A reading below `dead_zone` is 0.
    """

    at: Annotated[tuple[float, ...], ANGLE] = (0.0,)
    range: Annotated[float, POSITIVE] = 12.0
    dead_zone: Annotated[float, RATIO] = 0.005

    looks = True
    scaled = True
    near = 0
    unit = "m"
    blank = 1.0

    def constant(self, world: WorldFacts) -> float | None:
        """1 in a world where nothing is solid, else None."""
        return None if world.is_solid else 1.0

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """The distance along each ray, from the body's rim."""
        scale = ONE / F(sensor.range)
        for ray in range(sensor.width):
            out, far = s.readings[sensor.start + ray], s.sight[4 + sensor.ray + ray]
            rim = t.rims[sensor.ray + ray]
            for p in range(n):
                v = clamp((far[p] - rim) * scale)
                out[p] = ZERO if v < sensor.dead_zone else v
