"""A world in which its things hardly fit."""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import product
from math import cos, hypot, inf, pi, sin
from random import Random

from mindrun.graph.tasks import meets_robot
from mindrun.kinds.bodies.body import BodyKind
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.kinds.things.thing import Rectangle, ThingKind
from mindrun.numbers.quantity import Place, Span

from mindlang.compiler.model import Task, Thing
from mindlang.compiler.syntax import Contains, of_form
from mindlang.lint.study import Finding, Found, Study, rule

MAX_TRIES = 200  # for one thing; the lanes try 1000 times
ROBOT = "the robot"
MAX_WORLDS, MAX_LOOKS = 100, 200_000  # as many worlds as cost no more than that
HINT = "Make the arena larger, or what is in it smaller or fewer, or say where it stands: at 10 -5."


@rule(once_a_line=True)
def crowded_world(study: Study) -> Found:
    for task in study.mind.tasks:
        lacking, worlds = _lacking(study, task)
        if lacking:
            name = lacking.most_common(1)[0][0]
            said = f"{name[0].upper()}{name[1:]}" if name == ROBOT else name
            message = f"{said} finds no place in {lacking[name]} of {worlds} worlds of {task.name} that were drawn."
            things = (fact.name.span for fact in of_form(task.facts, Contains) if fact.name.text == name)
            yield Finding(next(things, task.span), message, HINT)


def _lacking(study: Study, task: Task) -> tuple[Counter[str], int]:
    """In how many worlds something is the first to find no place, by its name, and how many were drawn."""
    found, looks, random = Counter[str](), 0, Random(1)
    body, claw, never = study.mind.body.kind, study.graph.claw_reach, study.goals(task)
    for number in range(MAX_WORLDS if not task.scene.environment else 0):
        world = DrawnWorld(task.scene, body, claw, never, random)
        if name := world.draw(task):
            found[name] += 1
        looks += world.looks
        if looks > MAX_LOOKS:
            return found, number + 1
    return found, MAX_WORLDS


