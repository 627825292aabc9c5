"""The robot meets something."""

from mindrun.kinds.events.event import EventKind, Hindrance
from mindrun.kinds.registry import kind
from mindrun.kinds.things.thing import WorldFacts


@kind("event", "collision")
class Collision(EventKind):
    """The body, or the item it holds, begins to touch an obstacle or a wall; to push a box or ball is no collision."""

    def prevented(self, world: WorldFacts) -> Hindrance | None:
        """A hindrance where nothing solid is fixed in the world."""
        if world.has_fixed:
            return None
        hint = "Write in arena size 100, or add contains rock is obstacle count 10."
        return Hindrance("there is nothing to collide with", hint)
