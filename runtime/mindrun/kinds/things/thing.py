"""What the rest of the program asks of a thing, of which it knows no kind by name; and the kinds that are short."""

from collections.abc import Iterable, Mapping, Set
from dataclasses import dataclass, field, replace
from math import hypot, inf
from types import MappingProxyType
from typing import Annotated, Literal, NamedTuple, Protocol, get_args

from mindrun.kinds.registry import arguments, base, kind, left_out
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.numbers.quantity import (
    COORDINATE,
    DISTANCE,
    FARTHEST_UNITS,
    POSITIVE,
    THING,
    UNSAID,
    Count,
    Lengths,
    Place,
    Places,
    Reference,
    Region,
    Span,
    ThingName,
)

OR = " or "  # between the names of the things that a sensor is about alike
ROBOT = "robot"  # the name by which a thing means the robot
WITHIN = "within"  # the argument of a thing that names the zone in which it is placed
DEFAULT_SIZE = Span(1.0, 1.0)
DEFAULT_DISTANCE = UNSAID  # as far away as its scene says

Outcome = Literal["stays", "moves", "vanishes"]
OUTCOMES: tuple[Outcome, ...] = get_args(Outcome)
OUTCOME = Reference("outcome", OUTCOMES)
Becomes = Annotated[Outcome, OUTCOME]  # what becomes of a thing
STAYS: Outcome = "stays"
MOVES: Outcome = "moves"
VANISHES: Outcome = "vanishes"

MAX_OBSTACLES, MAX_THINGS = 2500, 100  # in one world, which looks at all of its things in every tick

SPEED = replace(POSITIVE, name="a speed in world units per second", high=1e4)
Row = Mapping[str, float]  # columns of the lanes' table of obstacles
Alternatives = Annotated[tuple[tuple[Place, ...], ...], COORDINATE]  # each a place, or the places of a way


class Rectangle(NamedTuple):
    """A solid rectangle along the axes: its middle, and half of its sides along x and y."""

    x: float
    y: float
    half_x: float
    half_y: float

    def holds(self, place: Place) -> bool:
        """True if a place is inside it, not on its rim."""
        x, y = place
        return abs(x - self.x) < self.half_x and abs(y - self.y) < self.half_y


class ThingMistake(NamedTuple):
    """An error that keeps a thing out of a scene: its code, a message, and what to do."""

    code: str
    message: str
    hint: str


def outside(scene: SceneKind | None, places: Iterable[Place], extent: float, hint: str) -> ThingMistake | None:
    """The error where something of half size `extent` would not be inside a scene at each of these places."""
    if scene is None or all(scene.has_room(place, extent) for place in places):
        return None
    return ThingMistake("outside-arena", "That is not inside the arena.", hint)


class WorldFacts(Protocol):
    """The facts that are known about the worlds of a mind's tasks before anything runs in them."""

    @property
    def things(self) -> Set[str]: ...  # that a sensor can be about
    @property
    def loose(self) -> Set[str]: ...  # things that can be pushed
    @property
    def fleeting(self) -> Set[str]: ...  # items that are gone as soon as they are reached
    @property
    def is_solid(self) -> bool: ...  # whether anything stands in the way, fixed or loose
    @property
    def has_fixed(self) -> bool: ...  # whether anything does that does not give way
    @property
    def can_hold(self) -> bool: ...  # whether a claw may ever close
    @property
    def charges(self) -> bool: ...  # whether a battery can charge
    @property
    def drains(self) -> bool: ...  # whether the battery can become empty
    @property
    def tick(self) -> float: ...  # the length of a tick in seconds
    def is_constant(self, reading: str) -> bool: ...  # whether a sensor or memory always reads the same


