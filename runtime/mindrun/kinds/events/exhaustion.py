"""The battery is empty."""

from mindrun.kinds.events.event import EventKind, Hindrance, TaskWorld
from mindrun.kinds.registry import kind
from mindrun.kinds.things.thing import WorldFacts


@kind("event", "exhaustion")
class Exhaustion(EventKind):
    """The battery is empty."""

    is_of_battery = True

    def missing(self, task: TaskWorld) -> Hindrance | None:
        """A hindrance where the robot has no battery."""
        if task.has_battery:
            return None
        return Hindrance("Without a battery nothing is exhausted.", "Declare one: sensor battery is battery.")

    def prevented(self, world: WorldFacts) -> Hindrance | None:
        """A hindrance where the battery never loses any charge."""
        return None if world.drains else Hindrance("the battery does not drain", "Give it a drain above 0.")
