"""The world of a task when a run begins: the things that overlap, and those that the robot has reached already.

One rule for each two of all that has a place: **bodies** (robots, items, boxes, balls, walkers) take up room, what
is **fixed** (obstacles, walls, maps) does, too, and what lies on the **floor** (zones, powers) takes up none. Two
bodies are never in one place, nor is a body in what is fixed, nor the middle of what lies on the floor. All else may
be: walls cross, a zone lies under a box.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from math import cos, hypot, inf, sin
from typing import Literal, NamedTuple

from mindrun.graph.graph import Start
from mindrun.kinds.bodies.body import BodyKind
from mindrun.kinds.events.event import EventKind
from mindrun.kinds.scenes.scene import TOUCHING_UNITS, SceneKind
from mindrun.kinds.sensors.sensor import SensorKind
from mindrun.kinds.things.thing import Rectangle, ThingKind
from mindrun.numbers.quantity import Place

from mindlang.compiler.model import Thing

Role = Literal["body", "fixed", "floor"]
APART: frozenset[frozenset[Role]] = frozenset({
    frozenset[Role]({"body"}), frozenset[Role]({"body", "fixed"}), frozenset[Role]({"floor", "fixed"}),
})  # fmt: skip
UNIT_AXES: tuple[Place, Place] = ((1.0, 0.0), (0.0, 1.0))
PLAIN_START: Place = (0.0, 0.0)  # where a robot starts in a plain scene that says nothing else


class Outline(NamedTuple):
    """A convex shape: all that is no farther than `rim` from its corners and what lies between them."""

    corners: tuple[Place, ...]
    rim: float = 0.0

    def span(self, axis: Place) -> tuple[float, float]:
        """The ends of the shape along an axis of length 1."""
        along = [x * axis[0] + y * axis[1] for x, y in self.corners]
        return min(along) - self.rim, max(along) + self.rim


def rectangle_outline(of: Rectangle) -> Outline:
    """The corners of a rectangle along the axes."""
    left, right, low, high = of.x - of.half_x, of.x + of.half_x, of.y - of.half_y, of.y + of.half_y
    return Outline(((left, low), (right, low), (right, high), (left, high)))


def overlap(one: Outline, other: Outline) -> bool:
    """True if two convex outlines overlap in more than an end: no axis separates them (separating axis theorem)."""
    for axis in _axes(one, other):
        (low, high), (least, most) = one.span(axis), other.span(axis)
        if not (low < most - TOUCHING_UNITS and least < high - TOUCHING_UNITS):
            return False
    return True


def _axes(one: Outline, other: Outline) -> Iterator[Place]:
    """Unit directions to look for a separating axis in: normals of sides and, where a rim is round, between corners.

    Along x and y most are found at once.
    """
    yield from UNIT_AXES
    for of in (one, other):
        for (x, y), (to_x, to_y) in zip(of.corners, (*of.corners[1:], of.corners[0]), strict=True):
            yield from _direction(y - to_y, to_x - x)
    if one.rim or other.rim:
        for x, y in one.corners:
            for to_x, to_y in other.corners:
                yield from _direction(to_x - x, to_y - y)


def _direction(x: float, y: float) -> Iterator[Place]:
    if 0 < (length := hypot(x, y)) < inf:
        yield x / length, y / length


def role(kind: ThingKind) -> Role:
    """The role of a kind of thing in the rule of the module."""
    return "fixed" if kind.is_obstacle else "floor" if kind.is_area else "body"


@dataclass(frozen=True, slots=True)
class Beginning:
    """A scene and its things with a place, and the robot: what all of it covers in every run.

    With `may`, what it covers in some: the largest of each size, wherever jitter moves it, whichever way the robot
    faces where that is drawn. `at` is None where the robot's place is drawn, `body` where it is not known.
    """

    scene: SceneKind | None
    things: Sequence[Thing]
    at: Place | None
    facing: float | None
    body: BodyKind | None
    claw: float
    may: bool = False

    def outlines(self, kind: ThingKind) -> list[Outline]:
        """The outline of each copy of a thing that has a place; of one that lies on the floor its middle alone."""
        if kind.is_obstacle:
            return [rectangle_outline(each) for each in kind.standing(self.scene, self.may)]
        return self._outlines_at(kind, kind.places[: kind.copies])

    def _outlines_at(self, kind: ThingKind, places: Iterable[Place]) -> list[Outline]:
        half = self.half(kind)
        if kind.is_round or kind.is_area:
            return [Outline((place,), 0.0 if kind.is_area else half) for place in places]
        return [rectangle_outline(Rectangle(*place, half, half)) for place in places]

    def half(self, kind: ThingKind) -> float:
        """Half of the size with which a thing begins; of a robot, which faces anywhere, the disc in it or around it."""
        if kind.is_robot:
            return self.robot_radius
        return kind.begins[1 if self.may else 0] / 2

    @property
    def robot(self) -> Outline | None:
        """The outline of the robot where it starts; None where that place is drawn at random."""
        if self.at is None:
            return None
        if self.body is None:
            return Outline((self.at,))
        if self.body.outline and self.facing is not None:
            (x, y), c, s = self.at, cos(self.facing), sin(self.facing)
            turned = ((x + c * ahead - s * aside, y + s * ahead + c * aside) for ahead, aside in self.body.outline)
            return Outline(tuple(turned))
        return Outline((self.at,), self.robot_radius)

    @property
    def robot_radius(self) -> float:
        """The radius of the disc in the robot's body, or with `may` around it; 0 of a body that is not known."""
        if self.body is None:
            return 0.0
        return self.body.radius if self.may else min(self.body.side, self.body.front)

    @property
    def is_inside(self) -> bool:
        """True if the robot starts within the walls of its scene; one whose place is drawn is tried in the middle."""
        robot = self.robot or replace(self, at=PLAIN_START).robot
        if self.scene is None or robot is None:
            return True
        ends = zip((robot.span(axis) for axis in UNIT_AXES), self.scene.sides, strict=True)
        return all(max(-low, high) <= side / 2 + TOUCHING_UNITS for (low, high), side in ends)

    def overlapping(self) -> Iterator[tuple[Thing, Thing]]:
        """Pairs of things that overlap, a fixed one as the second; one that is not always there only with fixed ones.

        Against what is fixed one is tried at each place that is drawn, and one that walks at all of its way.
        """
        parts = [(each, role(each.kind), self.outlines(each.kind)) for each in self.things if each.kind]
        placed = sorted((part for part in parts if part[2] or part[0].kind.spots), key=lambda part: part[1] != "fixed")
        for number, (thing, its, outlines) in enumerate(placed):
            if its == "body" and any(overlap(a, b) for i, a in enumerate(outlines) for b in outlines[:i]):
                yield thing, thing
            spots = [*outlines, *self._drawn(thing.kind)]
            spots += [Outline((place,)) for place in thing.kind.spots]
            for other, other_role, others in () if its == "fixed" else placed[:number]:
                mine = spots if other_role == "fixed" else outlines
                may_be_apart = not other.is_always_there or not (other_role == "fixed" or thing.is_always_there)
                if {its, other_role} in APART and not may_be_apart and any(overlap(a, b) for a in mine for b in others):
                    yield thing, other

    def on_robot(self) -> Thing | None:
        """The first thing that is where the robot starts."""
        robot = self.robot
        bodies = (thing for thing in self.things if thing.kind and role(thing.kind) != "floor")
        begins = ((each, [*self.outlines(each.kind), *self._drawn(each.kind)]) for each in bodies)
        return next((each for each, its in begins if robot and any(overlap(robot, one) for one in its)), None)

    def _drawn(self, kind: ThingKind) -> list[Outline]:
        """The outlines of a thing at each place of which one is drawn."""
        standing = kind.standing(self.scene, True) if kind.is_obstacle and kind.options else ()
        return [*map(rectangle_outline, standing)] or self._outlines_at(kind, kind.options)

    def first_tick_count(self, event: EventKind, sensors: Iterable[SensorKind]) -> int:
        """How often an event happens in the first tick of every run, whatever the robot does."""
        if event.within and not self.first_tick_count(event.within.of, sensors):
            return 0
        if event.is_of_battery:
            batteries = [kind.battery for kind in sensors if kind.battery]
            charging = any(self.reached(thing.name) for thing in self.things if thing.kind and thing.kind.charges)
            return int(any(battery.start == 0 for battery in batteries) and not charging)
        match event.outcome:
            case "reached":
                return self.reached(event.thing)
            case "delivered":
                return self.delivered(event.thing, getattr(event, "to", ""))
        return 0

    def reached(self, name: str) -> int:
        """How many things of a name the robot has reached where it starts."""
        return sum(self._is_reached(kind, place) for kind, place in self._placed(name))

    def delivered(self, name: str, to: str) -> int:
        """How many boxes and balls of a name stand in a zone, or in one of the name `to` if that is not empty."""
        zones = [each.kind for each in self.things if each.kind and each.kind.takes_items and to in ("", each.name)]
        inside = [(zone, place) for zone in zones for place in zone.places]
        placed = (place for kind, place in self._placed(name) if kind.is_loose)
        return sum(any(self._is_inside(zone, middle, place) for zone, middle in inside) for place in placed)

    def _placed(self, name: str) -> Iterable[tuple[ThingKind, Place]]:
        there = (each for each in self.things if self.may or each.is_always_there)
        kinds = (each.kind for each in there if each.kind and each.name == name)
        return ((kind, place) for kind in kinds for place in self._begins(kind))

    def _begins(self, kind: ThingKind) -> Iterable[Place]:
        """The places at which a thing begins in every run, or with `may` in some."""
        return kind.options if self.may and kind.options else kind.places[: kind.copies]

    def _is_inside(self, area: ThingKind, middle: Place, place: Place) -> bool:
        return max(abs(middle[0] - place[0]), abs(middle[1] - place[1])) <= self.half(area)

    def _is_reached(self, kind: ThingKind, place: Place) -> bool:
        """True if the robot is inside an area on the floor, or has another kind of thing in its claw's reach."""
        if self.at is None or self.body is None:
            return False
        if kind.is_area:
            return self._is_inside(kind, place, self.at)
        dx, dy = place[0] - self.at[0], place[1] - self.at[1]
        reach = self.claw + self.half(kind)
        if self.facing is None:
            return self.may and hypot(dx, dy) <= self.body.front + reach
        c, s = cos(self.facing), sin(self.facing)
        ahead, aside = c * dx + s * dy - self.body.front, c * dy - s * dx
        return ahead >= 0 and hypot(ahead, aside) <= reach


def task_beginning(
    scene: SceneKind | None, things: Sequence[Thing], start: Start, body: BodyKind | None, claw: float
) -> Beginning:
    """The beginning of a task's runs."""
    is_in_middle = scene is not None and not scene.is_bounded
    return Beginning(scene, things, start.at or (PLAIN_START if is_in_middle else None), start.facing, body, claw)


def first_tick_hint(event: EventKind) -> str:
    """The hint for an event that comes in the first tick."""
    if event.is_of_battery:
        return "Let the battery start above 0."
    if event.outcome == "delivered":
        return f"Write another place for {event.thing}, outside of where it is to come."
    return f"Write another place for {event.thing} or the robot."