@dataclass(slots=True)
class DrawnWorld:
    """A world drawn as `mindrun.sim.lanes.placement` draws it, in plain Python: does everything find a place?

    What stands already: what is solid, all other things, and the robot, which is as wide as twice its radius.

    The robot never begins where it has reached one of the `goals`, with a claw that reaches so far ahead of it. `looks`
    counts how often two things were held against each other: what drawing costs.
    """

    scene: SceneKind
    body: BodyKind
    claw: float
    goals: frozenset[str]
    random: Random
    solid: list[Rectangle] = field(default_factory=list)
    things: list[Rectangle] = field(default_factory=list)
    robot: Place = (0.0, 0.0)
    looks: int = 0

    def draw(self, task: Task) -> str:
        """Put everything down, in the order of the lanes; the name of what finds no place, empty where all do."""
        for thing in task.things:
            self.solid += [*thing.kind.walls, *(self._grid(thing.kind) if thing.kind.is_obstacle else ())]
        if not self._start(task):
            return ROBOT
        obstacles, others = ([each for each in task.things if each.kind.is_obstacle is one] for one in (True, False))
        drawn = [each for each in others if not (each.kind.spots or each.kind.within)]
        robots, drawn = ([each for each in drawn if each.kind.is_robot is one] for one in (True, False))
        for thing in robots:
            if not all(self._start_another(task, thing) for _ in range(thing.kind.copies)):
                return thing.name
        for kind in (each.kind for each in others):
            self.things += [_square(place, self._half(kind)) for place in self._placed(kind)]
        loose = [(each, sum(int(row["count"]) for row in each.kind.rows(self.scene))) for each in obstacles]
        loose += [(each, each.kind.copies) for each in drawn]
        for thing, count in loose:
            if not all(self._put(thing.name, thing.kind) for _ in range(count)):
                return thing.name
        return ""

    def _placed(self, kind: ThingKind) -> Sequence[Place]:
        """Places of a thing that has some, drawn where one of several is."""
        several = self.random.sample(kind.options, kind.copies if kind.options else 0)
        return several or kind.places[: kind.copies] or kind.spots[: kind.copies]

    def _grid(self, kind: ThingKind) -> Iterator[Rectangle]:
        """The obstacles of a kind that stand at places, each off by its jitter."""
        for row in kind.rows(self.scene):
            columns, rows, spacing = int(row["columns"]), int(row["rows"]), row["grid"]
            from_x, from_y = self.random.choice(kind.options) if kind.options else (row["x"], row["y"])
            for line, column in product(range(rows), range(columns)) if not row["count"] else ():
                x = from_x + (column - (columns - 1) / 2) * spacing + row["jitter"] * self.random.uniform(-1, 1)
                y = from_y + (line - (rows - 1) / 2) * spacing + row["jitter"] * self.random.uniform(-1, 1)
                yield _square((x, y), self._size(kind.size) / 2)

    def _start(self, task: Task) -> bool:
        """Put the robot where its task says, or in the middle of a plain scene, or where it touches nothing."""
        if task.start.at or not self.scene.is_bounded:
            self.robot = task.start.at or self.robot
            return True
        return self._start_anywhere(task)

    def _start_another(self, task: Task, thing: Thing) -> bool:
        """Put another robot where nothing of the task and no robot is, or so far from the first as it says."""
        if thing.kind.distances(self.scene)[1] < inf:
            return self._put(thing.name, thing.kind)
        first = self.robot
        self.things.append(_square(first, self.body.radius))
        is_found = self._start_anywhere(task)
        self.things[-1] = _square(self.robot, self.body.radius)
        self.robot = first
        return is_found

    def _start_anywhere(self, task: Task) -> bool:
        """Put the robot where it touches nothing; False where no try succeeds."""
        placed = [(each, place) for each in task.things for place in each.kind.places[: each.kind.copies]]
        moving = [(each.kind, place) for each, place in placed if each.kind.is_loose or each.kind.is_robot]
        solid = [*self.solid, *self.things, *(_square(place, self._half(kind)) for kind, place in moving)]
        apart = [(each, place) for each, place in placed if not each.kind.is_obstacle]
        for _ in range(MAX_TRIES):
            self.robot = self._anywhere(3 * self.body.radius, self.body.radius)
            if self._is_clear(solid, self.robot, self.body.radius) and not any(
                self._meets(each.name, each.kind, self._first(each.kind), place) for each, place in apart
            ):
                return True
        return False

    def _half(self, kind: ThingKind) -> float:
        """Half of the largest size of a thing."""
        return self.body.radius if kind.is_robot else kind.largest / 2

    def _first(self, kind: ThingKind) -> float:
        """The largest size that a thing begins with."""
        return 2 * self.body.radius if kind.is_robot else kind.begins[1]

    def _meets(self, name: str, kind: ThingKind, size: float, place: Place) -> bool:
        """True if a thing at a place overlaps the robot, or is a goal that it has reached."""
        dx, dy = place[0] - self.robot[0], place[1] - self.robot[1]
        reach, is_goal = self.body.front + self.claw, name in self.goals
        return meets_robot(kind.is_area, kind.is_round, is_goal, size, dx, dy, self.body.radius, reach)

    def _put(self, name: str, kind: ThingKind) -> bool:
        """Put a thing down, an obstacle so that the robot can pass it; False where no try succeeds."""
        (low, high), half = kind.distances(self.scene), self.body.radius if kind.is_robot else self._size(kind.size) / 2
        where, room = (self.solid, half + 3 * self.body.radius) if kind.is_obstacle else (self.things, 0.0)
        for _ in range(MAX_TRIES):
            place = self._anywhere(half + 2 * self.body.radius) if self.scene.is_bounded else self._around(low, high)
            x, y = place[0] - self.robot[0], place[1] - self.robot[1]
            is_far = low <= hypot(x, y) + 1e-9 and hypot(x, y) <= high + 1e-9 and max(abs(x), abs(y)) >= room
            is_apart = is_far and (kind.is_obstacle or not self._meets(name, kind, 2 * half, place))
            clear = is_apart and self._is_clear(self.solid, place, half + 2 * self.body.radius)
            if clear and self._is_clear(self.things, place, half):
                where.append(_square(place, half))
                return True
        return False

    def _anywhere(self, margin: float, least: float = inf) -> Place:
        """A place in an arena, so far from its walls; where it is too small for that, at the `least` so far."""
        halves = [side / 2 for side in self.scene.sides]
        x, y = (half - margin if half > margin else max(half - least, 0.0) for half in halves)
        return self.random.uniform(-x, x), self.random.uniform(-y, y)

    def _around(self, low: float, high: float) -> Place:
        """A place in a plain scene, so far from the robot."""
        angle, far = self.random.uniform(0.0, 2 * pi), self.random.uniform(low, high)
        return self.robot[0] + far * cos(angle), self.robot[1] + far * sin(angle)

    def _is_clear(self, of: Sequence[Rectangle], place: Place, margin: float) -> bool:
        """True if none of the rectangles comes within a margin of a place, along the axes."""
        x, y = place
        self.looks += len(of)
        return not any(abs(x - each.x) < each.half_x + margin and abs(y - each.y) < each.half_y + margin for each in of)

    def _size(self, of: Span) -> float:
        """A size: drawn where it is, and of a schedule the largest."""
        is_drawn = of.by is None and of.first != of.last
        return self.random.uniform(of.first, of.last) if is_drawn else max(of.first, of.last)


def _square(place: Place, half: float) -> Rectangle:
    return Rectangle(*place, half, half)
