"""Kinds of events: what can happen in a tick. `sim/lanes/judge.py` notices them."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.quantity import THING, Quantity, Reference
from mindrun.registry import kind

PATCH = Quantity("a length in world units", {"": 1.0}, low=0.1, high=1e5)


@kind("event", "reach")
@dataclass(frozen=True, slots=True)
class Reach:
    """An item comes into the claw's reach, or the robot's centre into a zone or power: once until it has left again."""

    of: Annotated[str, THING]


@kind("event", "delivery")
@dataclass(frozen=True, slots=True)
class Delivery:
    """The middle of an item that the claw holds comes into a zone: once until it has left all zones again."""

    of: Annotated[str, THING]

    about = frozenset({"item"})


@kind("event", "visit")
@dataclass(frozen=True, slots=True)
class Visit:
    """The robot's centre enters a square patch of the arena, of side `size`, for the first time."""

    of: Annotated[str, Reference("place", ("patch",))]
    size: Annotated[float, PATCH] = 4.0


@kind("event", "collision")
@dataclass(frozen=True, slots=True)
class Collision:
    """The body, or the item it holds, begins to touch an obstacle or a wall."""


@kind("event", "exhaustion")
@dataclass(frozen=True, slots=True)
class Exhaustion:
    """The battery is empty."""


Event = Reach | Delivery | Visit | Collision | Exhaustion
