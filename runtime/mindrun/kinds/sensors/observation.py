"""One number of an environment's observation, and several."""

from collections.abc import Collection, Mapping
from typing import Annotated, Any

from mindrun.kinds.environment import Slot
from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Flaw, Physical, Shape
from mindrun.numbers.quantity import INDEX, Indices, PartName, Range


@kind("sensor", "observation")
class Observation(Physical):
    """One number of a Gymnasium environment's observation: 0 at the low end of `range`, 1 at the high end.

    The first number is 0; of an array, one index for each of its axes; of a `Dict`, the name of the part goes before
    them, of a `Tuple` its number. What is beyond the range reads as its end, and how often is told.
    """

    observation: Indices
    range: Range
    part: PartName = ""

    scaled = True

    @property
    def slot(self) -> Slot:  # type: ignore[override]
        return Slot(self.part, self.observation, self.range)

    def flaw(self, widths: Mapping[str, int], directions: Collection[str]) -> Flaw | None:
        if self.slot.has_two_ends:
            return None
        hint = "Write the least and the greatest number that it will be: range -0.5 to 2."
        return Flaw("open-range", "range", "An observation has a range with two ends.", hint)

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """Do nothing: whoever stepped the environment has written the reading."""


@kind("sensor", "observations")
class Observations(Physical):
    """Several numbers of a Gymnasium environment's observation, as one wide reading: all from the first up to `to`.

    Those of an array with several axes are counted through, its last axis fastest. The first number is 0; of a `Dict`,
    the name of the part goes before it, of a `Tuple` its number. All have one `range`.
    """

    observations: Indices
    to: Annotated[int, INDEX]
    range: Range
    part: PartName = ""

    scaled = True

    @property
    def slot(self) -> Slot:  # type: ignore[override]
        return Slot(self.part, self.observations, self.range, last=self.to)

    @property
    def shape(self) -> Shape:
        return (max(1, self.to - self.observations[-1] + 1),)

    def flaw(self, widths: Mapping[str, int], directions: Collection[str]) -> Flaw | None:
        if self.to < self.observations[-1]:
            hint = "Write the first number, then the last: observations 0 to 9."
            return Flaw("range-backwards", "to", "This range ends below its beginning.", hint)
        return Observation.flaw(self, widths, directions)  # type: ignore[arg-type]  # which asks for no more than the slot

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """Do nothing: whoever stepped the environment has written the readings."""
