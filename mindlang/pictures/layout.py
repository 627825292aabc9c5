"""Where a hierarchy's skills, actuators and memories stand: in rows from the master down, few links crossing."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from statistics import fmean
from typing import Literal

from mindlang.pictures.canvas import Rectangle
from mindlang.run.edge_flow import Link, Sink

Stop = Sink | tuple[Literal["link"], int]  # a box, or where a link passes a row

CROSSING_SWEEPS = 8
MAX_BOX_WIDTH, MAX_BOX_HEIGHT = 210.0, 50.0  # pixels of a box
BOX_SHARE = 0.58  # of the height of a row: that of its boxes, where rows are low
PASSAGE_SHARE = 0.3  # of a box's room: that of a link which passes a row


@dataclass(frozen=True, slots=True)
class Place:
    """A rectangle by its middle, in pixels."""

    x: float
    y: float
    width: float
    height: float


@dataclass(frozen=True, slots=True)
class Layout:
    """The boxes, and for each link the places that it goes through: from box to box, between the others of a row."""

    boxes: dict[Sink, Place]
    stops: list[list[Place]]

    @classmethod
    def of(cls, links: Sequence[Link], skills: Sequence[int], room: Rectangle) -> "Layout":
        """The layout of what is linked; `skills` stand parents first."""
        level = _levels(links, skills)
        routes = [_route(number, link, level) for number, link in enumerate(links)]
        rows = _ordered(_rows(level, routes), routes)
        places = {sink: place for i, row in enumerate(rows) for sink, place in _spread(row, i, len(rows), room)}
        boxes = {(to, index): place for (to, index), place in places.items() if to != "link"}
        return cls(boxes, [[places[stop] for stop in route] for route in routes])


def _levels(links: Sequence[Link], skills: Sequence[int]) -> dict[Stop, int]:
    """The row of each box: a skill's is below the lowest of its parents', what is driven has the last."""
    level: dict[Stop, int] = {("skill", skill): 0 for skill in skills}
    for link in links:
        if link.target[0] == "skill":
            level[link.target] = max(level[link.target], level["skill", link.source] + 1)
    last = max(level.values()) + 1
    return level | dict.fromkeys(sorted(link.target for link in links if link.target[0] != "skill"), last)


def _route(number: int, link: Link, level: dict[Stop, int]) -> list[Stop]:
    """The link's ends, and between them a stop in each row that it passes."""
    source: Sink = ("skill", link.source)
    passed = range(level[source] + 1, level[link.target])
    return [source, *(("link", number * 1000 + row) for row in passed), link.target]


def _rows(level: dict[Stop, int], routes: Iterable[Sequence[Stop]]) -> list[list[Stop]]:
    rows: list[list[Stop]] = [[] for _ in range(max(level.values()) + 1)]
    for sink, row in level.items():
        rows[row].append(sink)
    for route in routes:
        for row, stop in enumerate(route[1:-1], level[route[0]] + 1):
            rows[row].append(stop)
    return rows


def _ordered(rows: list[list[Stop]], routes: Iterable[Sequence[Stop]]) -> list[list[Stop]]:
    """The rows sorted, down and up again, by the mean place of what each box is linked to in the rows beside it."""
    near: dict[Stop, list[Stop]] = {sink: [] for row in rows for sink in row}
    for upper, lower in (pair for route in routes for pair in pairwise(route)):
        near[upper].append(lower)
        near[lower].append(upper)
    at = {sink: (number + 0.5) / len(row) for row in rows for number, sink in enumerate(row)}
    for _ in range(CROSSING_SWEEPS):
        for row in (*rows, *reversed(rows)):
            row.sort(key=lambda sink: fmean([at[other] for other in near[sink]] or [at[sink]]))
            at |= {sink: (number + 0.5) / len(row) for number, sink in enumerate(row)}
    return rows


def _spread(row: Sequence[Stop], level: int, levels: int, room: Rectangle) -> Iterable[tuple[Stop, Place]]:
    """The boxes of a row side by side."""
    shares = [PASSAGE_SHARE if sink[0] == "link" else 1.0 for sink in row]
    unit, gap = room.width / sum(shares), room.height / levels
    x, y = room.left, room.low + (level + 0.5) * gap
    for sink, share in zip(row, shares, strict=True):
        width, height = min(0.88 * share * unit, MAX_BOX_WIDTH), min(BOX_SHARE * gap, MAX_BOX_HEIGHT)
        yield sink, Place(x + share * unit / 2, y, width, height)
        x += share * unit
