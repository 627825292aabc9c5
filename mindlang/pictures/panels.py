"""Panels of a film: the hierarchy in one tick, after the paper's Figure 15, and what its sensors read.

A link's middle is the command, its rim the influence. Beside the name of a sensor stands a bar and its number, or a
small bar for each reading.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from operator import itemgetter
from statistics import fmean
from typing import Literal

import numpy as np
from mindrun.graph.graph import Sensor
from mindrun.graph.weights import reachable
from numpy.typing import NDArray

from mindlang.pictures.canvas import Canvas, Region, text_width
from mindlang.pictures.theme import NIGHT, Colour, mixed
from mindlang.run.edge_flow import Link, Sink
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
        self._flows = run.setup.flows(run)
        self._boxes, self._stops = laid_out(self._flows.links, self._flows.skills, room)
        # A skill's number stands below its name, any other's behind it.
        names = {sink: run.graph.named(*sink) for sink in self._boxes}
        self._lines = {
            sink: broken(names[sink], 0.84 * place.width) if sink[0] == "skill" else [f"{names[sink]}  0.00"]
            for sink, place in self._boxes.items()
        }
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
        radius = min(8.0, place.width / 3, place.height / 3)
        sides = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)])
        middles = [place.x, place.y] + sides * [place.width / 2 - radius, place.height / 2 - radius]
        angles = np.linspace(0.0, np.pi / 2, 6) + np.arange(4)[:, None] * np.pi / 2
        around = middles[:, None] + radius * np.stack([np.cos(angles), np.sin(angles)], axis=2)
        outline = np.reshape(around, (-1, 2))
        canvas.polygon(outline, fill)
        canvas.line(outline, rim, 2.0, closed=True)


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
    routes: list[list[Stop]] = []
    for number, link in enumerate(links):  # from box to box, with a stop in each row that it passes
        passed = range(level["skill", link.source] + 1, level[link.target])
        stops: dict[Stop, int] = {("link", number * 1000 + row): row for row in passed}
        routes.append([("skill", link.source), *stops, link.target])
        level |= stops
    rows = [[stop for stop, at in level.items() if at == row] for row in range(max(level.values()) + 1)]
    rows = _ordered(rows, routes)
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
    shares = [PASSAGE_SHARE if sink[0] == "link" else 1.0 for sink in row]
    unit, gap = room.width / sum(shares), room.height / levels
    x, y = room.left, room.low + (level + 0.5) * gap
    for sink, share in zip(row, shares, strict=True):
        width, height = min(0.88 * share * unit, MAX_BOX_WIDTH), min(BOX_SHARE * gap, MAX_BOX_HEIGHT)
        yield sink, Place(x + share * unit / 2, y, width, height)
        x += share * unit


READING_PIXELS, MIN_READING_PIXELS = 9.0, 6.5  # capitals
ROW_PIXELS, COLUMN_PIXELS = 20.0, 250.0  # of a sensor's readings
INDENT_PIXELS = 10.0  # on both sides of a cell
NAME_SHARE, NUMBER_SHARE = 0.54, 0.14  # of a cell: what its name and its number have
BAR_PIXELS, MANY_BARS_PIXELS = 5.0, 13.0  # the height of a bar, and of each among many
LEAST_BAR_PIXELS = 3.0  # the width of one bar among many: where there are more, some are left out


def sensors_read(run: RecordedRun) -> list[Sensor]:
    """The sensors that the master, or a skill that it can influence, reads; no other one is measured."""
    read = {index for skill in reachable(run.graph, run.setup.master) for index in skill.inputs}
    return [s for s in run.graph.sensors if not read.isdisjoint(range(s.start, s.start + s.width))]


class ReadingsPanel:
    """Draws the readings of a run into a rectangle of a canvas, as many sensors as fit."""

    def __init__(self, run: RecordedRun, room: Region) -> None:
        self._run = run
        self._sensors, self._cells, self._left_out = cell_layout(sensors_read(run), room)

    def draw_names(self, canvas: Canvas) -> None:
        """Draw what no tick changes: the names, and how many sensors are not shown."""
        names = [sensor.name for sensor in self._sensors]
        names += [f"and {self._left_out} more"] * (self._left_out > 0)
        for name, cell in zip(names, self._cells, strict=False):
            text, size = fit_name(name, NAME_SHARE * cell.width - 8)
            canvas.text(cell.left, cell.low + size / 2, text, size, NIGHT.faint)

    def draw(self, canvas: Canvas, tick: int) -> None:
        """Draw the readings in a tick, the first of which is 1."""
        for sensor, cell in zip(self._sensors, self._cells, strict=False):
            values = self._run.readings[tick - 1, sensor.place].astype(float)
            left, right = cell.left + NAME_SHARE * cell.width, cell.left + cell.width
            if len(values) == 1:
                self._number(canvas, float(values[0]), left, right - NUMBER_SHARE * cell.width, right, cell.low)
            else:
                self._many(canvas, values, left, right, cell.low)

    def _number(self, canvas: Canvas, value: float, left: float, end: float, right: float, y: float) -> None:
        share = _shares(np.array([value]))[0]
        canvas.line([(left, y), (end, y)], NIGHT.dark, BAR_PIXELS)
        if share > 0:
            canvas.line([(left, y), (left + share * (end - left), y)], NIGHT.ray, BAR_PIXELS)
        canvas.text(right, y + READING_PIXELS / 2, f"{value:.2f}", READING_PIXELS, NIGHT.ink, align="right")

    def _many(self, canvas: Canvas, values: NDArray[np.float64], left: float, right: float, y: float) -> None:
        """Draw bars of readings side by side; where there are too many, of some at equal distances."""
        low = y + MANY_BARS_PIXELS / 2
        count = min(len(values), int((right - left) // LEAST_BAR_PIXELS))
        shown = _shares(values)[np.linspace(0, len(values) - 1, count).astype(int)]
        wide = (right - left) / count
        for number, share in enumerate(shown):
            begin, end = left + number * wide, left + (number + 1) * wide - 1
            for high, colour in ((1.0, NIGHT.dark), (float(share), NIGHT.ray)):
                top = low - high * MANY_BARS_PIXELS
                if high > 0:
                    canvas.polygon([(begin, low), (end, low), (end, top), (begin, top)], colour)


def cell_layout(sensors: Sequence[Sensor], room: Region) -> tuple[Sequence[Sensor], list[Region], int]:
    """The sensors that are shown in a room, the cells column by column, and how many are left out: the last says that.

    A cell is given by its left end and its middle row.
    """
    columns = max(1, int(room.width // COLUMN_PIXELS))
    rows = min(int(room.height // ROW_PIXELS), -(-len(sensors) // columns))
    wide, cells = room.width / columns, []
    for number in range(min(len(sensors), rows * columns)):
        column, row = divmod(number, rows)
        left = room.left + column * wide + INDENT_PIXELS
        cells.append(Region(left, room.low + (row + 0.5) * ROW_PIXELS, wide - 2 * INDENT_PIXELS, ROW_PIXELS))
    shown = len(cells) if len(sensors) <= len(cells) else max(0, len(cells) - 1)
    return sensors[:shown], cells, len(sensors) - shown


def fit_name(name: str, room: float) -> tuple[str, float]:
    """A name and its size such that it is not wider than so many pixels: smaller, and if that is not enough, cut."""
    size = READING_PIXELS
    while size > MIN_READING_PIXELS and text_width(name, size) > room:
        size -= 0.5
    text = name
    while len(text) > 1 and text_width(text, size) > room:
        name = name[:-1]
        text = f"{name}.."
    return text, size


def _shares(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Readings as the lengths of bars, 0 to 1; what is not a finite number has none."""
    return np.clip(np.where(np.isfinite(values), values, 0.0), 0.0, 1.0)
