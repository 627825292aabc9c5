"""The world of a run: floor, walls, obstacles, things and their names, and the robot with its rays and its claw."""

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import cycle
from math import cos, sin

import numpy as np
from mindrun.graph import Thing
from mindrun.registry import names
from mindrun.scenes import SceneKind
from numpy.typing import NDArray

from mindlang.pictures.canvas import Canvas, rectangle, square, text_width
from mindlang.pictures.recorded_run import RecordedRun
from mindlang.pictures.theme import Colour, Theme, mixed

GRID_UNITS = 10.0
WALL_UNITS = 0.8
MAX_NAMED_COPIES = 6  # things of one name that each have it beside them
NAME_PIXELS = 10.0  # the capitals of a thing's name


def draw_floor(canvas: Canvas, run: RecordedRun, theme: Theme) -> None:
    """The floor with a line every ten units, the walls and the obstacles."""
    if run.task.scene.is_bounded:
        x, y = half_sides(run.task.scene)
        canvas.polygon(rectangle(0, 0, x + WALL_UNITS, y + WALL_UNITS), theme.wall)
        canvas.polygon(rectangle(0, 0, x, y), theme.floor)
    _grid(canvas, theme, run.task.scene)
    for box in run.boxes:
        canvas.line(rectangle(*box), theme.rock_edge, 2.4, closed=True)
    for box in run.boxes:
        canvas.polygon(rectangle(*box), theme.rock)


def half_sides(scene: SceneKind) -> tuple[float, float]:
    """How far its walls are from its middle, along x and y."""
    width, depth = scene.sides
    return width / 2, depth / 2


def _grid(canvas: Canvas, theme: Theme, scene: SceneKind) -> None:
    view, (height, width), (x, y) = canvas.view, canvas.image.shape[:2], half_sides(scene)
    left, right = (-x, x) if scene.is_bounded else (view.left, view.left + width / view.scale)
    low, high = (-y, y) if scene.is_bounded else (view.top - height / view.scale, view.top)
    for x in np.arange(np.floor(left / GRID_UNITS) * GRID_UNITS + GRID_UNITS, right - 1e-6, GRID_UNITS):
        canvas.line([(x, low), (x, high)], theme.grid)
    for y in np.arange(np.floor(low / GRID_UNITS) * GRID_UNITS + GRID_UNITS, high - 1e-6, GRID_UNITS):
        canvas.line([(left, y), (right, y)], theme.grid)


def thing_colours(things: Sequence[Thing], theme: Theme) -> list[Colour]:
    """A colour for each name: the one that it says (`red`, `red_bin`), else the next of its kind, round and round."""
    left = {name: cycle(colours) for name, colours in theme.things.items()}
    known: dict[str, Colour] = {}
    for thing in things:
        if thing.name not in known:
            said = next((theme.named[word] for word in thing.name.split("_") if word in theme.named), None)
            known[thing.name] = said or next(left[names()[type(thing.kind)]])
    return [known[thing.name] for thing in things]


def _each(run: RecordedRun, theme: Theme, tick: int) -> Iterable[tuple[Thing, Colour, NDArray[np.float64]]]:
    """Every thing that has not vanished, its colour, and its place and size after a tick."""
    each = zip(run.contents, thing_colours(run.contents, theme), run.things[tick], strict=True)
    return (found for found in each if np.isfinite(found[2][0]))


def draw_zones(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """The zones as they are after a tick: below the path."""
    for thing, fill, (x, y, size) in _each(run, theme, tick):
        if thing.kind.is_area:
            canvas.polygon(square(x, y, size / 2), fill, 0.22)
            canvas.line(square(x, y, size / 2), fill, 1.6, closed=True)


def draw_items(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """The items, boxes and balls as they are after a tick."""
    turned = run.turned[tick][np.isfinite(run.things[tick, :, 0])]
    for (thing, fill, (x, y, size)), angle in zip(_each(run, theme, tick), turned, strict=True):
        edge = mixed(fill, theme.ink, 0.45)
        if thing.kind.is_round:
            canvas.disc(x, y, size / 2, fill)
            canvas.disc(x, y, size / 2, edge, width=1.2)
        elif not thing.kind.is_area:
            shape = _turned_square(x, y, size / 2, angle)
            canvas.polygon(shape, fill)
            canvas.line(shape, edge, 1.2, closed=True)


def _turned_square(x: float, y: float, half: float, angle: float) -> NDArray[np.float64]:
    """The corners [4, 2] of a square that has turned about its middle."""
    turn = np.array([(cos(angle), sin(angle)), (-sin(angle), cos(angle))])
    corners: NDArray[np.float64] = np.array(square(0.0, 0.0, half)) @ turn + np.array([x, y])
    return corners


def draw_names(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """The name of each thing in sight: below it, or above it where the robot or the lower edge is.

    Of many things of one name the first alone has it.
    """
    pixel = 1 / canvas.view.scale
    (height, width), (left, top) = canvas.image.shape[:2], (canvas.view.left, canvas.view.top)
    right, low = left + width * pixel, top - height * pixel
    robot, radius = run.body[tick, :2], run.graph.body.radius
    high, gap = NAME_PIXELS * canvas.pen * pixel, 4 * canvas.pen * pixel
    many = Counter(thing.name for thing in run.contents)
    named: set[str] = set()
    for thing, _, (x, y, size) in _each(run, theme, tick):
        if not (left < x < right and low < y < top) or (thing.name in named and many[thing.name] > MAX_NAMED_COPIES):
            continue
        named.add(thing.name)
        half = text_width(thing.name, NAME_PIXELS * canvas.pen) * pixel / 2
        middle = min(max(x, left + half), right - half)
        line = y - size / 2 - gap - high
        is_covered = abs(robot[0] - middle) < half + radius and abs(robot[1] - line - high / 2) < high / 2 + radius
        if is_covered or line < low + gap:
            line = y + size / 2 + gap
        canvas.text(middle, line, thing.name, NAME_PIXELS, theme.ink, align="centre", halo=theme.floor)
