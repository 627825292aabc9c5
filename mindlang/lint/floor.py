"""The floor of an arena on which a robot can be, and how it falls into parts between which no way leads.

Every wall grows by the robot's radius, and the robot is a point. The floor is cut along all of their edges into cells,
each of which is free or not, and free cells side by side are one part. A corner grows less than it would, so that no
part is told apart that a robot could come into; a passage as wide as the robot is open.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from mindrun.kinds.things.thing import Rectangle
from mindrun.numbers.quantity import Place

MAX_CELLS = 250_000
ROOM_UNITS = 1e-6  # that a passage is wider than it is
CHAMFER_SHARE = 0.7071  # half of the side of a square in a disc of radius 1, and a little less


@dataclass(frozen=True, slots=True)
class Floor:
    """Edges of the cells along x and y, the part [row][column] that each belongs to, -1 where a wall is, and areas."""

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
    """The free cells by parts, the largest first."""
    parts = [[-1] * len(row) for row in free]
    areas: list[float] = []
    for row, cells in enumerate(free):
        for column in range(len(cells)):
            if free[row][column] and parts[row][column] < 0:
                areas.append(_fill(xs, ys, free, parts, (row, column), len(areas)))
    return Floor(xs, ys, parts, areas)


def _fill(
    xs: Sequence[float], ys: Sequence[float], free: Sequence[bytearray], parts: list[list[int]], start: tuple[int, int],
    number: int,
) -> float:  # fmt: skip
    """Mark all cells that a way leads to with the number of their part; its area."""
    wide, high = ([b - a for a, b in pairwise(edges)] for edges in (xs, ys))
    waiting, area = [start], 0.0
    parts[start[0]][start[1]] = number
    while waiting:
        row, column = waiting.pop()
        area += wide[column] * high[row]
        for r, c in ((row + 1, column), (row - 1, column), (row, column + 1), (row, column - 1)):
            if 0 <= r < len(free) and 0 <= c < len(wide) and free[r][c] and parts[r][c] < 0:
                parts[r][c] = number
                waiting.append((r, c))
    return area
