"""Other robots in the same world."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.kinds.things.thing import DEFAULT_DISTANCE, ThingKind
from mindrun.numbers.quantity import Lengths, Places, Quantity

MOST_ROBOTS = 64  # in one world
COUNT = Quantity("a whole number from 1 to 63", {"": 1.0}, low=1, high=MOST_ROBOTS - 1, whole=True)


@kind("content", "robot")
@dataclass(frozen=True, slots=True, kw_only=True)
class Robot(ThingKind):
    """Other robots with the body and the mind of the first, `count` of them, each with a claw and memories of its own.

    The same master is in charge of them, or the skill that they are `under`. They push each other as balls and boxes
    do. They begin where the first could: anywhere clear in an arena, or `away` from it in a plain scene; or `at`
    places. What a robot is to the first, the first is to it.
    """

    count: Annotated[int, COUNT] = 1
    away: Lengths = DEFAULT_DISTANCE
    at: Places = ()

    is_robot = True
    is_solid = True
    is_round = True
