"""Where the battery charges."""

from collections.abc import Mapping
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.kinds.things.thing import DEFAULT_DISTANCE, DEFAULT_SIZE, OUTCOME, STAYS, Outcome, ThingKind
from mindrun.numbers.quantity import COORDINATE, COUNT, LENGTH, Place, Span


@kind("content", "power")
class Power(ThingKind):
    """A square of side `size` on the floor, or `count` of them, in which the battery charges.

    `reached` is as for a zone.
    """

    size: Annotated[Span, LENGTH] = DEFAULT_SIZE
    away: Annotated[Span, LENGTH] = DEFAULT_DISTANCE
    at: Annotated[tuple[Place, ...], COORDINATE] = ()
    count: Annotated[int, COUNT] = 1
    reached: Annotated[Outcome, OUTCOME] = STAYS

    is_area = True
    charges = True

    @property
    def outcomes(self) -> Mapping[str, Outcome]:
        """When the robot reaches it."""
        return {"reached": self.reached}
