"""What every loose thing says of itself: solid, and pushed about."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated

from mindrun.bodies.body import DAMPING, DENSITY
from mindrun.quantity import COORDINATE, COUNT, LENGTH, RATIO, Place, Quantity, Span
from mindrun.things.thing import DEFAULT_DISTANCE, DEFAULT_SIZE, MOVES, OUTCOME, STAYS, Outcome, ThingKind

SIZE = Quantity("a length in world units", {"": 1.0}, low=0.01, high=1000.0)
DEFAULT_FRICTION = 0.5


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

    @property
    def outcomes(self) -> Mapping[str, Outcome]:
        """Both."""
        return {"reached": self.reached, "delivered": self.delivered}
