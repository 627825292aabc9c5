"""A part of the floor to which no way leads from where the robot starts."""

from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf

from mindrun.kinds.things.thing import Rectangle, ThingKind
from mindrun.numbers.quantity import Place

from mindlang.compiler.beginning import PLAIN_START
from mindlang.compiler.model import Task
from mindlang.lint.study import Finding, Found, Study, rule

LEAST_SHARE = 0.01  # of the floor that is worth a word
MAX_CELLS = 250_000
ROOM_UNITS = 1e-6  # that a passage is wider than it is
CHAMFER_SHARE = 0.7071  # half of the side of a square in a disc of radius 1, and a little less
HINT = "Open a wall or widen a passage, or fill with wall what nobody is to enter."


@rule(once_a_line=True)
def walled_off(study: Study) -> Found:
    for task in study.mind.tasks:
        yield from _of_task(study, task)


def _of_task(study: Study, task: Task) -> Iterator[Finding]:
    """The findings of a task: what is walled off in every run, otherwise what is in some."""
    body, before = study.mind.body.kind, list[Rectangle]()
    for may in (False, True):
        opened = {end.opens for end in task.ends}
        standing = [each.kind for each in task.things if each.name not in opened and each.is_always_there]
        walls = [wall for kind in standing for wall in kind.standing(task.scene, may and _stays(task, kind))]
        if walls == before or task.scene.environment:
            return
        before = walls
        if whole := floor(_sides(task, walls, 4 * body.radius), walls, min(body.side, body.front)):
            yield from _findings(study, task, whole, "In some runs no way" if may else "No way")


def _stays(task: Task, kind: ThingKind) -> bool:
    """True if it is a single obstacle at a fixed place, of which only the size may be drawn at random."""
    return len(kind.places) == 1 and not any(row["jitter"] for row in kind.rows(task.scene))


def _sides(task: Task, walls: Sequence[Rectangle], beyond: float) -> tuple[float, float]:
    """The sides of an arena, or, in a plain scene, of what has a place, and so far beyond."""
    if task.scene.is_bounded:
        return task.scene.sides
    places = [task.start.at or PLAIN_START, *(place for thing in task.things for place in thing.kind.spots)]
    x = max(*(abs(x) for x, _ in places), *(abs(wall.x) + wall.half_x for wall in walls))
    y = max(*(abs(y) for _, y in places), *(abs(wall.y) + wall.half_y for wall in walls))
    return 2 * (x + beyond), 2 * (y + beyond)


def _findings(study: Study, task: Task, whole: "Floor", no_way: str) -> Iterator[Finding]:
    """The findings of a floor in parts: things that are out of reach, and a part that something may be drawn in."""
    at = study.beginning(task).at or (None if task.scene.is_bounded else PLAIN_START)
    there = whole.parts_near(at, 0.0) if at else {*range(len(whole.areas))}
    origin = " from where the robot starts" if at else ""
    reach = study.mind.body.kind.front + study.graph.claw_reach
    for thing in (each for each in task.things if not each.kind.is_obstacle and not each.kind.walks):
        half = thing.kind.begins[1] / 2 + (0.0 if thing.kind.is_area else reach)
        if any(not whole.parts_near(place, half) & there for place in thing.kind.spots):
            yield Finding(thing.span, f"{no_way} leads{origin} to {thing.name}.", HINT)
    apart = [each.kind for each in task.things if not each.kind.is_obstacle]
    is_drawn = at is None or any(not (kind.spots or kind.within) for kind in apart)
    if is_drawn and (part := _part_without_way(task, whole, there if at else None)):
        message = f"{no_way} leads{origin or ' from the rest'} to {part}, where something may be drawn."
        yield Finding(task.span, message, HINT)


