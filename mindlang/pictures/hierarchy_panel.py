"""The hierarchy in one tick, after the paper's Figure 15: a link's middle is the command, its rim the influence."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from operator import itemgetter
from statistics import fmean
from typing import Literal

import numpy as np
from mindrun.engine.engine import procedure_sources
from numpy.typing import NDArray

from mindlang.pictures.canvas import Canvas, Region, text_width
from mindlang.pictures.theme import NIGHT, Colour, mixed
from mindlang.run.edge_flow import Link, Sink, edge_flows
from mindlang.run.recorded_run import RecordedRun

BEND = np.linspace(0.0, 1.0, 24)
MAX_TEXT_PIXELS, MIN_TEXT_PIXELS = 11.0, 5.0  # capitals of names, in pixels
LINE_GAP_PIXELS = 5.0  # between two lines of a box
RIM_PIXELS, CORE_PIXELS = 7.0, 2.0
Stop = Sink | tuple[Literal["link"], int]  # a box, or where a link passes a row
CROSSING_SWEEPS = 8
MAX_BOX_WIDTH, MAX_BOX_HEIGHT = 210.0, 50.0  # pixels of a box
BOX_SHARE = 0.58  # of the height of a row: that of its boxes, where rows are low
PASSAGE_SHARE = 0.3  # of a box's room: that of a link which passes a row


class HierarchyPanel:
    """Draws the hierarchy of a run into a rectangle of a page."""

    def __init__(self, run: RecordedRun, room: Region) -> None:
        self._run = run
        sources = procedure_sources(run.graph, run.setup.folder, run.setup.master)
        self._flows = edge_flows(run.setup.ready.policy, sources, run.setup.master, run)
        self._boxes, self._stops = laid_out(self._flows.links, self._flows.skills, room)
        self._lines = {sink: self._lines_of(sink, place) for sink, place in self._boxes.items()}
        self._size = min(box_text_size(self._lines[sink], place) for sink, place in self._boxes.items())

    def draw(self, canvas: Canvas, tick: int) -> None:
        """Draw the hierarchy in a tick, the first of which is 1."""
        flow = self._flows.flow_at(range(tick - 1, tick))
        links = zip(self._stops, flow.value[0].tolist(), flow.transmitted[0].tolist(), strict=True)
        for stops, command, transmitted in sorted(links, key=itemgetter(2)):  # what is bright lies on top
            line = _curve(stops)
            canvas.line(line, mixed(NIGHT.dark, NIGHT.glow, transmitted), RIM_PIXELS)
            canvas.line(line, NIGHT.page, CORE_PIXELS + 2)
            canvas.line(line, mixed(NIGHT.dark, NIGHT.glow, command), CORE_PIXELS)
        for sink, place in self._boxes.items():
            match sink:
                case "skill", index:
                    self._skill(canvas, self._lines[sink], place, float(self._run.influence[tick - 1, index]))
                case "actuator", index:
                    actuator, command = self._run.graph.actuators[index], float(self._run.commands[tick - 1, index])
                    self._gauge(canvas, actuator.name, place, command, actuator.kind.zero)
                case "memory", index:
                    cell = self._run.graph.memories[index]
                    self._gauge(canvas, cell.name, place, float(self._run.readings[tick - 1, cell.start]), 0.0)

    def _skill(self, canvas: Canvas, lines: Sequence[str], place: "Place", influence: float) -> None:
        """Draw a box with the lines of a name, and below them the influence."""
        line_pixels = self._size + LINE_GAP_PIXELS
        rim = mixed(NIGHT.dark, NIGHT.glow, influence)
        self._box(canvas, place, mixed(NIGHT.floor, NIGHT.glow, 0.22 * influence), rim)
        number = mixed(NIGHT.rock_edge, NIGHT.glow, influence)
        ink = mixed(NIGHT.faint, NIGHT.ink, 4 * influence)
        low = place.y - line_pixels * len(lines) / 2 + self._size / 2
        for text, colour in (*((line, ink) for line in lines), (f"{influence:.2f}", number)):
            canvas.text(place.x, low, text, self._size, colour, align="centre")
            low += line_pixels

    def _gauge(self, canvas: Canvas, name: str, place: "Place", value: float, middle: float) -> None:
        """Draw a bar from `middle` to the value."""
        self._box(canvas, place, NIGHT.floor, NIGHT.rock)
        left, width = place.x - 0.42 * place.width, 0.84 * place.width
        below = place.y + place.height / 4
        canvas.text(left, place.y - 2, name, self._size, NIGHT.ink)
        canvas.text(left + width, place.y - 2, f"{value:.2f}", self._size, NIGHT.faint, align="right")
        canvas.line([(left, below), (left + width, below)], NIGHT.dark, 6.0)
        canvas.line([(left + middle * width, below), (left + value * width, below)], NIGHT.late, 6.0)
        canvas.line([(left + middle * width, below - 6), (left + middle * width, below + 6)], NIGHT.faint)

    def _box(self, canvas: Canvas, place: "Place", fill: Colour, rim: Colour) -> None:
        """Draw a box with round corners."""
        radius = min(8.0, place.width / 3, place.height / 3)
        sides = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)])
        middles = [place.x, place.y] + sides * [place.width / 2 - radius, place.height / 2 - radius]
        angles = np.linspace(0.0, np.pi / 2, 6) + np.arange(4)[:, None] * np.pi / 2
        around = middles[:, None] + radius * np.stack([np.cos(angles), np.sin(angles)], axis=2)
        outline = np.reshape(around, (-1, 2))
        canvas.polygon(outline, fill)
        canvas.line(outline, rim, 2.0, closed=True)

    def _lines_of(self, sink: Sink, place: "Place") -> list[str]:
        """The lines of text in a box: a skill's number stands below its name, any other's behind it."""
        name = self._run.graph.named(*sink)
        return broken(name, 0.84 * place.width) if sink[0] == "skill" else [f"{name}  0.00"]


def broken(name: str, room: float) -> list[str]:
    """A name in one line, or if it is too wide in two: a new one begins with a plus, behind an underscore or a capital.

    Of several places the one with the shortest lines.
    """
    behind = range(1, len(name))
    starts = [i for i in behind if name[i] == "+"] or [i for i in behind if name[i - 1] == "_" or name[i].isupper()]
    if not starts or text_width(name, MAX_TEXT_PIXELS) <= room:
        return [name]
    best = min(starts, key=lambda i: max(text_width(part, MAX_TEXT_PIXELS) for part in (name[:i], name[i:])))
    return [name[:best], name[best:]]


def box_text_size(lines: Sequence[str], place: "Place") -> float:
    """The size at which lines fit into a box, and below them one more."""
    widest = max(text_width(line, MAX_TEXT_PIXELS) for line in lines)
    high = (place.height - LINE_GAP_PIXELS * (len(lines) + 2)) / (len(lines) + 1)
    return max(MIN_TEXT_PIXELS, min(MAX_TEXT_PIXELS, MAX_TEXT_PIXELS * 0.84 * place.width / widest, high))


def _curve(stops: "Sequence[Place]") -> NDArray[np.float64]:
    """Through boxes one below the other, from the lower side of each to the upper side of the next; upright at both."""
    sway = BEND * BEND * (3 - 2 * BEND)
    parts = []
    for source, target in pairwise(stops):
        y, end = source.y + source.height / 2, target.y - target.height / 2
        parts.append(np.column_stack([source.x + (target.x - source.x) * sway, y + (end - y) * BEND]))
    return np.concatenate(parts)


@dataclass(frozen=True, slots=True)
class Place:
    """A rectangle by its middle, in pixels."""

    x: float
    y: float
    width: float
    height: float


def laid_out(links: Sequence[Link], skills: Sequence[int], room: Region) -> tuple[dict[Sink, Place], list[list[Place]]]:
    """The boxes in rows from the master down, so that few links cross, and the places that each link goes through."""
    level = _levels(links, skills)
    routes = [_route(number, link, level) for number, link in enumerate(links)]
    rows = _ordered(_rows(level, routes), routes)
    places = {sink: place for i, row in enumerate(rows) for sink, place in _spread(row, i, len(rows), room)}
    boxes = {(to, index): place for (to, index), place in places.items() if to != "link"}
    return boxes, [[places[stop] for stop in route] for route in routes]


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


def _spread(row: Sequence[Stop], level: int, levels: int, room: Region) -> Iterable[tuple[Stop, Place]]:
    """The boxes of a row side by side."""
    shares = [PASSAGE_SHARE if sink[0] == "link" else 1.0 for sink in row]
    unit, gap = room.width / sum(shares), room.height / levels
    x, y = room.left, room.low + (level + 0.5) * gap
    for sink, share in zip(row, shares, strict=True):
        width, height = min(0.88 * share * unit, MAX_BOX_WIDTH), min(BOX_SHARE * gap, MAX_BOX_HEIGHT)
        yield sink, Place(x + share * unit / 2, y, width, height)
        x += share * unit
