"""The picture of a run and of the same run with something changed: both paths, and where they part."""

from collections.abc import Sequence
from typing import Any

from mindrun.terminal.tick_count import ticks as in_words

from mindlang.number_format import score
from mindlang.pictures.canvas import Canvas, Image, reduced
from mindlang.pictures.path import draw_collisions, draw_start, ending_words
from mindlang.pictures.picture import (
    PICTURE_PIXELS,
    SCALE_FACTOR,
    SIDE_PIXELS,
    SMALL_PIXELS,
    height_of,
    page_around,
    world_of,
)
from mindlang.pictures.robot import draw_robot
from mindlang.pictures.scene import draw_items, draw_names, draw_zones
from mindlang.pictures.theme import PAPER
from mindlang.run.recorded_run import RecordedRun

OUTCOME_PIXELS = 24.0  # the height of a line that says what came of a run
TITLE_PIXELS, WORDS_PIXELS = 24.0, 13.0
PATH_PIXELS = 3.6, 1.8  # the width of the paths: where they are one, both are seen
RING_PIXELS, MARK_PIXELS = 7.0, 5.0  # from a robot to the ring around it; the marks of the start and of the change
NAMES = "as it was", "changed"


def two_paths(both: Sequence[tuple[RecordedRun, dict[str, Any]]], words: str, tick: int) -> Image:
    """The picture of two runs and what came of them; the second is changed, as `words` say, from a tick on."""
    (was, found), (now, _) = both
    height, right = height_of(was), PICTURE_PIXELS - SIDE_PIXELS
    page = page_around(_world(was, now, tick), height)
    page.text(SIDE_PIXELS, 40, was.task.name, TITLE_PIXELS, PAPER.ink, bold=True)
    said = f"{found['master']} in charge, seed {found['seed']}, {words}"
    _fitting(page, SIDE_PIXELS, 70, said, WORDS_PIXELS, right - 110)
    when = f"tick {tick:,}"
    page.text(right, 70, when, SMALL_PIXELS, PAPER.ink, align="right")
    _mark(page, right - page.width(when, SMALL_PIXELS) - 2 * MARK_PIXELS, 66)
    for line, (name, (_, outcome)) in enumerate(zip(NAMES, both, strict=True)):
        low = height - 46.0 + OUTCOME_PIXELS * line
        page.line([(SIDE_PIXELS, low - 4), (SIDE_PIXELS + 20, low - 4)], PAPER.skills[line], 3.0)
        _fitting(page, SIDE_PIXELS + 30, low, f"{name}: {outcome_words(outcome)}", SMALL_PIXELS, right - 150.0)
    return reduced(page.image, 1 / SCALE_FACTOR)


def _world(was: RecordedRun, now: RecordedRun, tick: int) -> Canvas:
    """Floor and things as they were before the change, both paths, both robots where they came to."""
    parted = min(tick - 1, was.ticks, now.ticks)
    canvas = world_of(was, now)
    draw_zones(canvas, was, PAPER, parted)
    draw_items(canvas, was, PAPER, parted)
    canvas.line(was.body[: parted + 1, :2], PAPER.faint, PATH_PIXELS[1])
    for run, colour, thick in zip((was, now), PAPER.skills, PATH_PIXELS, strict=False):
        canvas.line(run.body[parted:, :2], colour, thick)
    draw_start(canvas, was)
    for run, colour in zip((was, now), PAPER.skills, strict=False):
        draw_robot(canvas, run, PAPER, run.ticks)
        x, y, _ = run.body[-1]
        canvas.disc(x, y, was.graph.body.radius + RING_PIXELS * canvas.pixel, colour, width=3.0)
        draw_collisions(canvas, run)
    x, y, _ = was.body[parted]
    _mark(canvas, x, y)
    draw_names(canvas, was, PAPER, parted)
    return canvas


def _mark(canvas: Canvas, x: float, y: float) -> None:
    """Draw a mark where the robot was when something was changed."""
    canvas.disc(x, y, MARK_PIXELS * canvas.pixel, PAPER.lamp)
    canvas.disc(x, y, MARK_PIXELS * canvas.pixel, PAPER.ink, width=1.8)


def outcome_words(found: dict[str, Any]) -> str:
    """The outcome of a run in one line."""
    counted = [f"{times} × {event}" for event, times in found["by_event"].items()]
    return ", ".join([f"score {score(found['score'])}", *counted, in_words(found["ticks"]), ending_words(found)])


def _fitting(page: Canvas, x: float, y: float, text: str, size: float, right: float) -> None:
    """Draw a line of text, smaller where it would go beyond `right`."""
    page.text(x, y, text, size * min(1.0, (right - x) / page.width(text, size)), PAPER.ink)