@base("content")
class ThingKind:
    """A thing with a place, which touches nothing; a kind says what is different about it.

    Every kind has the arguments `size`, and `away`, the distance from the robot at which it is placed, or `at`, where,
    or one of several places with `or`, or anywhere `within` a zone or a rectangle.
    """

    __slots__ = ()

    size = DEFAULT_SIZE
    away = DEFAULT_DISTANCE
    at: tuple[Place, ...] = ()
    or_: Alternatives = ()
    within: Region = ""
    count = 1

    varying: tuple[str, ...] = ()  # the arguments that can differ from run to run
    is_obstacle = False  # whether it is squares that stand in the way: no sensor, event or measure is about these
    is_solid = False  # whether it stands in the way, although nobody holds it
    is_loose = False  # whether it gives way when it is pushed
    is_robot = False  # whether it is another robot in the same world, with a mind
    paid = 1  # 0 where it is a robot to which nothing happens that counts
    walks = False  # whether it moves by itself
    wanders = False  # whether it goes another way in each run
    ways: Alternatives = ()  # of which one is drawn for each of it
    speed = 0.0  # at which it does, in units per second
    can_be_held = False  # whether a claw can take it
    can_be_delivered = False  # whether it counts as delivered when it comes into a zone
    is_steep = False  # whether it is a slope
    is_area = False  # whether it lies on the floor, so that a robot or an item can be inside
    takes_items = False  # whether items are delivered into it
    charges = False  # whether the battery charges in it
    is_round = False  # its outline: a disc, not a square
    unplaceable = "Leave its place and its count out: the map says both."  # what to do where a map cannot place it
    least_distance = 10.0  # from the robot, in world units, where walls keep it near
    drawing: tuple[str, ...] = ()  # the lines of the text that it is drawn in
    letters: Mapping[str, Places] = MappingProxyType({})  # the places of things that it draws, by their letters
    walls: tuple[Rectangle, ...] = ()  # that it fills in the same places in every run

    @property
    def places(self) -> tuple[Place, ...]:
        """Every place at which it is in all runs; its copies stand at the first of them when a run begins."""
        return () if self.or_ else self.at

    @property
    def options(self) -> tuple[Place, ...]:
        """The places of which each copy is drawn another one when a run begins; none where nothing is drawn of them."""
        return self.spots if self.or_ else ()

    @property
    def spots(self) -> tuple[Place, ...]:
        """Every place that it names, in whichever runs it is there."""
        return (*self.at, *(place for each in self.or_ for place in each))

    @property
    def copies(self) -> int:
        """The number of things of its name: each has a row of its own, one after the other."""
        return self.count if self.or_ else len(self.at) or self.count

    @property
    def largest(self) -> float:
        """The size that it has at most."""
        return max(self.size.first, self.size.last)

    @property
    def begins(self) -> tuple[float, float]:
        """The least and the greatest size that it begins with: the first of a schedule, any of its span otherwise."""
        first, last = self.size.first, self.size.last
        return (first, first) if self.size.by is not None else (min(first, last), max(first, last))

    @property
    def outcomes(self) -> Mapping[str, Outcome]:
        """The outcome of each event that it may say something about: `reached`, `delivered`."""
        return {each.field: getattr(self, each.field) for each in arguments(type(self)) if each.type is OUTCOME}

    def distances(self, scene: SceneKind) -> tuple[float, float]:
        """The least and the greatest distance from the robot at which it is placed."""
        if self.away != DEFAULT_DISTANCE:
            return self.away.first, self.away.last
        if self.within:
            return 0.0, inf
        return scene.distances(self.least_distance)

    def obstacles(self, scene: SceneKind | None) -> int:
        """The number of rectangles that it puts in the way; `scene` is None where that is not known."""
        return 0

    def standing(self, scene: SceneKind | None, may: bool = False) -> Iterable[Rectangle]:
        """Rectangles that it fills in every run, or with `may` in any; `scene` is None where that is not known."""
        return self.walls

    def at_places(self, places: tuple[Place, ...]) -> "ThingKind | None":
        """The thing at the places that a map draws; None where its own line or its kind says otherwise."""
        is_free = not (self.is_obstacle or self.spots or self.within) and self.count in (1, len(places))
        return replace(self, at=places) if is_free else None  # type: ignore[type-var]

    def rows(self, scene: SceneKind) -> Iterable[Row]:
        """The thing's rows of the lanes' table of obstacles.

        Each has the spacing of a `grid`, its `columns` and `rows` around `x` and `y`, the `jitter`, and the `count`.
        """
        return ()

    def mistake(self, scene: SceneKind | None) -> ThingMistake | None:
        """The error that keeps it out of a scene, or None; `scene` is None where that is not known."""
        if not self.spots:
            return self._distance_mistake(scene) or self._region_mistake(scene)
        if self.away != DEFAULT_DISTANCE:
            hint = "Leave away out: what stands at a place is as far away as that is."
            return ThingMistake("place-and-distance", "It says where it is, and how far away.", hint)
        if self.within:
            hint = "Leave within out, or the place."
            return ThingMistake("place-and-distance", "It says where it is, and within what.", hint)
        if self.or_:
            if mistake := self._choice_mistake():
                return mistake
        elif self.count > 1 and self.count != len(self.at):
            hint = "Leave the count out, or the place."
            if len(self.at) > 1:
                message = f"{self.count} things cannot stand at {len(self.at)} places."
                return ThingMistake("place-for-many", message, "Leave the count out, or name as many places.")
            return ThingMistake("place-for-many", "Several things cannot stand at one place.", hint)
        hint = "Write a place that is in it with all of the thing; 0 0 is the middle."
        return outside(scene, self.spots, self.largest / 2, hint)

    def _choice_mistake(self) -> ThingMistake | None:
        """An error where the first of its alternatives is missing, one is several places, or all are too few."""
        if not self.at:
            return ThingMistake("missing-argument", "Nothing stands before or.", "Write at 5 0 or 0 5.")
        if len(self.at) > 1 or any(len(each) > 1 for each in self.or_):
            hint = "Write one place on each side of or; with count 2 it is at two of them."
            return ThingMistake("place-for-many", "Several things cannot stand at one place.", hint)
        if self.count > len(self.spots):
            hint = f"Each is at another of the places: name {self.count} of them, or write a smaller count."
            return ThingMistake("place-for-many", "Several things cannot stand at one place.", hint)
        return None

    def _region_mistake(self, scene: SceneKind | None) -> ThingMistake | None:
        """An error where it is within what is no rectangle, or not inside the scene."""
        if isinstance(self.within, str):
            return None
        if len(self.within) != 2:
            hint = "Write two corners, or the name of a zone: within -10 -10 to 10 10."
            return ThingMistake("not-a-place", "A rectangle has two corners.", hint)
        (left, below), (right, above) = self.within
        middle = min(max(0.0, left), right), min(max(0.0, below), above)  # of the arena, or as near as it may be
        hint = "Write corners that are in it, or on its border, so that the thing has room; 0 0 is the middle."
        return outside(scene, self.within, 0.0, hint) or outside(scene, (middle,), self.largest / 2, hint)

    @staticmethod
    def accepts(argument: str, kind: "type[ThingKind]") -> bool:
        """True if an argument of it can name things of a kind: it can be within what lies on the floor."""
        return kind.is_area if argument == WITHIN else not kind.is_obstacle

    def _distance_mistake(self, scene: SceneKind | None) -> ThingMistake | None:
        """An error where a distance has a schedule, or no two places of the scene are so far apart."""
        if self.away == DEFAULT_DISTANCE:
            return None
        if self.away.by is not None:
            near, far = sorted((self.away.first, self.away.last))
            hint = f"Write away {near:g} to {far:g}: a distance between the two is drawn each time."
            return ThingMistake("distance-schedule", "A distance has no schedule.", hint)
        if scene is None or self.away.first < hypot(*scene.sides):
            return None
        hint = f"Its corners are {hypot(*scene.sides):g} apart: write a smaller distance, or a larger arena."
        return ThingMistake("too-far-away", "Nothing in this arena is so far from the robot.", hint)


