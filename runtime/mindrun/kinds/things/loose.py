"""What every loose thing says of itself: solid, and pushed about."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.kinds.bodies.body import DAMPING, DENSITY
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.kinds.things.thing import (
    DEFAULT_DISTANCE,
    DEFAULT_SIZE,
    MOVES,
    OUTCOME,
    STAYS,
    Mistake,
    Outcome,
    ThingKind,
)
from mindrun.numbers.quantity import COORDINATE, COUNT, LENGTH, RATIO, Place, Quantity, Span

SIZE = Quantity("a length in world units", {"": 1.0}, low=0.01, high=1000.0)
DEFAULT_FRICTION = 0.5
HALF_DIAGONAL = 0.7071  # of a square with side 1, and a little less


@dataclass(frozen=True, slots=True)
class Loose(ThingKind):
    """What is solid and not fixed: the robot pushes it, and so does what it pushes.

    Every tick of length dt its velocity and its spin are divided by 1 + dt·damping. Where two things touch, the product
    of their `friction` counts; the robot's is 0.2, that of walls and obstacles 1.
    """

    size: Annotated[Span, SIZE] = DEFAULT_SIZE
    density: Annotated[float, DENSITY] = 0.5
    friction: Annotated[float, RATIO] = DEFAULT_FRICTION
    damping: Annotated[float, DAMPING] = 5.0
    away: Annotated[Span, LENGTH] = DEFAULT_DISTANCE
    at: Annotated[tuple[Place, ...], COORDINATE] = ()
    count: Annotated[int, COUNT] = 1
    reached: Annotated[Outcome, OUTCOME] = STAYS
    delivered: Annotated[Outcome, OUTCOME] = MOVES

    varying = ("density", "friction", "damping")
    is_solid = True
    is_loose = True
    can_be_delivered = True

    def mistake(self, scene: SceneKind | None) -> Mistake | None:
        """It is not placed so near that the robot would be in it."""
        extent = self.largest * (0.5 if self.is_round else HALF_DIAGONAL)
        if self.away != DEFAULT_DISTANCE and max(self.away.first, self.away.last) < extent:
            hint = f"Write away {self.largest:g} to {self.largest + 20:g}: it is {self.largest:g} large."
            return Mistake("on-the-robot", "So near, it would stand on the robot.", hint)
        return ThingKind.mistake(self, scene)
