"""What a sensor measures around the robot, seen from above: the robot in the middle, facing up."""

from collections.abc import Iterator, Sequence
from math import cos, hypot, inf, pi, sin, sqrt

from mindrun.numbers.arithmetic import F, bearing

from docs.reference import svg

WIDTH_PIXELS, HEIGHT_PIXELS = 420, 280
MIDDLE_PIXELS = (210.0, 170.0)
RIM_UNITS = 1.0  # of a disc of size 2
RAYS_PIXELS, DIAL_PIXELS = 130.0, 105.0  # from the middle
DIAL_DEGREES = 45
Rock = tuple[float, float, float]  # how far ahead and to the left, and its radius
LINE_COLOUR = "#4a4f5a"


def rays(title: str, at: Sequence[float], reach: float, rocks: Sequence[Rock], colour: str) -> str:
    """A ray in each direction, up to what it meets or as far as it looks, with its reading."""
    scale = RAYS_PIXELS / (reach + RIM_UNITS)
    shapes = [svg.circle(_place(x, y, scale), radius * scale, colour, width=0) for x, y, radius in rocks]
    for angle in at:
        far = min(reach, *(_meets(angle, rock) - RIM_UNITS for rock in rocks))
        begin, end = (_along(angle, RIM_UNITS + away, scale) for away in (0.0, far))
        label = _along(angle, RIM_UNITS + far + 18 / scale, scale)
        shapes.append(svg.line(begin, end, svg.RED if far < reach else svg.BLUE, 1.5, dashed=far == reach))
        shapes.append(svg.words((label[0], label[1] + 4), f"{far / reach:.2g}", "middle", size=11, bold=True))
    return svg.document(WIDTH_PIXELS, MIDDLE_PIXELS[1] + 30, [*shapes, *robot(MIDDLE_PIXELS, RIM_UNITS * scale)], title)


def dial(title: str, remark: str) -> str:
    """What a bearing reads of something in each direction."""
    shapes = [svg.circle(MIDDLE_PIXELS, DIAL_PIXELS, colour=svg.FAINT, width=1), svg.words((10, 20), remark, size=11)]
    for degrees in range(-180 + DIAL_DEGREES, 180, DIAL_DEGREES):
        angle = degrees * pi / 180
        at, label = (_along(angle, away, 1.0) for away in (DIAL_PIXELS, DIAL_PIXELS + 24))
        value = float(bearing(F(cos(angle)), F(sin(angle))))
        shapes.append(svg.circle(at, 5, svg.ORANGE, svg.PAPER))
        shapes.append(svg.words((label[0], label[1] + 4), f"{value:.3g}", "middle", size=11, bold=degrees == 0))
    x, y = _along(pi, DIAL_PIXELS, 1.0)
    shapes.append(svg.line((x, y - 14), (x, HEIGHT_PIXELS), svg.FAINT, 1, dashed=True))
    for side, anchor, mark in ((8, "start", "0"), (-8, "end", "1")):
        shapes.append(svg.words((x - side, y - 8), mark, "end" if anchor == "start" else "start", size=11))
    return svg.document(WIDTH_PIXELS, HEIGHT_PIXELS, [*shapes, *robot(MIDDLE_PIXELS, 20)], title)


def sectors(title: str, at: Sequence[float], width: float, touched: int) -> str:
    """The parts of a rim that feel a touch, one of them touched by a wall."""
    shapes = []
    for number, angle in enumerate(at):
        is_touched = number == touched
        points = [_along(angle + width * 0.92 * (step / 12 - 0.5), 62.0, 1.0) for step in range(13)]
        label = _along(angle, 44.0, 1.0)
        shapes.append(svg.path(points, svg.RED if is_touched else svg.FAINT, 6))
        shapes.append(svg.words((label[0], label[1] + 4), f"{is_touched:d}", "middle", bold=True))
    x, y = _along(at[touched], 69.0, 1.0)
    aside = (80 * cos(at[touched]), 80 * sin(at[touched]))
    wall = svg.line((x - aside[0], y + aside[1]), (x + aside[0], y - aside[1]), svg.FAINT, 6)
    return svg.document(WIDTH_PIXELS, HEIGHT_PIXELS, [*robot(MIDDLE_PIXELS, 59), wall, *shapes], title)


def spots(title: str, at: Sequence[float], ahead: float) -> str:
    """Sensors that look down on a bar ahead of the robot, the leftmost of them above a line."""
    scale = 46.0
    x = _place(ahead, max(at), scale)[0]
    shapes = [svg.path([(x - 46, 0), (x, 90), (x, HEIGHT_PIXELS)], LINE_COLOUR, 20)]
    bar = [_place(ahead, side, scale) for side in (max(at), min(at))]
    shapes += [svg.line(MIDDLE_PIXELS, _place(ahead, 0.0, scale), svg.FAINT, 2), svg.line(bar[0], bar[1], svg.FAINT, 3)]
    for side in at:
        place, is_above = _place(ahead, side, scale), side == max(at)
        shapes.append(svg.circle(place, 6, svg.RED if is_above else svg.PAPER, svg.INK))
        shapes.append(svg.words((place[0], place[1] - 12), f"{is_above:d}", "middle", bold=True))
    return svg.document(WIDTH_PIXELS, HEIGHT_PIXELS, [*shapes, *robot(MIDDLE_PIXELS, RIM_UNITS * scale)], title)


def robot(at: svg.Point, radius: float) -> Iterator[str]:
    """A round robot that faces up."""
    yield svg.circle(at, radius, svg.PANEL, svg.INK, 1.5)
    yield svg.line(at, (at[0], at[1] - radius), svg.INK, 2)


def _meets(angle: float, rock: Rock) -> float:
    """How far from the middle a ray meets a disc; infinite where it does not."""
    ahead, left, radius = rock
    along, aside = ahead * cos(angle) + left * sin(angle), ahead * sin(angle) - left * cos(angle)
    is_met = abs(aside) < radius < hypot(ahead, left) and along > 0
    return along - sqrt(radius**2 - aside**2) if is_met else inf


def _place(ahead: float, left: float, scale: float) -> svg.Point:
    return MIDDLE_PIXELS[0] - left * scale, MIDDLE_PIXELS[1] - ahead * scale


def _along(angle: float, away: float, scale: float) -> svg.Point:
    """A point so far away in a direction, counterclockwise from straight ahead."""
    return _place(cos(angle) * away, sin(angle) * away, scale)
