"""The world of a run: floor, walls, obstacles and things, each with its name beside it and none over another."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import cycle
from math import cos, sin
from typing import NamedTuple

import numpy as np
from mindrun.graph.graph import Thing
from mindrun.kinds.registry import names
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.sim.task_rows import opened_boxes
from numpy.typing import ArrayLike, NDArray

from mindlang.pictures.canvas import Canvas, Region, Viewport, blank, rectangle_corners, text_width
from mindlang.pictures.theme import Colour, Theme, mixed
from mindlang.run.recorded_run import RecordedRun

Floats = NDArray[np.float64]
GRID_UNITS = 10.0
WALL_UNITS = 0.8
MAX_NAMED_COPIES = 6  # things of one name that each have it beside them
NAME_PIXELS = 10.0  # the capitals of a thing's name
GAP_PIXELS = 4.0  # between a thing and its name
MAX_LINES_AWAY = 8  # how far a name gives way to others


def to_world(points: ArrayLike, pose: Floats) -> Floats:
    """Points [n, 2] of a body in the world, where it stands at x, y and is turned by an angle."""
    x, y, angle = pose
    turned = np.asarray(points, float) @ np.array([(cos(angle), sin(angle)), (-sin(angle), cos(angle))])
    there: Floats = turned + np.array([x, y])
    return there


def empty_world(run: RecordedRun, theme: Theme, view: Viewport, width: int, height: int, pen: float = 1.0) -> Canvas:
    """An image of the floor with a line every ten units, the walls and the obstacles; of what opens the rim alone."""
    canvas = Canvas(blank(width, height, theme.page if run.task.scene.is_bounded else theme.floor), view, pen)
    left, right, low, high = view.left, view.left + width / view.scale, view.top - height / view.scale, view.top
    if run.task.scene.is_bounded:
        right, high = half_sides(run.task.scene)
        left, low = -right, -high
        canvas.polygon(rectangle_corners(0, 0, right + WALL_UNITS, high + WALL_UNITS), theme.wall)
        canvas.polygon(rectangle_corners(0, 0, right, high), theme.floor)
    for x in _grid(left, right):
        canvas.line([(x, low), (x, high)], theme.grid)
    for y in _grid(low, high):
        canvas.line([(left, y), (right, y)], theme.grid)
    for box in run.standing.values():
        canvas.line(rectangle_corners(*box), theme.rock_edge, 2.4, closed=True)
    opened = opened_boxes(run.task)
    for number, box in run.standing.items():
        canvas.polygon(rectangle_corners(*box), theme.floor if number in opened else theme.rock)
    return canvas


def _grid(first: float, last: float) -> Floats:
    return np.arange((np.floor(first / GRID_UNITS) + 1) * GRID_UNITS, last - 1e-6, GRID_UNITS)


def half_sides(scene: SceneKind) -> tuple[float, float]:
    width, depth = scene.sides
    return width / 2, depth / 2


def thing_colours(things: Sequence[Thing], theme: Theme) -> list[Colour]:
    """A colour for each name: the one that it says (`red`, `red_bin`), else the next of its kind, round and round."""
    left = {name: cycle(colours) for name, colours in theme.things.items()}
    known: dict[str, Colour] = {}
    for thing in things:
        if thing.name not in known:
            said = next((theme.named[word] for word in thing.name.split("_") if word in theme.named), None)
            known[thing.name] = said or next(left[names()[type(thing.kind)]])
    return [known[thing.name] for thing in things]


def each_thing(run: RecordedRun, theme: Theme, tick: int) -> Iterable[tuple[Thing, Colour, Floats]]:
    """Every thing that has not vanished, its colour, and its place and size after a tick."""
    each = zip(run.contents, thing_colours(run.contents, theme), run.things[tick], strict=True)
    return (found for found in each if np.isfinite(found[2][0]))


def draw_zones(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """Draw the zones as they are after a tick: below the path."""
    for thing, fill, (x, y, size) in each_thing(run, theme, tick):
        if thing.kind.is_area:
            corners = rectangle_corners(x, y, size / 2, size / 2)
            canvas.polygon(corners, fill, 0.22)
            canvas.line(corners, fill, 1.6, closed=True)


def draw_items(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """Draw the items, boxes and balls as they are after a tick."""
    turned = run.turned[tick][np.isfinite(run.things[tick, :, 0])]
    for (thing, fill, (x, y, size)), angle in zip(each_thing(run, theme, tick), turned, strict=True):
        edge = mixed(fill, theme.ink, 0.45)
        if thing.kind.is_round:
            canvas.disc(x, y, size / 2, fill)
            canvas.disc(x, y, size / 2, edge, width=1.2)
        elif not thing.kind.is_area:
            shape = to_world(rectangle_corners(0.0, 0.0, size / 2, size / 2), np.array([x, y, angle]))
            canvas.polygon(shape, fill)
            canvas.line(shape, edge, 1.2, closed=True)


class SceneLabel(NamedTuple):
    """Words with capitals of so many `pixels`, and the place and size of what they are about."""

    words: str
    pixels: float
    colour: Colour
    x: float
    y: float
    size: float


def draw_names(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int, ending: SceneLabel | None = None) -> None:
    """Draw the name of each thing in sight: below it, or where neither the robot nor a thing nor another name is.

    Of many things of one name the first alone has it. Words about the robot, how its run ended, stand beside it.
    """
    pixel = 1 / canvas.view.scale
    (height, width), (left, top) = canvas.image.shape[:2], (canvas.view.left, canvas.view.top)
    sight = Region(left, top - height * pixel, width * pixel, height * pixel)
    gap = GAP_PIXELS * canvas.pixel
    (x, y, _), radius = run.body[tick], run.graph.body.radius
    each = list(each_thing(run, theme, tick))
    squares = [np.array((x, y, 2 * radius)), *(place for thing, _, place in each if not thing.kind.is_area)]
    taken = [Region(x - side / 2, y - side / 2, side, side) for x, y, side in squares]
    many = Counter(thing.name for thing in run.contents)
    said: dict[int | str | None, SceneLabel] = {None: ending} if ending else {}
    for number, (thing, _, there) in enumerate(each):
        if Region(there[0], there[1], 0.0, 0.0).is_within(sight):
            key: int | str = number if many[thing.name] <= MAX_NAMED_COPIES else thing.name
            said.setdefault(key, SceneLabel(thing.name, NAME_PIXELS, theme.ink, *there))
    for text in said.values():
        high, wide = text.pixels * canvas.pixel, text_width(text.words, text.pixels * canvas.pen) * pixel
        middle = min(max(text.x, left + wide / 2), left + width * pixel - wide / 2)
        below = Region(middle - wide / 2, text.y - text.size / 2 - gap - high, wide, high)
        place = free(_places(below, text, gap), taken, sight)
        taken.append(place._replace(low=place.low - gap / 2, height=high + gap))
        canvas.text(place.left, place.low, text.words, text.pixels, text.colour, halo=theme.floor)


def _places(below: Region, text: SceneLabel, gap: float) -> Iterator[Region]:
    above = below._replace(low=text.y + text.size / 2 + gap)
    yield from (below, above)
    level = below._replace(low=text.y - below.height / 2)
    aside = text.size / 2 + gap
    yield from (level._replace(left=text.x + aside), level._replace(left=text.x - aside - below.width))
    for line in range(1, MAX_LINES_AWAY):
        away = line * (below.height + gap)
        yield from (below._replace(low=below.low - away), above._replace(low=above.low + away))


def free(places: Iterable[Region], taken: Iterable[Region], sight: Region) -> Region:
    """The first of the places that is in sight and free; the very first, where none is."""
    choices, occupied = list(places), list(taken)
    for place in choices:
        if place.is_within(sight) and not any(place.overlaps(other) for other in occupied):
            return place
    return choices[0]
