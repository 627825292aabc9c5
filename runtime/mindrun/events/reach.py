"""The robot comes to a thing."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.events.event import EventKind
from mindrun.quantity import THING
from mindrun.registry import kind


@kind("event", "reach")
@dataclass(frozen=True, slots=True)
class Reach(EventKind):
    """An item, box, ball or walker comes into the claw's reach, or the robot's centre into a zone or power.

    Once until it has left again.
    """

    of: Annotated[str, THING]

    outcome = "reached"
