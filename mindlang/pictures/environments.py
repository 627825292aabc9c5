"""Pictures of a run in an environment: some images of it in the order of time, as the environment draws them."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.errors import MindError
from mindrun.graph.graph import Graph, Task
from mindrun.sim.outside.seen import UNKNOWN_FAILURES, SeenEpisode, Sent

from mindlang.pictures.canvas import Image, letterbox, paste, reduced
from mindlang.pictures.picture import (
    PICTURE_PIXELS,
    SCALE_FACTOR,
    SIDE_PIXELS,
    SMALL_PIXELS,
    TITLE_LINE_PIXELS,
    TOP_PIXELS,
    draw_title,
    empty_page,
)
from mindlang.pictures.theme import PAPER
from mindlang.run.recorded_run import RecordedRun

SHEET_COLUMNS, SHEET_ROWS = 4, 3  # of images
GAP_PIXELS, LABEL_PIXELS = 12, 24  # between images, and for the time below each
SAID_PIXELS = 14.0


def seen_run(run: RecordedRun, seed: int) -> SeenEpisode:
    """The images of a run of that seed; MindError where its environment cannot be made to be seen."""
    if run.acting is None:
        return seen_episode(run.graph, run.task, run.setup.folder, seed, lambda first, last: run.commands[first:last])
    acting, environment = run.acting, run.task.scene.environment
    return SeenEpisode(run.graph, environment, run.setup.folder, seed, lambda first, last: acting[first:last])


def seen_episode(graph: Graph, task: Task, folder: Path, seed: int, sent: Sent) -> SeenEpisode:
    """The images of a run of which only the commands are known; MindError where some may not have reached actuators."""
    if task.fails:
        raise MindError(UNKNOWN_FAILURES, "mindc run --picture and --video draw such a run")
    return SeenEpisode(graph, task.scene.environment, folder, seed, sent)


def environment_picture(run: RecordedRun, found: dict[str, Any]) -> Image:
    """The run with the outcome `found`, from beginning to end; MindError where its environment draws nothing."""
    return _sheet(run, found, _ticks(0, run.ticks, SHEET_COLUMNS * SHEET_ROWS), "")


def environment_pictures(both: Sequence[tuple[RecordedRun, dict[str, Any]]], words: str, tick: int) -> Image:
    """Two runs and what came of them, one below the other; the second is changed, as `words` say, from a tick on."""
    return np.concatenate([
        _sheet(run, found, _ticks(min(tick - 1, run.ticks), run.ticks, 2 * SHEET_COLUMNS), title)
        for (run, found), title in zip(both, ("as it was", words), strict=True)
    ])  # fmt: skip


def _ticks(first: int, last: int, count: int) -> Sequence[int]:
    found: list[int] = np.unique(np.linspace(first, last, count).round().astype(int)).tolist()
    return found


def _sheet(run: RecordedRun, found: dict[str, Any], ticks: Sequence[int], said: str) -> Image:
    """A page with the title of the run, what is said of it, and these ticks of it."""
    seen = seen_run(run, found["seed"])
    high, wide, _ = seen.image(0).shape
    width = (PICTURE_PIXELS - 2 * SIDE_PIXELS - (SHEET_COLUMNS - 1) * GAP_PIXELS) // SHEET_COLUMNS
    height = max(1, round(width * high / wide))
    rows = -(-len(ticks) // SHEET_COLUMNS)
    page = empty_page(TOP_PIXELS + rows * (height + LABEL_PIXELS + GAP_PIXELS) + GAP_PIXELS)
    draw_title(page, run, found)
    page.text(PICTURE_PIXELS - SIDE_PIXELS, TITLE_LINE_PIXELS, said, SAID_PIXELS, PAPER.ink, align="right")
    for number, tick in enumerate(ticks):
        row, column = divmod(number, SHEET_COLUMNS)
        x = SIDE_PIXELS + column * (width + GAP_PIXELS)
        y = TOP_PIXELS + row * (height + LABEL_PIXELS + GAP_PIXELS)
        image = letterbox(seen.image(tick), SCALE_FACTOR * width, SCALE_FACTOR * height, PAPER.page)
        paste(page.image, image, SCALE_FACTOR * x, SCALE_FACTOR * y)
        label = f"tick {tick:,} ({tick * run.graph.tick:.1f} s)" if tick else "beginning"
        page.text(x, y + height + 17, label, SMALL_PIXELS, PAPER.faint)
    return reduced(page.image, 1 / SCALE_FACTOR)
