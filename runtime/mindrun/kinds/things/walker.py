"""A thing that moves by itself."""

from dataclasses import replace
from itertools import pairwise
from math import pi
from typing import Annotated, Literal, get_args

from mindrun.kinds.registry import kind, left_out
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.kinds.things.thing import DEFAULT_DISTANCE, SPEED, Aiming, Alternatives, ThingMistake, outside
from mindrun.numbers.quantity import ANGLE, Place, Places, Reference

TURNING = replace(ANGLE, low=0.0)

Begin = Literal["start", "anywhere"]  # where on its way
START: Begin = "start"
ANYWHERE: Begin = "anywhere"
BEGIN = Reference("beginning", get_args(Begin))


@kind("content", "walker")
class Walker(Aiming):
    """A disc of diameter `size` on the floor that moves at `speed`, in units per second, and touches nothing.

    It wanders: its direction drifts by about `turning` in a second, and where its next step would meet a wall or an
    obstacle it stands for that tick and faces anywhere. Or it goes `along` places, from the last of them to the first
    again, in straight lines through whatever is there; with `or` on one of several ways, which is drawn for each, and
    `from anywhere` on its way instead of its first place. It is reached when it is caught: in the claw's reach.

    One that `seeks` or `flees` the robot, or the nearest thing of a name, goes straight towards it or away from it,
    from middle to middle. Where none is within its `range`, or something is in its way, it wanders.
    """

    speed: Annotated[float, SPEED] = 1.0
    turning: Annotated[float, TURNING] = pi / 2
    along: Places = ()
    from_: Annotated[Begin, BEGIN] = left_out(START)

    varying = ("speed", "turning")
    is_round = True
    walks = True

    @property
    def places(self) -> tuple[Place, ...]:
        """The places of its only way, or where it has none, those at which it begins."""
        return () if self.or_ or self.from_ == ANYWHERE else self.along or self.at

    @property
    def spots(self) -> tuple[Place, ...]:
        return (*(self.along or self.at), *(place for each in self.or_ for place in each))

    @property
    def options(self) -> tuple[Place, ...]:
        return self.spots if self.or_ and not self.along else ()

    @property
    def ways(self) -> Alternatives:  # type: ignore[override]
        return (self.along, *self.or_) if self.along else ()

    @property
    def wanders(self) -> bool:  # type: ignore[override]
        return not self.along

    def mistake(self, scene: SceneKind | None) -> ThingMistake | None:
        if mistake := self.aim_mistake():
            return mistake
        if not self.along:
            hint = "Write the places of its way: along 0 0 to 10 0 from anywhere."
            lost = ThingMistake("missing-argument", "What has no way begins nowhere on it.", hint)
            return lost if self.from_ == ANYWHERE else Aiming.mistake(self, scene)
        if self.at or self.within or self.away != DEFAULT_DISTANCE:
            hint = "Leave at, within and away out: it begins where its way does."
            return ThingMistake("place-and-way", "It says where it goes, and where it stands.", hint)
        if any(len(way) < 2 or any(a == b for a, b in pairwise((*way, way[0]))) for way in self.ways):
            hint = "Write places of which none is the next, nor the last the first: along 0 0 to 10 0 to 10 10."
            return ThingMistake("endless-way", "This way does not go anywhere.", hint)
        if self.from_ == START and self.count > min(map(len, self.ways)):
            hint = f"Each begins at another place of the way: name {self.count} places, or write a smaller count."
            return ThingMistake("place-for-many", "Several things cannot stand at one place.", hint)
        hint = "Write places that are in it with all of the thing; 0 0 is the middle."
        return outside(scene, self.spots, self.largest / 2, hint)
