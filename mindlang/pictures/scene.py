"""The world of a run: floor, walls, obstacles and things."""

from collections.abc import Iterable, Sequence
from itertools import cycle

import numpy as np
from mindrun.graph.graph import Thing
from mindrun.kinds.registry import names
from mindrun.kinds.scenes.scene import SceneKind
from numpy.typing import NDArray

from mindlang.pictures.canvas import Canvas, rectangle, square
from mindlang.pictures.pose import placed
from mindlang.pictures.theme import Colour, Theme, mixed
from mindlang.run.recorded_run import RecordedRun

GRID_UNITS = 10.0
WALL_UNITS = 0.8


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


def each_thing(run: RecordedRun, theme: Theme, tick: int) -> Iterable[tuple[Thing, Colour, NDArray[np.float64]]]:
    """Every thing that has not vanished, its colour, and its place and size after a tick."""
    each = zip(run.contents, thing_colours(run.contents, theme), run.things[tick], strict=True)
    return (found for found in each if np.isfinite(found[2][0]))


def draw_zones(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """The zones as they are after a tick: below the path."""
    for thing, fill, (x, y, size) in each_thing(run, theme, tick):
        if thing.kind.is_area:
            canvas.polygon(square(x, y, size / 2), fill, 0.22)
            canvas.line(square(x, y, size / 2), fill, 1.6, closed=True)


def draw_items(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """The items, boxes and balls as they are after a tick."""
    turned = run.turned[tick][np.isfinite(run.things[tick, :, 0])]
    for (thing, fill, (x, y, size)), angle in zip(each_thing(run, theme, tick), turned, strict=True):
        edge = mixed(fill, theme.ink, 0.45)
        if thing.kind.is_round:
            canvas.disc(x, y, size / 2, fill)
            canvas.disc(x, y, size / 2, edge, width=1.2)
        elif not thing.kind.is_area:
            shape = placed(square(0.0, 0.0, size / 2), np.array([x, y, angle]))
            canvas.polygon(shape, fill)
            canvas.line(shape, edge, 1.2, closed=True)
