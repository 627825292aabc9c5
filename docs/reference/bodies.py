"""Bodies from above, facing up, with their sizes and where what drives them acts: what holds where nothing is said."""

from collections.abc import Iterator
from math import cos, pi, sin

from docs.reference import svg
from docs.reference.around import robot

WIDTH_PIXELS, HEIGHT_PIXELS = 300, 220
MIDDLE_PIXELS = (130.0, 104.0)
UNIT_PIXELS = 48.0
WHEEL_PIXELS = (8, 30)
STEERED_RADIANS = pi / 8

Shapes = Iterator[str]


def disc(title: str, size: float) -> str:
    """A wheel on the rim at each side."""
    radius = size / 2 * UNIT_PIXELS
    x, y = MIDDLE_PIXELS
    wheels = [_wheel((x + side * radius, y)) for side in (-1, 1)]
    return _document(title, [*robot(MIDDLE_PIXELS, radius), *wheels, *_across(size, size)])


def holonomic(title: str, size: float) -> str:
    """Pushed ahead, aside, and at the front, which turns it."""
    radius = size / 2 * UNIT_PIXELS
    x, y = MIDDLE_PIXELS
    pushes = [*_push((x, y), (0, -1)), *_push((x, y), (-1, 0)), *_push((x, y - radius), (-1, 0))]
    return _document(title, [svg.circle(MIDDLE_PIXELS, radius, svg.PANEL, svg.INK, 1.5), *pushes, *_across(size, size)])


def box(title: str, size: tuple[float, float]) -> str:
    """A wheel at the middle of each long side."""
    x, y = MIDDLE_PIXELS
    wheels = [_wheel((x + side * size[1] / 2 * UNIT_PIXELS, y)) for side in (-1, 1)]
    return _document(title, [*_hull(*size), *wheels, *_across(size[1], size[0]), *_along(size[0], size[1])])


def car(title: str, size: tuple[float, float], wheelbase: float) -> str:
    """Two axles, of which the front one steers."""
    x, y = MIDDLE_PIXELS
    apart, aside = size[0] * wheelbase * UNIT_PIXELS, (size[1] / 2 - 0.2) * UNIT_PIXELS
    front, rear = y - apart / 2, y + apart / 2
    shapes = [*_hull(*size), *(svg.line((x - aside, each), (x + aside, each), svg.FAINT, 2) for each in (front, rear))]
    shapes += [_wheel((x + side * aside, rear)) for side in (-1, 1)]
    shapes += [_wheel((x + side * aside, front), STEERED_RADIANS, svg.RED) for side in (-1, 1)]
    shapes += _measure((x, front), (x, rear), f"{wheelbase:.0%}", (6.0, 4.0))
    return _document(title, [*shapes, *_across(size[1], size[0]), *_along(size[0], size[1])])


def _hull(length: float, width: float) -> Shapes:
    """A rectangle, and which of its sides is ahead."""
    x, y = MIDDLE_PIXELS
    wide, long = width * UNIT_PIXELS, length * UNIT_PIXELS
    yield svg.rectangle(x - wide / 2, y - long / 2, wide, long, svg.PANEL, svg.INK, 2)
    tip = y - long / 2
    yield svg.path([(x - 7, tip + 14), (x, tip + 5), (x + 7, tip + 14)], svg.INK, 2)


def _wheel(at: svg.Point, turn: float = 0.0, colour: str = svg.INK) -> str:
    """A wheel from above, turned to the left."""
    wide, long = WHEEL_PIXELS
    ahead = (-sin(turn) * long / 2, -cos(turn) * long / 2)
    return svg.line((at[0] - ahead[0], at[1] - ahead[1]), (at[0] + ahead[0], at[1] + ahead[1]), colour, wide)


def _push(at: svg.Point, way: svg.Point) -> Shapes:
    """A force, from where it acts."""
    x, y = at
    end = (x + way[0] * 34, y + way[1] * 34)
    yield svg.circle(at, 4, svg.RED, width=0)
    yield svg.line(at, end, svg.RED, 3)
    side = (way[1] * 5, way[0] * 5)
    tip = (end[0] + way[0] * 8, end[1] + way[1] * 8)
    yield svg.path(
        [(end[0] - side[0], end[1] - side[1]), tip, (end[0] + side[0], end[1] + side[1])], svg.RED, 1, svg.RED
    )


def _across(width: float, length: float) -> Shapes:
    """The measure of its width, below it."""
    x, y = MIDDLE_PIXELS
    half, below = width / 2 * UNIT_PIXELS, y + length / 2 * UNIT_PIXELS + 16
    yield from _measure((x - half, below), (x + half, below), f"{width:g}", (-4.0, 16.0))


def _along(length: float, width: float) -> Shapes:
    """The measure of its length, to the right of it."""
    x, y = MIDDLE_PIXELS
    half, right = length / 2 * UNIT_PIXELS, x + width / 2 * UNIT_PIXELS + 22
    yield from _measure((right, y - half), (right, y + half), f"{length:g}", (8.0, 4.0))


def _measure(begin: svg.Point, end: svg.Point, text: str, beside: svg.Point) -> Shapes:
    """A distance, and its figure so far from the middle of the line."""
    yield svg.line(begin, end, svg.BLUE, 1)
    across = (4.0, 0.0) if begin[0] == end[0] else (0.0, 4.0)
    for x, y in (begin, end):
        yield svg.line((x - across[0], y - across[1]), (x + across[0], y + across[1]), svg.BLUE, 1)
    at = ((begin[0] + end[0]) / 2 + beside[0], (begin[1] + end[1]) / 2 + beside[1])
    yield svg.words(at, text, colour=svg.BLUE, bold=True)


def _document(title: str, shapes: list[str]) -> str:
    return svg.document(WIDTH_PIXELS, HEIGHT_PIXELS, shapes, title)
