"""What 0, 0.5 and 1 look like: three robots side by side, each below its mark."""

from collections.abc import Callable, Iterator
from functools import partial
from math import cos, pi, sin
from textwrap import wrap

from docs.reference import svg
from docs.reference.around import robot
from mindlang.explaining.article import Article

PANEL_PIXELS, HEIGHT_PIXELS = 170, 190
CAPTION_CHARACTERS = 27
ROBOT_Y, RADIUS_PIXELS = 92.0, 24.0
ARROW_PIXELS = 44.0  # of full force or speed

Shapes = Iterator[str]
Drawn = Callable[[svg.Point, float], Shapes]


def marks(article: Article, drawn: Drawn) -> str:
    """A panel for each mark, with what it means of a reading or a command."""
    shapes: list[str] = []
    for number, (mark, meaning) in enumerate(article.scale.items()):
        x = PANEL_PIXELS * (number + 0.5)
        shapes += [svg.words((x, 22), mark, "middle", size=14, bold=True), *drawn((x, ROBOT_Y), float(mark))]
        for row, text in enumerate(wrap(meaning.replace("`", ""), CAPTION_CHARACTERS)):
            shapes.append(svg.words((x, HEIGHT_PIXELS - 34 + 13 * row), text, "middle", svg.FAINT, 10.5))
    return svg.document(3 * PANEL_PIXELS, HEIGHT_PIXELS, shapes, f"{article.name}: what 0, 0.5 and 1 are")


def pushed(at: svg.Point, value: float, aside: float = 0.0) -> Shapes:
    """A force or a speed along the heading, so far to the left of the middle, by a wheel if not there."""
    yield from robot(at, RADIUS_PIXELS)
    x = at[0] - aside * RADIUS_PIXELS
    if aside:
        yield svg.rectangle(x - 4, at[1] - 9, 8, 18, svg.INK)
    yield from _arrow((x, at[1]), (2 * value - 1) * ARROW_PIXELS)


wheel = partial(pushed, aside=1.0)


def turned(at: svg.Point, value: float) -> Shapes:
    """A turn to the left or right."""
    yield from robot(at, RADIUS_PIXELS)
    if way := round(2 * value - 1):
        angles = [pi / 180 * degrees for degrees in range(-40, 61, 10)]
        points = [(at[0] + way * 36 * sin(angle), at[1] - 36 * cos(angle)) for angle in angles]
        yield svg.path(points, svg.RED, 3)
        yield _head(points[-1], (points[-1][0] - points[-2][0], points[-1][1] - points[-2][1]))


def steered(at: svg.Point, value: float) -> Shapes:
    """The wheels of a car."""
    yield _car(at)
    angle = (2 * value - 1) * pi / 6
    ahead = (sin(angle) * 10, -cos(angle) * 10)
    for x in (at[0] - 17, at[0] + 17):
        yield svg.line((x, at[1] + 13), (x, at[1] + 31), svg.INK, 6)
        yield svg.line((x - ahead[0], at[1] - 22 - ahead[1]), (x + ahead[0], at[1] - 22 + ahead[1]), svg.RED, 6)


def driven(at: svg.Point, value: float) -> Shapes:
    """A car that goes ahead or back."""
    yield _car(at)
    yield from _arrow(at, (2 * value - 1) * ARROW_PIXELS)


def thrust(at: svg.Point, value: float) -> Shapes:
    """A force at the front to the left or right."""
    yield from robot(at, RADIUS_PIXELS)
    x, y = at[0], at[1] - RADIUS_PIXELS
    yield svg.circle((x, y), 4, svg.RED, width=0)
    if way := round(1 - 2 * value):
        yield svg.line((x, y), (x + way * ARROW_PIXELS, y), svg.RED, 3)
        yield _head((x + way * ARROW_PIXELS, y), (way, 0))


def gripped(at: svg.Point, value: float) -> Shapes:
    """A claw that is open, or closed around an item."""
    yield from robot(at, RADIUS_PIXELS)
    x, y = at[0], at[1] - RADIUS_PIXELS
    is_closed = value > 0.5
    yield svg.circle((x, y - (10 if is_closed else 26)), 8, svg.ORANGE, width=0)
    for side in (-1, 1):
        tip = 5 if is_closed else 16
        yield svg.path([(x + side * 7, y + 1), (x + side * 13, y - 9), (x + side * tip, y - 21)], svg.INK, 3)


def lit(at: svg.Point, value: float) -> Shapes:
    """A lamp, with rays as long as it is bright."""
    yield from robot(at, RADIUS_PIXELS)
    for degrees in range(0, 360, 45) if value else ():
        way = (cos(degrees * pi / 180), sin(degrees * pi / 180))
        begin, end = ((at[0] + far * way[0], at[1] + far * way[1]) for far in (12, 12 + 28 * value))
        yield svg.line(begin, end, svg.ORANGE, 3)
    yield svg.circle(at, 8, svg.ORANGE if value else svg.PANEL, svg.INK)


def swung(at: svg.Point, value: float) -> Shapes:
    """The arm of a servo, which goes half a turn."""
    yield svg.rectangle(at[0] - 13, at[1] - 9, 26, 40, svg.PANEL, svg.INK)
    angle = pi * (value - 0.5)
    end = (at[0] + 40 * sin(angle), at[1] - 40 * cos(angle))
    yield svg.line(at, end, svg.RED, 6)
    yield svg.circle(at, 6, svg.PAPER, svg.INK)


def away(at: svg.Point, value: float) -> Shapes:
    """A thing, the farther away the larger the value."""
    x, y = at[0] - 46, at[1]
    yield from robot((x, y), 16)
    far = 66 * value
    yield svg.line((x + 16, y + 26), (x + 16 + far, y + 26), svg.RED, 2)
    yield svg.circle((x + 16 + far + 12, y), 12, svg.ORANGE, width=0)


def _car(at: svg.Point) -> str:
    return svg.rectangle(at[0] - 16, at[1] - 34, 32, 68, svg.PANEL, svg.INK, 6)


def _arrow(at: svg.Point, length: float) -> Shapes:
    """An arrow up, or down; a dot where it has no length."""
    end = (at[0], at[1] - length)
    yield svg.line(at, end, svg.RED, 3)
    yield _head(end, (0.0, -length)) if length else svg.circle(at, 4, svg.RED, width=0)


def _head(at: svg.Point, way: svg.Point) -> str:
    """The head of an arrow."""
    size = (way[0] ** 2 + way[1] ** 2) ** 0.5
    x, y = way[0] / size, way[1] / size
    back = (at[0] - 4 * x, at[1] - 4 * y)
    points = [(back[0] - 5 * y, back[1] + 5 * x), (at[0] + 6 * x, at[1] + 6 * y), (back[0] + 5 * y, back[1] - 5 * x)]
    return svg.path(points, svg.RED, 1, svg.RED)
