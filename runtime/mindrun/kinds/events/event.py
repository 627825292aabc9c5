"""The base class of events: the rest of the program asks a kind for these, and knows none by name."""

from collections.abc import Collection, Mapping
from typing import NamedTuple, Protocol

from mindrun.kinds.registry import base
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.kinds.things.thing import AboutThing, ThingKind, WorldFacts

Row = Mapping[str, float]  # columns of the lanes' table of events


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


@base("event")
class EventKind(AboutThing):
    """An event that can happen in any world; a kind says what is different about it."""

    __slots__ = ()

    outcome = ""  # the argument by which a thing says what becomes of it when the event happens
    needs_walls = False  # whether it can be computed in an arena alone
    is_outside = False  # whether an environment says when it happens
    is_of_success = False  # whether an end of the task makes it happen
    is_of_battery = False  # whether it depends on the battery, of which it names no sensor

    def missing(self, task: TaskWorld) -> Hindrance | None:
        """The hindrance where its task lacks something without which it can never happen, else None."""
        return None

    def prevented(self, world: WorldFacts) -> Hindrance | None:
        """The hindrance where it can never happen although its task lacks nothing, else None."""
        return None

    def row(self, scene: SceneKind) -> Row:
        """Its columns of the lanes' table beside its thing: `columns` and `rows` of patches, and `patch`, a side."""
        return {}