class AboutThing:
    """A sensor, event or measure: it may be about a thing of the task, of any kind but obstacles unless it says."""

    __slots__ = ()

    @property
    def thing(self) -> str:
        """The name of the thing that it is about, or several with OR between, as its argument says; empty for none."""
        return self.named(THING)

    @property
    def things(self) -> tuple[str, ...]:
        """The names of all things that it is about alike: a sensor may have several; none where it has none."""
        return tuple(filter(None, self.thing.split(OR)))

    @property
    def other(self) -> str:
        """The name of the second thing that it is about; empty where it has none, and for the robot."""
        named = [getattr(self, each.field) for each in arguments(type(self)) if each.type is THING]
        return "".join(named[1:2])

    def named(self, reference: Reference) -> str:
        """The value of its first argument of a type; empty where it has none."""
        return next((getattr(self, each.field) for each in arguments(type(self)) if each.type is reference), "")

    @staticmethod
    def is_about(kind: type[ThingKind]) -> bool:
        """True if it can be about things of a kind."""
        return not kind.is_obstacle

    @classmethod
    def accepts(cls, argument: str, kind: type[ThingKind]) -> bool:
        """True if an argument of it can name things of a kind."""
        return cls.is_about(kind)


@dataclass(frozen=True, slots=True, kw_only=True)
class Placed(ThingKind):
    """A thing that touches nothing, and stays in its place until it is reached."""

    size: Lengths = field(default=DEFAULT_SIZE, kw_only=False)
    away: Lengths = DEFAULT_DISTANCE
    at: Places = ()
    or_: Alternatives = left_out(())
    within: Annotated[Region, THING] = left_out("")
    count: Count = 1
    reached: Becomes = STAYS


