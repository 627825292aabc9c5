"""Where the battery charges."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated

from mindrun.quantity import COORDINATE, LENGTH, Place, Span
from mindrun.registry import kind
from mindrun.things.thing import DEFAULT_DISTANCE, DEFAULT_SIZE, OUTCOME, STAYS, Outcome, ThingKind


@kind("content", "power")
@dataclass(frozen=True, slots=True)
class Power(ThingKind):
    """A square of side `size` on the floor in which the battery charges. `reached` is as for a zone."""

    size: Annotated[Span, LENGTH] = DEFAULT_SIZE
    away: Annotated[Span, LENGTH] = DEFAULT_DISTANCE
    at: Annotated[Place | None, COORDINATE] = None
    reached: Annotated[Outcome, OUTCOME] = STAYS

    is_area = True
    charges = True

    @property
    def outcomes(self) -> Mapping[str, Outcome]:
        """When the robot reaches it."""
        return {"reached": self.reached}
