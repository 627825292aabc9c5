"""How a run ended: the words, a mark where the robot was, and a banner over the world of a film."""

from collections.abc import Iterable, Iterator
from typing import Any

from mindlang.number_format import score
from mindlang.pictures.canvas import Canvas, Rectangle, rectangle, text_width
from mindlang.pictures.labels import Label, free
from mindlang.pictures.theme import NIGHT, PAPER, Colour, Theme
from mindlang.run.recorded_run import RecordedRun

MARK_PIXELS, RING_PIXELS = 8.0, 4.0  # from the robot to the mark's inner ring, and from there to the outer one
BANNER_PIXELS, BANNER_MARGIN_PIXELS = 70.0, 18.0  # its height, and how far it is from the edge of the world
WORDS_PIXELS, DETAIL_PIXELS, LABEL_PIXELS = 19.0, 11.0, 11.5  # capitals
LEAST_WORLD_PIXELS = 3 * BANNER_PIXELS  # the height of a world that is not hidden by its banner


def ending_words(found: dict[str, Any]) -> str:
    """How a run with the outcome `found` ended."""
    event, is_success = found["ended_by"], bool(found.get("succeeded"))
    if event is None:
        return "lasted its time" + ", a success" * is_success
    return f"success: {event}" if is_success else f"ended by {event}"


def ending_colour(found: dict[str, Any], theme: Theme) -> Colour:
    """A success is green; what else ends a run need be no failure."""
    return theme.glow if found.get("succeeded") else theme.ink


def draw_end_mark(canvas: Canvas, run: RecordedRun, found: dict[str, Any], theme: Theme) -> None:
    """Two rings around the robot, where the run ended."""
    x, y, _ = run.body[-1]
    draw_rings(canvas, x, y, run.graph.body.radius + MARK_PIXELS * canvas.pixel, found, theme)


def end_label(canvas: Canvas, run: RecordedRun, found: dict[str, Any]) -> Label:
    """The words beside the mark."""
    x, y, _ = run.body[-1]
    size = 2 * (run.graph.body.radius + (MARK_PIXELS + RING_PIXELS) * canvas.pixel)
    return Label(ending_words(found), LABEL_PIXELS, ending_colour(found, PAPER), x, y, size)


def draw_rings(canvas: Canvas, x: float, y: float, radius: float, found: dict[str, Any], theme: Theme) -> None:
    """The mark of an end around a place."""
    for size, width in ((radius, 2.0), (radius + RING_PIXELS * canvas.pixel, 1.2)):
        canvas.disc(x, y, size, theme.floor, width=width + 2.0)
        canvas.disc(x, y, size, ending_colour(found, theme), width=width)


def draw_banner(
    canvas: Canvas, run: RecordedRun, found: dict[str, Any], room: Rectangle, taken: Iterable[Rectangle]
) -> None:
    """How it ended, when, and with which score: at an edge of the room, where nothing that is `taken` lies below it.

    All are in pixels, from the upper left corner.
    """
    colour, seconds = ending_colour(found, NIGHT), found["ticks"] * run.graph.tick
    words, detail = ending_words(found), f"after {seconds:.1f} s with a score of {score(found['score'])}"
    widest = max(text_width(words, WORDS_PIXELS, True), text_width(detail, DETAIL_PIXELS)) + 2 * BANNER_MARGIN_PIXELS
    wide = min(widest, room.width - 2 * BANNER_MARGIN_PIXELS)
    fit = wide / widest
    left, low, *_ = free(_banner_places(wide, room), taken, room)
    x = left + wide / 2
    around = rectangle(x, low + BANNER_PIXELS / 2, wide / 2, BANNER_PIXELS / 2)
    canvas.polygon(around, NIGHT.page, 0.88)
    canvas.line(around, colour, 1.6, closed=True)
    canvas.text(x, low + 33, words, fit * WORDS_PIXELS, colour, bold=True, align="centre")
    canvas.text(x, low + 56, detail, fit * DETAIL_PIXELS, NIGHT.ink, align="centre")


def _banner_places(wide: float, room: Rectangle) -> Iterator[Rectangle]:
    """Below and above, each in the middle, at the left and at the right."""
    far = room.width - wide
    for y in (room.low + room.height - BANNER_MARGIN_PIXELS - BANNER_PIXELS, room.low + BANNER_MARGIN_PIXELS):
        for x in (far / 2, BANNER_MARGIN_PIXELS, far - BANNER_MARGIN_PIXELS):
            yield Rectangle(room.left + x, y, wide, BANNER_PIXELS)
