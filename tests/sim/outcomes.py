"""What becomes of things, computed the obvious way from where the robot was: what the lanes are held against."""

from collections.abc import Iterator, Sequence
from math import sqrt

import numpy as np
from mindrun.graph.graph import Graph, Task
from mindrun.kinds.things.obstacle import Obstacle
from mindrun.kinds.things.thing import Item, Power, Zone
from mindrun.numbers.trigonometry import cosine, sine
from mindrun.sim.trace import Moment, Trace
from numpy.typing import NDArray

REACH = 1.5  # of the claw

Thing = tuple[float, float, float]  # x, y, size


class PlainWorld:
    """The things of a task. Where one that moves appears is random, so it is told; all else follows from the robot."""

    def __init__(self, graph: Graph, task: Task, run: Trace) -> None:
        self.radius = graph.body.size / 2
        things = [thing for thing in task.things if not isinstance(thing.kind, Obstacle)]
        self.kinds = [thing.kind for thing in things]
        self.names = [thing.name for thing in things]
        self.things: list[Thing | None] = [(x, y, size) for x, y, size in run.things.tolist()]
        self.body, self.held = run.begin, -1
        self.reached: set[int] = set()
        self.delivered: set[int] = set()

    def tick(self, moment: Moment, grips: bool) -> tuple[set[int], set[int], dict[str, float]]:
        """What begins to be in reach and what is delivered in the tick that led to a moment, and the progress made."""
        before = [self.distance(i) for i in range(len(self.kinds))]
        self.held = self.held if grips else -1
        if grips and self.held < 0:
            self.held = next((i for i, kind in enumerate(self.kinds) if isinstance(kind, Item) and self.near(i)), -1)
        self.body = moment.body
        if self.held >= 0:
            self.carry(self.held)
        progress = {
            name: 0.0 if self.things[i] is None else before[i] - self.distance(i) for i, name in enumerate(self.names)
        }
        reached, delivered = set(self.all_reached()), set(self.all_delivered())
        new = reached - self.reached, delivered - self.delivered
        self.reached, self.delivered = reached, delivered
        for i in range(len(self.kinds)):
            self.become(i, i in new[0], i in new[1], moment.things[i])
        return *new, progress

    def become(self, i: int, is_reached: bool, is_delivered: bool, told: NDArray[np.float64]) -> None:
        """Thing i stays, appears where it is told, or is gone."""
        kind = self.kinds[i]
        said = [kind.reached] * is_reached + ([kind.delivered] * is_delivered if isinstance(kind, Item) else [])
        if not {"moves", "vanishes"} & {*said}:
            return
        x, y, size = told.tolist()
        self.things[i] = None if "vanishes" in said else (x, y, size)
        self.reached.discard(i)
        self.delivered.discard(i)
        self.held = -1 if self.held == i else self.held

    def carry(self, i: int) -> None:
        """Thing i stands at the front of the body."""
        thing, span = self.things[i], self.kinds[i].size
        assert thing
        ahead = self.radius + max(span.first, span.last) / 2
        x, y, angle = self.body[:3].tolist()
        self.things[i] = x + cosine(angle) * ahead, y + sine(angle) * ahead, thing[2]

    def all_reached(self) -> Iterator[int]:
        """The things in reach."""
        x, y = self.body[:2].tolist()
        for i, kind in enumerate(self.kinds):
            if self.near(i) if isinstance(kind, Item) else self.inside(i, (x, y)):
                yield i

    def all_delivered(self) -> Iterator[int]:
        """The items whose middle is in a zone, and that were carried there."""
        zones = [z for z, kind in enumerate(self.kinds) if isinstance(kind, Zone)]
        for i in {self.held, *self.delivered} - {-1}:
            thing = self.things[i]
            if thing and any(self.inside(z, thing[:2]) for z in zones):
                yield i

    def near(self, i: int) -> bool:
        """Whether an item is in the claw's reach."""
        if (thing := self.things[i]) is None:
            return False
        x, y, angle = self.body[:3].tolist()
        dx, dy, c, s = thing[0] - x, thing[1] - y, cosine(angle), sine(angle)
        ahead, aside, far = c * dx + s * dy - self.radius, c * dy - s * dx, REACH + thing[2] / 2
        return ahead >= 0 and ahead * ahead + aside * aside <= far * far

    def inside(self, i: int, point: Sequence[float]) -> bool:
        """Whether a point is in the square of a thing."""
        thing = self.things[i]
        return thing is not None and max(abs(thing[0] - point[0]), abs(thing[1] - point[1])) <= thing[2] / 2

    def charges(self) -> bool:
        """Whether the robot is in a power."""
        place = self.body[:2].tolist()
        return any(isinstance(kind, Power) and self.inside(i, place) for i, kind in enumerate(self.kinds))

    def distance(self, i: int) -> float:
        """How far the robot is from a thing."""
        if (thing := self.things[i]) is None:
            return float("nan")
        dx, dy = thing[0] - float(self.body[0]), thing[1] - float(self.body[1])
        return sqrt(dx * dx + dy * dy)
