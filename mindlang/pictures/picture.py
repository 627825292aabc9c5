"""The picture of a run: its world as it was in the end, and the path that led there."""

from collections.abc import Iterator
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from mindlang.pictures.canvas import Canvas, Image, Viewport, blank, pasted
from mindlang.pictures.caption import draw_legend, draw_scale, draw_title
from mindlang.pictures.ending import draw_end_mark, end_label
from mindlang.pictures.names import draw_names
from mindlang.pictures.path import Path, draw_collisions, draw_former, draw_start
from mindlang.pictures.robot import draw_robot
from mindlang.pictures.scene import (
    WALL_UNITS,
    draw_floor,
    draw_items,
    draw_zones,
    half_sides,
)
from mindlang.pictures.theme import PAPER
from mindlang.run.recorded_run import RecordedRun

PICTURE_PIXELS = 1000
TOP_PIXELS, BOTTOM_PIXELS, SIDE_PIXELS = 96, 74, 28  # what stands around the world
SCALE_BAR_PIXELS = 170  # beside the legend
SCALE_FACTOR = 2  # drawn so many times larger, then averaged
PLAIN_MARGIN_UNITS = 6.0  # around a plain scene


def picture(run: RecordedRun, found: dict[str, Any]) -> Image:
    """The picture of a run with the outcome `found`."""
    height = height_of(run)
    page = blank(SCALE_FACTOR * PICTURE_PIXELS, SCALE_FACTOR * height, PAPER.page)
    wide = SCALE_FACTOR * (PICTURE_PIXELS - 2 * SIDE_PIXELS)
    high = SCALE_FACTOR * (height - TOP_PIXELS - BOTTOM_PIXELS)
    view = view_of(run, wide, high)
    pasted(page, _world(run, found, view, wide, high), SCALE_FACTOR * SIDE_PIXELS, SCALE_FACTOR * TOP_PIXELS)
    canvas = Canvas(page, Viewport(0.0, 0.0, SCALE_FACTOR), pen=SCALE_FACTOR, down=True)
    draw_title(canvas, run, found, PAPER, SIDE_PIXELS, 34, PICTURE_PIXELS - SIDE_PIXELS)
    right = PICTURE_PIXELS - SIDE_PIXELS - SCALE_BAR_PIXELS
    draw_legend(canvas, run, found, Path.of(run, PAPER), PAPER, SIDE_PIXELS, height - 46, right)
    draw_scale(canvas, SCALE_FACTOR / view.scale, PAPER, PICTURE_PIXELS - SIDE_PIXELS, height - 44)
    return cv2.resize(page, (PICTURE_PIXELS, height), interpolation=cv2.INTER_AREA).astype(np.uint8)


def height_of(run: RecordedRun) -> int:
    """How many pixels high the picture is: square, or lower where the arena is long."""
    if not run.task.scene.is_bounded:
        return PICTURE_PIXELS
    x, y = np.add(half_sides(run.task.scene), WALL_UNITS)
    return min(PICTURE_PIXELS, TOP_PIXELS + BOTTOM_PIXELS + round((PICTURE_PIXELS - 2 * SIDE_PIXELS) * float(y / x)))


def view_of(run: RecordedRun, width: int, height: int, *others: RecordedRun) -> Viewport:
    """The arena, or in a plain scene all that happened, in other runs of the task as well."""
    if run.task.scene.is_bounded:
        half = np.add(half_sides(run.task.scene), WALL_UNITS)
        return Viewport.around(-half, half, width, height)
    seen = np.concatenate([places for each in (run, *others) for places in _places(each)])
    return Viewport.around(seen.min(axis=0) - PLAIN_MARGIN_UNITS, seen.max(axis=0) + PLAIN_MARGIN_UNITS, width, height)


def _places(run: RecordedRun) -> Iterator[NDArray[np.float64]]:
    """The places [n, 2] at which anything was."""
    yield run.body[:, :2]
    yield from (run.placements(i)[:, :2] for i in range(len(run.contents)))
    yield run.boxes[:, :2]


def png(image: Image) -> bytes:
    """An image as the contents of a PNG file, which is kept and sent more often than written: as small as can be."""
    done, data = cv2.imencode(".png", image, [cv2.IMWRITE_PNG_COMPRESSION, 9])
    assert done
    return bytes(data)


def _world(run: RecordedRun, found: dict[str, Any], view: Viewport, width: int, height: int) -> Image:
    is_plain = not run.task.scene.is_bounded
    image = blank(width, height, PAPER.floor if is_plain else PAPER.page)
    canvas = Canvas(image, view, pen=SCALE_FACTOR)
    draw_floor(canvas, run, PAPER)
    draw_former(canvas, run, PAPER)
    draw_zones(canvas, run, PAPER, run.ticks)
    Path.of(run, PAPER).draw(canvas, 0, run.ticks, 2.0)
    draw_start(canvas, run, PAPER)
    draw_end_mark(canvas, run, found, PAPER)
    draw_items(canvas, run, PAPER, run.ticks)
    draw_robot(canvas, run, PAPER, run.ticks)
    draw_collisions(canvas, run, PAPER)
    draw_names(canvas, run, PAPER, run.ticks, end_label(canvas, run, found, PAPER))
    return image
