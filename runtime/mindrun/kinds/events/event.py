"""Events, and what the rest of the program asks of each: it knows none by name."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from math import ceil
from typing import Annotated, NamedTuple, Protocol

from mindrun.kinds.registry import base, kind, left_out, phrase
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.kinds.things.thing import AboutThing, ThingKind, WorldFacts
from mindrun.numbers.quantity import Quantity, Reference, ThingName

Row = Mapping[str, float]  # columns of the lanes' table of events
WITHIN_TICKS = Quantity("a number of ticks", {"ticks": 1.0}, low=1, high=10_000_000, whole=True)


class Hindrance(NamedTuple):
    """The reason why an event cannot happen, as a sentence, and a hint what to do about it."""

    reason: str
    hint: str


class TaskWorld(Protocol):
    """The facts about a task's world that decide which events can happen."""

    @property
    def scene(self) -> SceneKind | None: ...  # None where it is not known
    @property
    def kinds(self) -> Collection[ThingKind]: ...  # of all things that are known
    @property
    def has_battery(self) -> bool: ...  # whether a sensor reads a battery
    @property
    def can_succeed(self) -> bool: ...  # whether a line says when a run is a success


@dataclass(frozen=True, slots=True)
class Within:
    """A time that is open from the tick of another event on, and for so many `ticks` after it."""

    ticks: Annotated[int, WITHIN_TICKS]
    of: "EventKind"

    def __str__(self) -> str:
        return f"within {self.ticks} ticks of {phrase(self.of)}"


@base("event")
@dataclass(frozen=True, slots=True, kw_only=True)
class EventKind(AboutThing):
    """An event that can happen in any world; a kind says what is different about it.

    With `within 5 s of` and another event behind it, it happens only soon after that, or in the same tick.
    """

    within: Within | None = left_out(None, is_argument=False)

    outcome = ""  # the argument by which a thing says what becomes of it when the event happens
    needs_walls = False  # whether it can be computed in an arena alone
    is_outside = False  # whether an environment says when it happens
    is_of_success = False  # whether an end of the task makes it happen
    is_mishap = False  # whether it is none of what a robot is to bring about
    is_of_battery = False  # whether it depends on the battery, of which it names no sensor

    @property
    def single(self) -> tuple["EventKind", ...]:
        """The events by themselves of which it is made: itself, or without its time, and the other."""
        return (replace(self, within=None), self.within.of) if self.within else (self,)

    @property
    def more_words(self) -> tuple[str, ...]:
        """The words behind its arguments."""
        return (str(self.within),) if self.within else ()

    def missing(self, task: TaskWorld) -> Hindrance | None:
        """The hindrance where its task lacks something without which it can never happen, else None."""
        return None

    def hindrance(self, world: WorldFacts) -> Hindrance | None:
        """The first hindrance of the events of which it is made, else None."""
        return next(filter(None, (each.prevented(world) for each in self.single)), None)

    def prevented(self, world: WorldFacts) -> Hindrance | None:
        """The hindrance where it can never happen although its task lacks nothing, else None."""
        return None

    @staticmethod
    def remembered(things: int, others: int) -> int:
        """How many of its things, or of the others, the lanes remember to have been where they are."""
        return 0

    def is_common(self, kinds: Mapping[str, ThingKind]) -> bool:
        """True if it happens to a world, and so to each of its robots; `kinds` are those of its things by name."""
        return self.is_of_success

    def row(self, scene: SceneKind) -> Row:
        """The kind's columns of the lanes' table but for its thing: `columns` and `rows` of patches, `patch` a side."""
        return {}


@kind("event", "collision")
class Collision(EventKind):
    """The body, or the item it holds, begins to touch an obstacle or a wall; to push a box or ball is no collision.

    With `with` it begins to touch a robot of that name, or the item that this holds: once for each of them.
    """

    with_: ThingName = left_out("")

    is_mishap = True
    is_about = staticmethod(lambda kind: kind.is_robot)

    def prevented(self, world: WorldFacts) -> Hindrance | None:
        if world.has_fixed or self.with_:
            return None
        hint = "Write in arena size 100, or add contains rock is obstacle count 10."
        return Hindrance("there is nothing to collide with", hint)


@kind("event", "reach")
class Reach(EventKind):
    """An item, box, ball, walker or robot comes into the claw's reach, or the robot's centre into a zone or power.

    Once until it has left again. With `by` another thing does so in the robot's place: its middle comes into the zone
    or power, or its rim no farther from that of anything else than a claw reaches; nothing becomes of what it reaches.
    """

    of: ThingName
    by: ThingName = left_out("")

    def is_common(self, kinds: Mapping[str, ThingKind]) -> bool:
        return bool(self.by) and not (kinds[self.of].is_robot or kinds[self.by].is_robot)

    @property
    def outcome(self) -> str:  # type: ignore[override]
        return "" if self.by else "reached"

    @classmethod
    def accepts(cls, argument: str, kind: type[ThingKind]) -> bool:
        return cls.is_about(kind) and not (argument == "by" and kind.is_area)

    remembered = staticmethod(lambda things, others: others)


