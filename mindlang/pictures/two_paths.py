"""The picture of a run and of the same run with something changed: both paths, and where they part."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from mindrun.terminal.tick_count import ticks as in_words

from mindlang.number_format import score
from mindlang.pictures.canvas import Canvas, Image, Viewport, blank, pasted, text_width
from mindlang.pictures.caption import SMALL_PIXELS, draw_scale
from mindlang.pictures.ending import ending_words
from mindlang.pictures.names import draw_names
from mindlang.pictures.path import draw_collisions, draw_start
from mindlang.pictures.picture import (
    BOTTOM_PIXELS,
    PICTURE_PIXELS,
    SCALE_FACTOR,
    SIDE_PIXELS,
    TOP_PIXELS,
    height_of,
    view_of,
)
from mindlang.pictures.robot import draw_robot
from mindlang.pictures.scene import draw_floor, draw_items, draw_zones
from mindlang.pictures.theme import PAPER, Colour
from mindlang.run.recorded_run import RecordedRun

OUTCOME_PIXELS = 24.0  # the height of a line that says what came of a run
TITLE_PIXELS, WORDS_PIXELS = 24.0, 13.0
PATH_PIXELS = 3.6, 1.8  # the width of the paths: where they are one, both are seen
RING_PIXELS, MARK_PIXELS = 7.0, 5.0  # from a robot to the ring around it; the marks of the start and of the change


@dataclass(frozen=True, slots=True)
class Way:
    """One of both runs: its name and colour, and what came of it."""

    name: str
    colour: Colour
    run: RecordedRun
    found: dict[str, Any]


def two_paths(both: Sequence[tuple[RecordedRun, dict[str, Any]]], words: str, tick: int) -> Image:
    """The picture of two runs and what came of them; the second is changed, as `words` say, from a tick on."""
    (was, found), (now, found_now) = both
    ways = [Way("as it was", PAPER.skills[0], was, found), Way("changed", PAPER.skills[1], now, found_now)]
    height = height_of(was)
    page = blank(SCALE_FACTOR * PICTURE_PIXELS, SCALE_FACTOR * height, PAPER.page)
    wide = SCALE_FACTOR * (PICTURE_PIXELS - 2 * SIDE_PIXELS)
    high = SCALE_FACTOR * (height - TOP_PIXELS - BOTTOM_PIXELS)
    view = view_of(was, wide, high, now)
    pasted(page, _world(ways, tick, view, wide, high), SCALE_FACTOR * SIDE_PIXELS, SCALE_FACTOR * TOP_PIXELS)
    canvas = Canvas(page, Viewport(0.0, 0.0, SCALE_FACTOR), pen=SCALE_FACTOR, down=True)
    right = PICTURE_PIXELS - SIDE_PIXELS
    canvas.text(SIDE_PIXELS, 40, was.task.name, TITLE_PIXELS, PAPER.ink, bold=True)
    said = f"{ways[0].found['master']} in charge, seed {ways[0].found['seed']}, {words}"
    _fitting(canvas, SIDE_PIXELS, 70, said, WORDS_PIXELS, right - 110)
    said_wide = canvas.text(right, 70, f"tick {tick:,}", SMALL_PIXELS, PAPER.ink, align="right") / canvas.pen
    _mark(canvas, right - said_wide - 2 * MARK_PIXELS, 66, 1.0)
    for line, way in enumerate(ways):
        _outcome(canvas, way, SIDE_PIXELS, height - 46.0 + OUTCOME_PIXELS * line, right - 150.0)
    draw_scale(canvas, SCALE_FACTOR / view.scale, PAPER, right, height - 44)
    return cv2.resize(page, (PICTURE_PIXELS, height), interpolation=cv2.INTER_AREA).astype(np.uint8)


def _world(ways: Sequence[Way], tick: int, view: Viewport, width: int, height: int) -> Image:
    """Floor and things as they were before the change, both paths, both robots where they came to."""
    was = ways[0].run
    parted = min(tick - 1, *(way.run.ticks for way in ways))
    image = blank(width, height, PAPER.page if was.task.scene.is_bounded else PAPER.floor)
    canvas = Canvas(image, view, pen=SCALE_FACTOR)
    draw_floor(canvas, was, PAPER)
    draw_zones(canvas, was, PAPER, parted)
    draw_items(canvas, was, PAPER, parted)
    canvas.line(was.body[: parted + 1, :2], PAPER.faint, PATH_PIXELS[1])
    for way, thick in zip(ways, PATH_PIXELS, strict=True):
        canvas.line(way.run.body[parted:, :2], way.colour, thick)
    draw_start(canvas, was, PAPER)
    pixel = canvas.pen / view.scale
    for way in ways:
        draw_robot(canvas, way.run, PAPER, way.run.ticks)
        x, y, _ = way.run.body[-1]
        canvas.disc(x, y, was.graph.body.radius + RING_PIXELS * pixel, way.colour, width=3.0)
        draw_collisions(canvas, way.run, PAPER)
    x, y, _ = was.body[parted]
    _mark(canvas, x, y, pixel)
    draw_names(canvas, was, PAPER, parted)
    return image


def _mark(canvas: Canvas, x: float, y: float, pixel: float) -> None:
    """Where the robot was when something was changed."""
    canvas.disc(x, y, MARK_PIXELS * pixel, PAPER.lamp)
    canvas.disc(x, y, MARK_PIXELS * pixel, PAPER.ink, width=1.8)


def _outcome(canvas: Canvas, way: Way, x: float, y: float, right: float) -> None:
    """The colour of a path, and what came of it."""
    canvas.line([(x, y - 4), (x + 20, y - 4)], way.colour, 3.0)
    _fitting(canvas, x + 30, y, f"{way.name}: {outcome_words(way.found)}", SMALL_PIXELS, right)


def outcome_words(found: dict[str, Any]) -> str:
    """What came of a run, in a line."""
    counted = [f"{times} × {event}" for event, times in found["by_event"].items()]
    return ", ".join([f"score {score(found['score'])}", *counted, in_words(found["ticks"]), ending_words(found)])


def _fitting(canvas: Canvas, x: float, y: float, text: str, size: float, right: float) -> None:
    """A line of text, smaller where it would go beyond `right`."""
    wide = text_width(text, size * canvas.pen) / canvas.pen
    canvas.text(x, y, text, size * min(1.0, (right - x) / wide), PAPER.ink)
