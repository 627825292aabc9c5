"""What a claw can take."""

from collections.abc import Mapping
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.kinds.things.thing import DEFAULT_DISTANCE, DEFAULT_SIZE, MOVES, OUTCOME, STAYS, Outcome, ThingKind
from mindrun.numbers.quantity import COORDINATE, COUNT, LENGTH, Place, Span


@kind("content", "item")
class Item(ThingKind):
    """A disc of diameter `size` that the claw can take, or `count` of them, `away` from the robot or `at` a place.

    When it is `reached` or `delivered` it stays as it is (in the claw, where that holds it), moves elsewhere with the
    next size of its schedule, or vanishes for the rest of the run.
    """

    size: Annotated[Span, LENGTH] = DEFAULT_SIZE
    away: Annotated[Span, LENGTH] = DEFAULT_DISTANCE
    at: Annotated[tuple[Place, ...], COORDINATE] = ()
    count: Annotated[int, COUNT] = 1
    reached: Annotated[Outcome, OUTCOME] = STAYS
    delivered: Annotated[Outcome, OUTCOME] = MOVES

    can_be_held = True
    can_be_delivered = True
    is_round = True

    @property
    def outcomes(self) -> Mapping[str, Outcome]:
        """Both."""
        return {"reached": self.reached, "delivered": self.delivered}
