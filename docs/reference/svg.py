"""SVG as text: the few shapes that the drawings are made of, with coordinates to a tenth of a pixel."""

from collections.abc import Iterable
from html import escape

INK, FAINT, PAPER, PANEL = "#23272f", "#666c78", "#fdfcf9", "#f1eee6"
RED, BLUE, GREEN, ORANGE, PURPLE = "#c0392b", "#2b6cb0", "#2f855a", "#b7791f", "#6b46c1"
ROCK = "#c3c7cf"
Point = tuple[float, float]


def document(width: float, height: float, shapes: Iterable[str], title: str) -> str:
    """A picture with a name for those who cannot see it."""
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_f(width)} {_f(height)}" width="{_f(width)}" '
    head += 'role="img" font-family="sans-serif" font-size="12">\n'
    body = "\n".join([rectangle(0, 0, width, height, PAPER, rounded=8), *shapes])
    return f"{head}<title>{escape(title)}</title>\n{body}\n</svg>\n"


def line(a: Point, b: Point, colour: str = INK, width: float = 1.5, dashed: bool = False) -> str:
    """A straight line."""
    return f'<path d="M{_p(a)} L{_p(b)}"{_stroke(colour, width, dashed)}/>'


def path(points: Iterable[Point], colour: str = INK, width: float = 1.5, fill: str = "none") -> str:
    """A line through points."""
    return f'<path d="M{" L".join(map(_p, points))}"{_stroke(colour, width, fill=fill)}/>'


def bow(a: Point, b: Point, colour: str, width: float = 2) -> str:
    """A line that leaves one point to the right and comes to another from the left."""
    middle = (a[0] + b[0]) / 2
    return f'<path d="M{_p(a)} C{_p((middle, a[1]))} {_p((middle, b[1]))} {_p(b)}"{_stroke(colour, width)}/>'


def circle(at: Point, radius: float, fill: str = "none", colour: str = INK, width: float = 1.5) -> str:
    """A disc, or a ring."""
    around = f' stroke="{colour}" stroke-width="{_f(width)}"' if width else ""
    return f'<circle cx="{_f(at[0])}" cy="{_f(at[1])}" r="{_f(radius)}" fill="{fill}"{around}/>'


def rectangle(x: float, y: float, width: float, height: float, fill: str, colour: str = "", rounded: float = 3) -> str:
    """A rectangle."""
    around = f' stroke="{colour}"' if colour else ""
    size = f'width="{_f(width)}" height="{_f(height)}"'
    return f'<rect x="{_f(x)}" y="{_f(y)}" {size} rx="{_f(rounded)}" fill="{fill}"{around}/>'


def words(at: Point, text: str, anchor: str = "start", colour: str = INK, size: float = 12, bold: bool = False) -> str:
    """A line of text, legible above what is below it."""
    weight = ' font-weight="bold"' if bold else ""
    halo = f' stroke="{PAPER}" stroke-width="3" paint-order="stroke"'
    at_ = f'x="{_f(at[0])}" y="{_f(at[1])}" text-anchor="{anchor}" fill="{colour}" font-size="{_f(size)}"'
    return f"<text {at_}{weight}{halo}>{escape(text)}</text>"


def _stroke(colour: str, width: float, dashed: bool = False, fill: str = "none") -> str:
    dashes = ' stroke-dasharray="4 3"' if dashed else ""
    return f' fill="{fill}" stroke="{colour}" stroke-width="{_f(width)}"{dashes}'


def _p(point: Point) -> str:
    return f"{_f(point[0])} {_f(point[1])}"


def _f(number: float) -> str:
    return f"{round(number, 1) + 0.0:g}"
