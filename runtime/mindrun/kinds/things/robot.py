"""Other robots in the same world."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.kinds.registry import kind, left_out
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.kinds.things.thing import DEFAULT_DISTANCE, Alternatives, ThingKind, ThingMistake
from mindrun.numbers.quantity import Lengths, Places, Quantity

MOST_ROBOTS = 64  # in one world
PAID = Quantity("0 or 1", {"": 1.0}, low=0, high=1, whole=True)
COUNT = Quantity("a whole number", {"": 1.0}, low=0, high=MOST_ROBOTS - 1, whole=True)


@kind("content", "robot")
@dataclass(frozen=True, slots=True, kw_only=True)
class Robot(ThingKind):
    """Other robots with the body of the first, `count` of them, each with a claw and memories of its own.

    The same master is in charge of them, or the skill that they are `under`. The first robot is one more of the first
    name under its master; with `count 0` it is alone in that. They push each other as balls and boxes do. They begin
    where the first could: anywhere clear in an arena, `away` from it, or `at` places. With `paid 0` they are a part of
    the world: nothing that happens to them is rewarded or counted, or ends a run.
    """

    count: Annotated[int, COUNT] = 1
    away: Lengths = DEFAULT_DISTANCE
    at: Places = ()
    or_: Alternatives = left_out(())
    paid: Annotated[int, PAID] = left_out(1)

    is_robot = True
    is_solid = True
    is_round = True

    def mistake(self, scene: SceneKind | None) -> ThingMistake | None:
        """The error that keeps robots out of a scene; whether one at a place fits, only who knows its body can say."""
        return ThingKind.mistake(self, None if self.spots else scene)
