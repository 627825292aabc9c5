"""An item, or what is pushed, comes where it belongs."""

from typing import Annotated

from mindrun.kinds.events.event import EventKind, Hindrance, TaskWorld
from mindrun.kinds.registry import kind
from mindrun.kinds.things.thing import ThingKind, WorldFacts
from mindrun.numbers.quantity import THING


@kind("event", "delivery")
class Delivery(EventKind):
    """The middle of an item that the claw holds, or of a box or ball, comes into a zone.

    Once until it has left all zones again. A box or ball that stands in one when the run begins counts, too.
    With `to` it is about zones of that name alone, whichever others it comes through.
    """

    of: Annotated[str, THING]
    to: Annotated[str, THING] = ""

    outcome = "delivered"

    @staticmethod
    def is_about(kind: type[ThingKind]) -> bool:
        """True for things that a claw can take or that can be pushed."""
        return kind.can_be_delivered

    @classmethod
    def accepts(cls, argument: str, kind: type[ThingKind]) -> bool:
        """True for a zone, where `argument` is `to`; else for things that can be delivered."""
        return kind.takes_items if argument == "to" else cls.is_about(kind)

    def missing(self, task: TaskWorld) -> Hindrance | None:
        """A hindrance where the task has no zone to deliver to."""
        if any(kind.takes_items for kind in task.kinds):
            return None
        return Hindrance("The task has no zone to deliver to.", "Add contains drop_zone is zone size 5.")

    def prevented(self, world: WorldFacts) -> Hindrance | None:
        """A hindrance where nothing closes the claw, or the item vanishes before it can be taken."""
        if self.of not in world.loose and not world.can_hold:
            return Hindrance("no skill that a master reaches drives a gripper", "Let a skill drive one.")
        if self.of in world.fleeting:
            reason = f"{self.of} is gone when it is reached, before the claw can take it"
            return Hindrance(reason, "Write reached stays.")
        return None
