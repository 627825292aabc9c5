"""The path of the robot, coloured by the skill in control or, where there is only one, by time; and how it ended."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mindlang.number_format import score
from mindlang.pictures.canvas import Canvas, Region, rectangle_corners, text_width
from mindlang.pictures.scene import SceneLabel, free, thing_colours
from mindlang.pictures.theme import NIGHT, PAPER, Colour, Theme, mixed
from mindlang.run.recorded_run import RecordedRun

TIME_SHADES = 64  # shades of a path by time
NOBODY = "no skill"  # what the legend calls ticks in which no skill has influence
NOBODY_SHADE = 0.3  # from the floor to ink
CORE_SHARES = 2.0, 0.6  # of the width: a line that has another one in its middle, and that one
MIN_CONTROL_SHARE = 0.005  # of the run: a skill that was in control for less does not count
MOST_NUMBERED = 40
OTHERS_PIXELS, OTHERS_ALPHA = 1.4, 0.6  # of the way of another robot
MARK_PIXELS, RING_PIXELS = 8.0, 4.0  # from the robot to the mark's inner ring, and from there to the outer one
BANNER_PIXELS, BANNER_MARGIN_PIXELS = 70.0, 18.0  # its height, and how far it is from the edge of the world
WORDS_PIXELS, DETAIL_PIXELS, LABEL_PIXELS = 19.0, 11.0, 11.5  # capitals
LEAST_WORLD_PIXELS = 3 * BANNER_PIXELS  # the height of a world that is not hidden by its banner


@dataclass(frozen=True, slots=True)
class Stroke:
    """The look of a line: a colour, and in its middle another one where there are more lines than colours."""

    colour: Colour
    core: Colour | None = None

    def draw(self, canvas: Canvas, points: ArrayLike, width: float) -> None:
        outer, inner = CORE_SHARES
        canvas.line(points, self.colour, width * (outer if self.core else 1.0))
        if self.core:
            canvas.line(points, self.core, width * inner)


@dataclass(frozen=True, slots=True)
class Path:
    """The robot's places [ticks + 1, 2], and per tick which of the `strokes` the path has.

    `shares` says how much of the run each skill was in control, and none, by name; it is empty for a path by time.
    """

    places: NDArray[np.float64]
    keys: NDArray[np.int64]
    strokes: list[Stroke]
    shares: dict[str, float]

    @classmethod
    def of(cls, run: RecordedRun, theme: Theme) -> "Path":
        """By skill, where several were in control."""
        names = [*run.movers, NOBODY]
        places, keys = run.body[:, :2], run.in_control()
        shares = np.bincount(keys, minlength=len(names)) / max(1, run.ticks)
        if np.count_nonzero(shares >= MIN_CONTROL_SHARE) > 1:
            nobody = Stroke(mixed(theme.floor, theme.ink, NOBODY_SHADE))
            each = [*strokes_of(theme, len(run.movers)), nobody]
            return cls(places, keys, each, dict(zip(names, shares.tolist(), strict=True)))
        keys = np.arange(run.ticks) * TIME_SHADES // max(1, run.ticks)
        shades = [Stroke(mixed(theme.early, theme.late, i / TIME_SHADES)) for i in range(TIME_SHADES)]
        return cls(places, keys, shades, {})

    def draw(self, canvas: Canvas, first: int, last: int, width: float) -> None:
        keys = self.keys[first:last]
        changes = np.flatnonzero(np.diff(keys, prepend=-1, append=-1)).tolist()
        for begin, end in pairwise(changes):
            self.strokes[keys[begin]].draw(canvas, self.places[first + begin : first + end + 1], width)


def strokes_of(theme: Theme, count: int) -> list[Stroke]:
    cores = (None, theme.floor, theme.ink)
    many = len(theme.skills)
    return [Stroke(theme.skills[i % many], cores[i // many % len(cores)]) for i in range(count)]


def draw_start(canvas: Canvas, run: RecordedRun) -> None:
    x, y, _ = run.body[0]
    canvas.disc(x, y, 5 * canvas.pixel, PAPER.floor)
    canvas.disc(x, y, 5 * canvas.pixel, PAPER.ink, width=1.8)


def draw_others(canvas: Canvas, run: RecordedRun, theme: Theme, first: int, last: int) -> None:
    """Draw the ways of other robots from a tick to another."""
    for number, (thing, colour) in enumerate(zip(run.contents, thing_colours(run.contents, theme), strict=True)):
        if thing.kind.is_robot and np.isfinite(run.things[0, number, 0]):  # itself is nowhere among the things
            canvas.line(run.things[first : last + 1, number, :2], colour, OTHERS_PIXELS, OTHERS_ALPHA)


def draw_collisions(canvas: Canvas, run: RecordedRun) -> None:
    for x, y, _ in run.body[run.collisions]:
        draw_cross(canvas, x, y, 5.5 * canvas.pixel, PAPER)


def draw_cross(canvas: Canvas, x: float, y: float, size: float, theme: Theme) -> None:
    for colour, width in ((theme.floor, 4.5), (theme.crash, 2.2)):
        for up in (size, -size):
            canvas.line([(x - size, y - up), (x + size, y + up)], colour, width)


def draw_former(canvas: Canvas, run: RecordedRun) -> None:
    """Draw faintly where things were before, numbered where they were several, and not too many.

    Of what walks or was pushed also the way; what can be pushed was first where it appeared.
    """
    for number, (thing, colour) in enumerate(zip(run.contents, thing_colours(run.contents, PAPER), strict=True)):
        former = run.former(number)[: 0 if thing.kind.is_robot else None]
        if thing.kind.walks or thing.kind.is_loose:
            for stretch in run.stretches(number):
                canvas.line(stretch, colour, 1.0, 0.5)
        for order, (x, y, size) in enumerate(run.placements(number) if thing.kind.is_loose else former, 1):
            if thing.kind.is_round:
                canvas.disc(x, y, size / 2, colour, 0.16)
                canvas.disc(x, y, size / 2, colour, 0.45, width=1.0)
            else:
                corners = rectangle_corners(x, y, size / 2, size / 2)
                canvas.polygon(corners, colour, 0.08)
                canvas.line(corners, colour, 1.0, 0.4, closed=True)
            if order <= len(former) and 1 < len(former) <= MOST_NUMBERED:
                below = 9 * canvas.pixel
                canvas.text(x + size / 2 + below / 3, y - below, str(order), 9, PAPER.faint)


def ending_words(found: dict[str, Any]) -> str:
    event, is_success = found["ended_by"], bool(found.get("succeeded"))
    if event is None:
        return "lasted its time" + ", a success" * is_success
    return f"success: {event}" if is_success else f"ended by {event}"


def ending_colour(found: dict[str, Any], theme: Theme) -> Colour:
    """A success is green; what else ends a run need be no failure."""
    return theme.glow if found.get("succeeded") else theme.ink


def draw_end_mark(canvas: Canvas, run: RecordedRun, found: dict[str, Any], theme: Theme) -> None:
    """Draw two rings around the robot, where the run ended."""
    x, y, _ = run.body[-1]
    draw_rings(canvas, x, y, run.graph.body.radius + MARK_PIXELS * canvas.pixel, found, theme)


def end_label(canvas: Canvas, run: RecordedRun, found: dict[str, Any]) -> SceneLabel:
    x, y, _ = run.body[-1]
    size = 2 * (run.graph.body.radius + (MARK_PIXELS + RING_PIXELS) * canvas.pixel)
    return SceneLabel(ending_words(found), LABEL_PIXELS, ending_colour(found, PAPER), x, y, size)


def draw_rings(canvas: Canvas, x: float, y: float, radius: float, found: dict[str, Any], theme: Theme) -> None:
    """Draw the rings of an end around a place."""
    for size, width in ((radius, 2.0), (radius + RING_PIXELS * canvas.pixel, 1.2)):
        canvas.disc(x, y, size, theme.floor, width=width + 2.0)
        canvas.disc(x, y, size, ending_colour(found, theme), width=width)


def draw_banner(canvas: Canvas, run: RecordedRun, found: dict[str, Any], room: Region, taken: Iterable[Region]) -> None:
    """Draw the end of a run, its time and score, at an edge of the room, in pixels, that covers nothing `taken`."""
    colour, seconds = ending_colour(found, NIGHT), found["ticks"] * run.graph.tick
    words, detail = ending_words(found), f"after {seconds:.1f} s with a score of {score(found['score'])}"
    widest = max(text_width(words, WORDS_PIXELS, True), text_width(detail, DETAIL_PIXELS)) + 2 * BANNER_MARGIN_PIXELS
    wide = min(widest, room.width - 2 * BANNER_MARGIN_PIXELS)
    fit = wide / widest
    left, low, *_ = free(_banner_places(wide, room), taken, room)
    x = left + wide / 2
    around = rectangle_corners(x, low + BANNER_PIXELS / 2, wide / 2, BANNER_PIXELS / 2)
    canvas.polygon(around, NIGHT.page, 0.88)
    canvas.line(around, colour, 1.6, closed=True)
    canvas.text(x, low + 33, words, fit * WORDS_PIXELS, colour, bold=True, align="centre")
    canvas.text(x, low + 56, detail, fit * DETAIL_PIXELS, NIGHT.ink, align="centre")


def _banner_places(wide: float, room: Region) -> Iterator[Region]:
    """Below and above, each in the middle, at the left and at the right."""
    far = room.width - wide
    for y in (room.low + room.height - BANNER_MARGIN_PIXELS - BANNER_PIXELS, room.low + BANNER_MARGIN_PIXELS):
        for x in (far / 2, BANNER_MARGIN_PIXELS, far - BANNER_MARGIN_PIXELS):
            yield Region(room.left + x, y, wide, BANNER_PIXELS)
