"""How far the nearest obstacle is, in some directions."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.quantity import ANGLE, POSITIVE, RATIO
from mindrun.registry import kind
from mindrun.sensors.sensor import Physical, World


@kind("sensor", "range_finder")
@dataclass(frozen=True, slots=True)
class RangeFinder(Physical):
    """Distance from the body's rim to the nearest obstacle, one reading per angle: 0 touching, 1 clear within `range`.

    Angles turn counterclockwise from straight ahead. A reading below `dead_zone` is 0.
    """

    at: Annotated[tuple[float, ...], ANGLE] = (0.0,)
    range: Annotated[float, POSITIVE] = 12.0
    dead_zone: Annotated[float, RATIO] = 0.005

    scaled = True
    near = 0
    blank = 1.0

    @property
    def width(self) -> int:
        """One reading per angle."""
        return len(self.at)

    @property
    def rays(self) -> tuple[float, ...]:
        """Its angles."""
        return self.at

    @property
    def reach(self) -> float:
        """Its range."""
        return self.range

    def constant(self, world: World) -> float | None:
        """1 where nothing is solid."""
        return None if world.is_solid else 1.0
