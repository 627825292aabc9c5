"""Sensors that say 1 or 0 of a thing: the claw can take it or holds it, the robot or a point of it is over it."""

from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Begin, Bounds, Physical
from mindrun.kinds.things.thing import WorldFacts
from mindrun.numbers.quantity import Quantity, ThingName

if TYPE_CHECKING:  # a lane is given these when it is compiled
    from mindrun.numbers.arithmetic import *


@kind("sensor", "contact")
class Contact(Physical):
    """1 while the thing, or one of its name, is in the claw's reach, else 0."""

    of: ThingName

    near = 1
    # What a claw can take, push or catch.
    is_about = staticmethod(lambda kind: kind.can_be_held or kind.is_loose or kind.walks or kind.is_robot)

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


@kind("sensor", "inside")
class Inside(Physical):
    """1 while the robot's centre is inside the thing, or one of its name, else 0."""

    of: ThingName

    is_about = staticmethod(lambda kind: kind.is_area)  # what lies on the floor

    def first(self, begin: Begin) -> Bounds | None:
        there = {None if self.noise else begin.is_within(thing) for thing in self.things}
        is_in = True if True in there else None if None in there else False
        return None if is_in is None else (float(is_in), float(is_in))

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        out = s.readings[sensor.start]
        for p in range(n):
            out[p] = ZERO
        for i in range(sensor.thing, sensor.thing + sensor.things):
            for p in range(n):
                there = inside(s.things, i, s.body[X, p], s.body[Y, p], p)
                out[p] = ONE if there else out[p]


OFFSET = Quantity("a length in world units", {"": 1.0}, low=-1000.0, high=1000.0)


@kind("sensor", "floor")
class Floor(Physical):
    """Light sensors that look down, one reading each: 1 where it is over a thing or one of its name, else 0.

    They stand on a bar across the robot, `ahead` of its middle; `at` says how far to the left of the middle each is.
    """

    of: ThingName
    at: Annotated[tuple[float, ...], OFFSET] = (0.0,)
    ahead: Annotated[float, OFFSET] = 0.0

    remedy = "Let a task contain what it is about"
    is_about = staticmethod(lambda kind: not kind.is_solid)  # what can lie on the floor

    @property
    def spots(self) -> tuple[tuple[float, float], ...]:  # type: ignore[override]
        return tuple((self.ahead, left) for left in self.at)

    @property
    def numbers(self) -> tuple[float, ...]:  # type: ignore[override]
        """The distance of the bar ahead of the middle, then the distance of each point to the left."""
        return self.ahead, *self.at

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        ahead = t.numbers[sensor.number]
        for k in range(sensor.width):
            out, left = s.readings[sensor.start + k], t.numbers[sensor.number + 1 + k]
            for p in range(n):
                cosine, sine = s.heading[COSINE, p], s.heading[SINE, p]
                x = s.body[X, p] + (cosine * ahead - sine * left)
                y = s.body[Y, p] + (sine * ahead + cosine * left)
                there = False
                for i in range(sensor.thing, sensor.thing + sensor.things):
                    there = there or (
                        in_disc(s.things, i, x, y, p) if t.things[i].is_round else inside(s.things, i, x, y, p)
                    )
                out[p] = ONE if there else ZERO


def in_disc(things: Any, i: Any, x: Any, y: Any, p: Any) -> Any:
    """True if a point is inside the disc of thing i, in lane p."""
    its_x, its_y = place_of(things, i, p)
    dx, dy, half = its_x - x, its_y - y, size_of(things, i, p) / 2
    return dx * dx + dy * dy <= half * half