@kind("event", "leave")
class Leave(EventKind):
    """The robot's centre, or with `by` the middle of another thing, is in no zone or power of a name any more.

    It was in one as the tick before ended, or the run began. A thing that vanishes leaves, too, and a zone that moves
    is left.
    """

    of: ThingName
    by: ThingName = ""

    def is_common(self, kinds: Mapping[str, ThingKind]) -> bool:
        return bool(self.by) and not (kinds[self.of].is_robot or kinds[self.by].is_robot)

    is_about = staticmethod(lambda kind: kind.is_area)  # squares on the floor

    @classmethod
    def accepts(cls, argument: str, kind: type[ThingKind]) -> bool:
        return not (kind.is_area or kind.is_obstacle) if argument == "by" else cls.is_about(kind)

    remembered = staticmethod(lambda things, others: max(1, others))  # the robot alone where there is no other


PATCH = Quantity("a length in world units", {"": 1.0}, low=0.1, high=1e5)


@kind("event", "visit")
class Visit(EventKind):
    """The robot's centre enters a square patch of the arena, of side `size`, for the first time."""

    of: Annotated[str, Reference("place", ("patch",))]
    size: Annotated[float, PATCH] = 4.0

    needs_walls = True

    def missing(self, task: TaskWorld) -> Hindrance | None:
        if task.scene is None or task.scene.is_bounded:
            return None
        return Hindrance("A plain scene has no patches to visit.", "Patches are of an arena: write in arena size 100.")

    def row(self, scene: SceneKind) -> Row:
        """The number of patches along each axis, rounded up, and their side in world units."""
        width, depth = scene.sides
        return {"columns": ceil(width / self.size), "rows": ceil(depth / self.size), "patch": self.size}


@kind("event", "delivery")
class Delivery(EventKind):
    """The middle of an item that the claw holds, or of a box or ball, comes into a zone.

    Once until it has left all zones again. A box or ball that stands in one when the run begins counts, too.
    With `to` it is about zones of that name alone, whichever others it comes through.
    """

    of: ThingName
    to: ThingName = ""

    outcome = "delivered"

    is_about = staticmethod(lambda kind: kind.can_be_delivered)
    remembered = staticmethod(lambda things, others: things if others else 0)  # where it is about certain zones

    def is_common(self, kinds: Mapping[str, ThingKind]) -> bool:
        return kinds[self.of].is_loose

    @classmethod
    def accepts(cls, argument: str, kind: type[ThingKind]) -> bool:
        return kind.takes_items if argument == "to" else cls.is_about(kind)

    def missing(self, task: TaskWorld) -> Hindrance | None:
        if any(kind.takes_items for kind in task.kinds):
            return None
        return Hindrance("The task has no zone to deliver to.", "Add contains drop_zone is zone size 5.")

    def prevented(self, world: WorldFacts) -> Hindrance | None:
        if self.of not in world.loose and not world.can_hold:
            return Hindrance("no skill that a master reaches drives a gripper", "Let a skill drive one.")
        if self.of in world.fleeting:
            reason = f"{self.of} is gone when it is reached, before the claw can take it"
            return Hindrance(reason, "Write reached stays.")
        return None


@kind("event", "exhaustion")
class Exhaustion(EventKind):
    """The battery is empty."""

    is_of_battery = True

    def missing(self, task: TaskWorld) -> Hindrance | None:
        if task.has_battery:
            return None
        return Hindrance("Without a battery nothing is exhausted.", "Declare one: sensor battery is battery.")

    def prevented(self, world: WorldFacts) -> Hindrance | None:
        return None if world.drains else Hindrance("the battery does not drain", "Give it a drain above 0.")


@kind("event", "success")
class Success(EventKind):
    """The run ends as a success: what a line of the task with `succeeds` says has come."""

    is_of_success = True

    def missing(self, task: TaskWorld) -> Hindrance | None:
        if task.can_succeed:
            return None
        return Hindrance("The task does not say what a success is.", "Add a line: succeeds on 5 delivery of red.")


@kind("event", "its end")
class ItsEnd(EventKind):
    """The Gymnasium environment has come to an end of its own (terminated); no further step can be made in it.

    One that breaks a run off (truncated) does not end in this sense: its environment has ended the run.
    """

    is_outside = True
