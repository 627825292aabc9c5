"""Whether the robot is inside of a thing."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.quantity import THING
from mindrun.registry import kind
from mindrun.sensors.sensor import Physical, World


@kind("sensor", "inside")
@dataclass(frozen=True, slots=True)
class Inside(Physical):
    """1 while the robot's centre is inside the thing, else 0."""

    of: Annotated[str, THING]

    about = frozenset({"zone", "power"})

    @property
    def thing(self) -> str:
        """Where it is."""
        return self.of

    def constant(self, world: World) -> float | None:
        """0 without the thing."""
        return None if self.of in world.things else 0.0
