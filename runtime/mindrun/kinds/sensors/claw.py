"""What the claw can take, and what it holds."""

from typing import TYPE_CHECKING, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Begin, Bounds, Physical
from mindrun.kinds.things.thing import WorldFacts
from mindrun.numbers.quantity import ThingName

if TYPE_CHECKING:  # a lane is given these when it is compiled
    from mindrun.numbers.arithmetic import *


@kind("sensor", "contact")
class Contact(Physical):
    """1 while the thing, or one of its name, is in the claw's reach, else 0."""

    of: ThingName

    near = 1
    # What a claw can take, push or catch.
    is_about = staticmethod(lambda kind: kind.can_be_held or kind.is_loose or kind.walks)

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        world, out = t.world[0], s.readings[sensor.start]
        for p in range(n):
            out[p] = ZERO
        for i in range(sensor.thing, sensor.thing + sensor.things):
            for p in range(n):
                there = in_claw(s.body, s.heading, s.things, world.front, world.claw, i, p)
                out[p] = ONE if there else out[p]


@kind("sensor", "held")
class Held(Physical):
    """1 while the claw holds the thing, or one of its name, else 0."""

    of: ThingName

    near = 1
    remedy = "Let a skill that acts drive a gripper"
    is_about = staticmethod(lambda kind: kind.can_be_held)  # what a claw can take

    def constant(self, world: WorldFacts) -> float | None:
        return Physical.constant(self, world) if world.can_hold else 0.0

    def first(self, begin: Begin) -> Bounds | None:
        return None if self.noise else (0.0, 0.0)

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        for p in range(n):
            k = s.held[p] - sensor.thing
            s.readings[sensor.start, p] = ONE if k >= 0 and k < sensor.things else ZERO
