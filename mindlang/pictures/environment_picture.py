"""The picture of a run in an environment: some images of it in the order of time, as the environment draws them."""

from collections.abc import Sequence
from typing import Any

import cv2
import numpy as np

from mindlang.pictures.canvas import Canvas, Image, Viewport, blank, pasted
from mindlang.pictures.caption import SMALL_PIXELS, draw_title
from mindlang.pictures.environment_run import fitted, seen_run
from mindlang.pictures.picture import PICTURE_PIXELS, SCALE_FACTOR, SIDE_PIXELS, TOP_PIXELS
from mindlang.pictures.theme import PAPER
from mindlang.run.recorded_run import RecordedRun

SHEET_COLUMNS, SHEET_ROWS = 4, 3  # of images
GAP_PIXELS, LABEL_PIXELS = 12, 24  # between images, and for the time below each
SAID_PIXELS = 14.0


def environment_picture(run: RecordedRun, found: dict[str, Any]) -> Image:
    """The run with the outcome `found`, from beginning to end; MindError where its environment draws nothing."""
    return _sheet(run, found, _ticks(0, run.ticks, SHEET_COLUMNS * SHEET_ROWS), "")


def environment_pictures(both: Sequence[tuple[RecordedRun, dict[str, Any]]], words: str, tick: int) -> Image:
    """Two runs and what came of them, one below the other; the second is changed, as `words` say, from a tick on."""
    titles = "as it was", words
    pages = (
        _sheet(run, found, _ticks(min(tick - 1, run.ticks), run.ticks, 2 * SHEET_COLUMNS), title)
        for (run, found), title in zip(both, titles, strict=True)
    )
    return np.concatenate([*pages])


def _ticks(first: int, last: int, count: int) -> Sequence[int]:
    found: list[int] = np.unique(np.linspace(first, last, count).round().astype(int)).tolist()
    return found


def _sheet(run: RecordedRun, found: dict[str, Any], ticks: Sequence[int], said: str) -> Image:
    """A page with the title of the run, what is said of it, and these ticks of it."""
    seen = seen_run(run, found["seed"])
    width = (PICTURE_PIXELS - 2 * SIDE_PIXELS - (SHEET_COLUMNS - 1) * GAP_PIXELS) // SHEET_COLUMNS
    first = seen.image(0)
    height = max(1, round(width * first.shape[0] / first.shape[1]))
    rows = -(-len(ticks) // SHEET_COLUMNS)
    whole = TOP_PIXELS + rows * (height + LABEL_PIXELS + GAP_PIXELS) + GAP_PIXELS
    page = blank(SCALE_FACTOR * PICTURE_PIXELS, SCALE_FACTOR * whole, PAPER.page)
    canvas = Canvas(page, Viewport(0.0, 0.0, SCALE_FACTOR), pen=SCALE_FACTOR, down=True)
    draw_title(canvas, run, found, PAPER, SIDE_PIXELS, 34, PICTURE_PIXELS - SIDE_PIXELS)
    canvas.text(PICTURE_PIXELS - SIDE_PIXELS, 34, said, SAID_PIXELS, PAPER.ink, align="right")
    for number, tick in enumerate(ticks):
        row, column = divmod(number, SHEET_COLUMNS)
        x = SIDE_PIXELS + column * (width + GAP_PIXELS)
        y = TOP_PIXELS + row * (height + LABEL_PIXELS + GAP_PIXELS)
        image = fitted(seen.image(tick), SCALE_FACTOR * width, SCALE_FACTOR * height, PAPER.page)
        pasted(page, image, SCALE_FACTOR * x, SCALE_FACTOR * y)
        label = f"tick {tick:,} ({tick * run.graph.tick:.1f} s)" if tick else "beginning"
        canvas.text(x, y + height + 17, label, SMALL_PIXELS, PAPER.faint)
    return cv2.resize(page, (PICTURE_PIXELS, whole), interpolation=cv2.INTER_AREA).astype(np.uint8)
