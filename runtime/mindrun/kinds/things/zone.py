"""Where items are delivered."""

from collections.abc import Mapping
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.kinds.things.thing import DEFAULT_DISTANCE, DEFAULT_SIZE, OUTCOME, STAYS, Outcome, ThingKind
from mindrun.numbers.quantity import COORDINATE, COUNT, LENGTH, Place, Span


@kind("content", "zone")
class Zone(ThingKind):
    """A square of side `size` on the floor, or `count` of them; items are delivered into it.

    When it is `reached` it stays where it is, moves elsewhere with the next size of its schedule, or vanishes for the
    rest of the run.
    """

    size: Annotated[Span, LENGTH] = DEFAULT_SIZE
    away: Annotated[Span, LENGTH] = DEFAULT_DISTANCE
    at: Annotated[tuple[Place, ...], COORDINATE] = ()
    count: Annotated[int, COUNT] = 1
    reached: Annotated[Outcome, OUTCOME] = STAYS

    is_area = True
    takes_items = True

    @property
    def outcomes(self) -> Mapping[str, Outcome]:
        """When the robot reaches it."""
        return {"reached": self.reached}