@dataclass(frozen=True, slots=True, kw_only=True)
class Aiming(Placed, AboutThing):
    """A thing that may go to the robot, or to the nearest thing of a name, or away from it, within its `range`."""

    seeks: ThingName = left_out("")
    flees: ThingName = left_out("")
    range: Annotated[float, DISTANCE] = left_out(FARTHEST_UNITS)

    @property
    def thing(self) -> str:
        return self.seeks or self.flees

    def aim_mistake(self) -> ThingMistake | None:
        """An error where it has two aims, or a distance without one."""
        aims = [each for each in ("along", "seeks", "flees") if getattr(self, each, ())]
        if len(aims) > 1:
            hint = f"Leave all but one of {' and '.join(aims)} out."
            return ThingMistake("two-aims", "It can go one way at a time.", hint)
        if self.range != FARTHEST_UNITS and not self.thing:
            hint = "Write seeks or flees, and of what: flees robot range 10."
            return ThingMistake(
                "aimless-distance", "A distance says when it seeks or flees, and it does neither.", hint
            )
        return None


@kind("content", "item")
class Item(Placed):
    """A disc of diameter `size` that the claw can take, or `count` of them, `away` from the robot or `at` a place.

    When it is `reached` or `delivered` it stays as it is (in the claw, where that holds it), moves elsewhere with the
    next size of its schedule, or vanishes for the rest of the run.
    """

    delivered: Becomes = MOVES

    can_be_held = True
    can_be_delivered = True
    is_round = True


@kind("content", "zone")
class Zone(Placed):
    """A square of side `size` on the floor, or `count` of them; items are delivered into it.

    When it is `reached` it stays where it is, moves elsewhere with the next size of its schedule, or vanishes for the
    rest of the run.
    """

    is_area = True
    takes_items = True


@kind("content", "power")
class Power(Placed):
    """A square of side `size` on the floor, or `count` of them, in which the battery charges.

    `reached` is as for a zone.
    """

    is_area = True
    charges = True
