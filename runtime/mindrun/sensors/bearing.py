"""In which direction a thing is."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.quantity import LENGTH, RATIO, THING
from mindrun.registry import kind
from mindrun.sensors.sensor import Physical, World


@kind("sensor", "bearing")
@dataclass(frozen=True, slots=True)
class Bearing(Physical):
    """Direction of a thing: 0.5 straight ahead, less on the left, more on the right, the seam behind; 0.5 without it.

    0.5 − atan2(y, x)/2π in the body's frame. Within `dead_zone` of straight ahead it reads 0.5; with a `range`,
    a thing farther away than that reads 0.5 too.
    """

    of: Annotated[str, THING]
    range: Annotated[float, LENGTH] = 0.0
    dead_zone: Annotated[float, RATIO] = 0.0

    circular = True
    scaled = True
    blank = rest = 0.5

    @property
    def thing(self) -> str:
        """What it points to."""
        return self.of

    def constant(self, world: World) -> float | None:
        """0.5 without the thing, and where all directions are in the dead zone."""
        return 0.5 if self.of not in world.things or self.dead_zone > 0.5 else None
