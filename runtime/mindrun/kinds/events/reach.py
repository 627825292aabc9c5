"""The robot comes to a thing."""

from typing import Annotated

from mindrun.kinds.events.event import EventKind
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import THING


@kind("event", "reach")
class Reach(EventKind):
    """An item, box, ball or walker comes into the claw's reach, or the robot's centre into a zone or power.

    Once until it has left again.
    """

    of: Annotated[str, THING]

    outcome = "reached"
