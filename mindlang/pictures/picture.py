"""The picture of a run: its world as it was in the end, and the path that led there."""

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from mindlang.pictures.canvas import Canvas, Image, Viewport, blank, pasted
from mindlang.pictures.caption import draw_legend, draw_scale, draw_title
from mindlang.pictures.ending import draw_end_mark, end_label
from mindlang.pictures.labels import draw_names
from mindlang.pictures.path import Path, draw_collisions, draw_former, draw_start
from mindlang.pictures.robot import draw_robot
from mindlang.pictures.scene import WALL_UNITS, draw_floor, draw_items, draw_zones, half_sides
from mindlang.pictures.theme import PAPER
from mindlang.run.recorded_run import RecordedRun

PICTURE_PIXELS = 1000
TOP_PIXELS, BOTTOM_PIXELS, SIDE_PIXELS = 96, 74, 28  # what stands around the world
SCALE_BAR_PIXELS = 170  # beside the legend
SCALE_FACTOR = 2  # drawn so many times larger, then averaged
PLAIN_MARGIN_UNITS = 6.0  # around a plain scene


def picture(run: RecordedRun, found: dict[str, Any]) -> Image:
    """The picture of a run with the outcome `found`."""
    world, path = empty_world(run), Path.of(run, PAPER)
    draw_former(world, run)
    draw_zones(world, run, PAPER, run.ticks)
    path.draw(world, 0, run.ticks, 2.0)
    draw_start(world, run)
    draw_end_mark(world, run, found, PAPER)
    draw_items(world, run, PAPER, run.ticks)
    draw_robot(world, run, PAPER, run.ticks)
    draw_collisions(world, run)
    draw_names(world, run, PAPER, run.ticks, end_label(world, run, found))
    height, right = height_of(run), PICTURE_PIXELS - SIDE_PIXELS
    page = page_around(world, height)
    draw_title(page, run, found, SIDE_PIXELS, 34, right)
    draw_legend(page, run, found, path, SIDE_PIXELS, height - 46, right - SCALE_BAR_PIXELS)
    return reduced(page)


def empty_world(run: RecordedRun, *others: RecordedRun) -> Canvas:
    """A floor to draw on: the arena, or in a plain scene all that happened, in other runs of the task as well."""
    size = PICTURE_PIXELS - 2 * SIDE_PIXELS, height_of(run) - TOP_PIXELS - BOTTOM_PIXELS
    width, height = (SCALE_FACTOR * side for side in size)
    image = blank(width, height, PAPER.page if run.task.scene.is_bounded else PAPER.floor)
    canvas = Canvas(image, view_of(run, width, height, *others), pen=SCALE_FACTOR)
    draw_floor(canvas, run, PAPER)
    return canvas


def height_of(run: RecordedRun) -> int:
    """How many pixels high the picture is: square, or lower where the arena is long."""
    if not run.task.scene.is_bounded:
        return PICTURE_PIXELS
    x, y = np.add(half_sides(run.task.scene), WALL_UNITS)
    return min(PICTURE_PIXELS, TOP_PIXELS + BOTTOM_PIXELS + round((PICTURE_PIXELS - 2 * SIDE_PIXELS) * float(y / x)))


def view_of(run: RecordedRun, width: int, height: int, *others: RecordedRun) -> Viewport:
    """What is seen of the world in so many pixels."""
    if run.task.scene.is_bounded:
        half = np.add(half_sides(run.task.scene), WALL_UNITS)
        return Viewport.around(-half, half, width, height)
    seen = np.concatenate([places for each in (run, *others) for places in _places(each)])
    return Viewport.around(seen.min(axis=0) - PLAIN_MARGIN_UNITS, seen.max(axis=0) + PLAIN_MARGIN_UNITS, width, height)


def _places(run: RecordedRun) -> list[NDArray[np.float64]]:
    """The places [n, 2] at which anything was."""
    things = (run.placements(i)[:, :2] for i in range(len(run.contents)))
    return [run.body[:, :2], *things, run.boxes[:, :2]]


def empty_page(height: int) -> Canvas:
    """A page so many pixels high."""
    size = SCALE_FACTOR * PICTURE_PIXELS, SCALE_FACTOR * height
    return Canvas.of_page(blank(*size, PAPER.page), SCALE_FACTOR)


def page_around(world: Canvas, height: int) -> Canvas:
    """A page with this world on it, and its scale."""
    page = empty_page(height)
    pasted(page.image, world.image, SCALE_FACTOR * SIDE_PIXELS, SCALE_FACTOR * TOP_PIXELS)
    draw_scale(page, world.pixel, PICTURE_PIXELS - SIDE_PIXELS, height - 44)
    return page


def reduced(page: Canvas) -> Image:
    """The image of a page."""
    height, width, _ = page.image.shape
    size = width // SCALE_FACTOR, height // SCALE_FACTOR
    return cv2.resize(page.image, size, interpolation=cv2.INTER_AREA).astype(np.uint8)


def png(image: Image) -> bytes:
    """An image as the contents of a PNG file, which is kept and sent more often than written: as small as can be."""
    done, data = cv2.imencode(".png", image, [cv2.IMWRITE_PNG_COMPRESSION, 9])
    assert done
    return bytes(data)
