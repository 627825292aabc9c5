"""The hierarchy in one tick, after the paper's Figure 15: a link's middle is the command, its rim the influence."""

from collections.abc import Sequence
from itertools import pairwise
from operator import itemgetter

import numpy as np
from mindrun.engine.engine import procedure_sources
from numpy.typing import NDArray

from mindlang.pictures.canvas import Canvas, Rectangle, text_width
from mindlang.pictures.layout import Layout, Place
from mindlang.pictures.theme import NIGHT, Colour, mixed
from mindlang.run.edge_flow import Sink, edge_flows
from mindlang.run.recorded_run import RecordedRun

BEND = np.linspace(0.0, 1.0, 24)
MAX_TEXT_PIXELS, MIN_TEXT_PIXELS = 11.0, 5.0  # capitals of names, in pixels
LINE_GAP_PIXELS = 5.0  # between two lines of a box
RIM_PIXELS, CORE_PIXELS = 7.0, 2.0


class HierarchyPanel:
    """Draws the hierarchy of a run into a rectangle of a page."""

    def __init__(self, run: RecordedRun, room: Rectangle) -> None:
        self._run = run
        sources = procedure_sources(run.graph, run.setup.folder, run.setup.master)
        self._flows = edge_flows(run.setup.ready.policy, sources, run.setup.master, run)
        self._layout = Layout.of(self._flows.links, self._flows.skills, room)
        self._lines = {sink: self._lines_of(sink, place) for sink, place in self._layout.boxes.items()}
        self._size = min(fitting(self._lines[sink], place) for sink, place in self._layout.boxes.items())

    def draw(self, canvas: Canvas, tick: int) -> None:
        """The hierarchy in a tick, the first of which is 1."""
        flow = self._flows.over(range(tick - 1, tick))
        links = zip(self._layout.stops, flow.value[0].tolist(), flow.transmitted[0].tolist(), strict=True)
        for stops, command, transmitted in sorted(links, key=itemgetter(2)):  # what is bright lies on top
            self._link(canvas, stops, command, transmitted)
        for sink, place in self._layout.boxes.items():
            match sink:
                case "skill", index:
                    self._skill(canvas, self._lines[sink], place, float(self._run.influence[tick - 1, index]))
                case "actuator", index:
                    actuator, command = self._run.graph.actuators[index], float(self._run.commands[tick - 1, index])
                    self._gauge(canvas, actuator.name, place, command, actuator.kind.zero)
                case "memory", index:
                    cell = self._run.graph.memories[index]
                    self._gauge(canvas, cell.name, place, float(self._run.readings[tick - 1, cell.start]), 0.0)

    def _link(self, canvas: Canvas, stops: Sequence[Place], command: float, transmitted: float) -> None:
        line = _curve(stops)
        canvas.line(line, mixed(NIGHT.dark, NIGHT.glow, transmitted), RIM_PIXELS)
        canvas.line(line, NIGHT.page, CORE_PIXELS + 2)
        canvas.line(line, mixed(NIGHT.dark, NIGHT.glow, command), CORE_PIXELS)

    def _skill(self, canvas: Canvas, lines: Sequence[str], place: Place, influence: float) -> None:
        """A box with the lines of a name, and below them the influence."""
        line_pixels = self._size + LINE_GAP_PIXELS
        rim = mixed(NIGHT.dark, NIGHT.glow, influence)
        self._box(canvas, place, mixed(NIGHT.floor, NIGHT.glow, 0.22 * influence), rim)
        number = mixed(NIGHT.rock_edge, NIGHT.glow, influence)
        ink = mixed(NIGHT.faint, NIGHT.ink, 4 * influence)
        low = place.y - line_pixels * len(lines) / 2 + self._size / 2
        for text, colour in (*((line, ink) for line in lines), (f"{influence:.2f}", number)):
            canvas.text(place.x, low, text, self._size, colour, align="centre")
            low += line_pixels

    def _gauge(self, canvas: Canvas, name: str, place: Place, value: float, middle: float) -> None:
        """A bar from `middle` to the value."""
        self._box(canvas, place, NIGHT.floor, NIGHT.rock)
        left, width = place.x - 0.42 * place.width, 0.84 * place.width
        below = place.y + place.height / 4
        canvas.text(left, place.y - 2, name, self._size, NIGHT.ink)
        canvas.text(left + width, place.y - 2, f"{value:.2f}", self._size, NIGHT.faint, align="right")
        canvas.line([(left, below), (left + width, below)], NIGHT.dark, 6.0)
        canvas.line([(left + middle * width, below), (left + value * width, below)], NIGHT.late, 6.0)
        canvas.line([(left + middle * width, below - 6), (left + middle * width, below + 6)], NIGHT.faint)

    def _box(self, canvas: Canvas, place: Place, fill: Colour, rim: Colour) -> None:
        outline = _rounded(place, 8.0)
        canvas.polygon(outline, fill)
        canvas.line(outline, rim, 2.0, closed=True)

    def _lines_of(self, sink: Sink, place: Place) -> list[str]:
        """What has to fit into a box: a skill's number stands below its name, any other's behind it."""
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


def fitting(lines: Sequence[str], place: Place) -> float:
    """The size at which lines fit into a box, and below them one more."""
    widest = max(text_width(line, MAX_TEXT_PIXELS) for line in lines)
    high = (place.height - LINE_GAP_PIXELS * (len(lines) + 2)) / (len(lines) + 1)
    return max(MIN_TEXT_PIXELS, min(MAX_TEXT_PIXELS, MAX_TEXT_PIXELS * 0.84 * place.width / widest, high))


def _curve(stops: Sequence[Place]) -> NDArray[np.float64]:
    """Through boxes one below the other, from the lower side of each to the upper side of the next; upright at both."""
    sway = BEND * BEND * (3 - 2 * BEND)
    parts = []
    for source, target in pairwise(stops):
        y, end = source.y + source.height / 2, target.y - target.height / 2
        parts.append(np.column_stack([source.x + (target.x - source.x) * sway, y + (end - y) * BEND]))
    return np.concatenate(parts)


def _rounded(place: Place, radius: float) -> NDArray[np.float64]:
    """The outline of a box with round corners."""
    radius = min(radius, place.width / 3, place.height / 3)
    turn = np.linspace(0.0, np.pi / 2, 6)
    corners = []
    for quarter, (side, up) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        x = place.x + side * (place.width / 2 - radius)
        y = place.y + up * (place.height / 2 - radius)
        angle = turn + quarter * np.pi / 2
        corners.append(np.column_stack([x + radius * np.cos(angle), y + radius * np.sin(angle)]))
    return np.concatenate(corners)