def _part_without_way(task: Task, whole: "Floor", there: set[int] | None) -> str:
    """The share of the floor that no way leads to from some parts, or from the largest, in words; empty where small."""
    if not task.scene.is_bounded:
        return "" if there is None or whole.parts[0][0] in there else "what lies outside of the walls"
    there = {max(range(len(whole.areas)), key=whole.areas.__getitem__, default=0)} if there is None else there
    share = 1 - sum(whole.areas[part] for part in there) / (sum(whole.areas) or inf)
    return f"{share:.0%} of the floor of {task.name}" if share >= LEAST_SHARE and whole.areas else ""


@dataclass(frozen=True, slots=True)
class Floor:
    """The floor on which a robot can be, in parts between which no way leads.

    Every wall grows by the robot's radius, and the robot is a point. The floor is cut along all of their edges into
    cells, each of which is free or not, and free cells side by side are one part. A corner grows less than it would, so
    that no part is told apart that a robot could come into; a passage as wide as the robot is open.

    Edges of the cells along x and y, the part [row][column] that each belongs to, -1 where a wall is, and areas.
    """

    xs: Sequence[float]
    ys: Sequence[float]
    parts: Sequence[Sequence[int]]
    areas: Sequence[float]

    def parts_near(self, place: Place, half: float) -> set[int]:
        """The parts that come so near to a place, along both axes."""
        (x, y), found = place, set[int]()
        columns, rows = _cells(self.xs, x - half, x + half), _cells(self.ys, y - half, y + half)
        for row in rows:
            found |= {self.parts[row][column] for column in columns}
        return found - {-1}


def _cells(edges: Sequence[float], low: float, high: float) -> range:
    """The cells that a stretch lies in or touches: both where it is a point on the edge between two."""
    return range(max(0, bisect_left(edges, low) - 1), min(bisect_right(edges, high), len(edges) - 1))


def floor(sides: tuple[float, float], walls: Iterable[Rectangle], radius: float) -> Floor | None:
    """The floor of an arena with walls for a robot of that radius; None where it has too many cells to be looked at."""
    r, chamfer = radius - ROOM_UNITS, radius * CHAMFER_SHARE
    grown = [
        (wall.x - wall.half_x - a, wall.y - wall.half_y - b, wall.x + wall.half_x + a, wall.y + wall.half_y + b)
        for wall in walls
        for a, b in ((r, 0.0), (0.0, r), (chamfer, chamfer))
    ]
    half_x, half_y = (side / 2 - r for side in sides)
    xs = _edges(half_x, (x for box in grown for x in box[::2]))
    ys = _edges(half_y, (y for box in grown for y in box[1::2]))
    if len(xs) < 2 or len(ys) < 2 or len(xs) * len(ys) > MAX_CELLS:
        return None
    free = [bytearray(b"\1" * (len(xs) - 1)) for _ in ys[1:]]
    for left, low, right, high in grown:
        first, last = bisect_left(xs, left), bisect_left(xs, right)
        for row in free[bisect_left(ys, low) : bisect_left(ys, high)]:
            row[first:last] = bytes(max(0, last - first))
    return _parted(xs, ys, free)


def _edges(half: float, inner: Iterable[float]) -> list[float]:
    return sorted({-half, half, *(x for x in inner if -half < x < half)}) if half > 0 else []


def _parted(xs: Sequence[float], ys: Sequence[float], free: Sequence[bytearray]) -> Floor:
    """The free cells by parts; a cell to which a way leads is free no more."""
    wide, high = ([b - a for a, b in pairwise(edges)] for edges in (xs, ys))
    parts = [[-1] * len(row) for row in free]
    areas: list[float] = []
    for start, cells in enumerate(free):
        while (first := cells.find(1)) >= 0:
            waiting, area, cells[first] = [(start, first)], 0.0, 0
            while waiting:
                row, column = waiting.pop()
                parts[row][column] = len(areas)
                area += wide[column] * high[row]
                for r, c in ((row + 1, column), (row - 1, column), (row, column + 1), (row, column - 1)):
                    if 0 <= r < len(free) and 0 <= c < len(wide) and free[r][c]:
                        free[r][c] = 0
                        waiting.append((r, c))
            areas.append(area)
    return Floor(xs, ys, parts, areas)
