"""Figure 15: an obstacle passed by influence, in five steps of a hierarchy on skills that never change."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from measure import compiled

from mindlang.pictures.canvas import Image, Viewport
from mindlang.pictures.film import TRAIL_SECONDS
from mindlang.pictures.film_images import FILM_HEIGHT, FilmImages
from mindlang.run import outcome
from mindlang.run.chosen_task import SetupError
from mindlang.run.recorded_run import RecordedRun, record_run
from mindlang.run.setup import NO_GENOME, set_up

FILE, TASK, MASTER = "constant_skills.mind", "Collect", "Gather"
SEEKER, DODGER = "SeekObject", "Dodge"
SNAPSHOT_COUNT = 5
MIN_PASSAGE_TICKS, MAX_PASSAGE_TICKS = 40, 200  # ticks that a passage may take
MARGIN_TICKS = 40  # ticks that are shown before the obstacle matters, and after it has mattered
WINDOW_UNITS = 30.0  # units of the world that are seen
SEEDS = range(1, 41)
FRAME_SCALE = 0.5  # than the frames of a film


class Close(FilmImages):
    """Images of a film that looks at one place."""

    def __init__(self, run: RecordedRun, found: dict[str, Any], x: float, y: float) -> None:
        self.x, self.y = x, y
        super().__init__(run, found, speed=1.0, trail=round(TRAIL_SECONDS / run.graph.tick), flash=0.0)

    def view(self, tick: int) -> Viewport:
        """What is around the place."""
        middle = np.array([self.x, self.y])
        return Viewport.around(middle - WINDOW_UNITS / 2, middle + WINDOW_UNITS / 2, FILM_HEIGHT, FILM_HEIGHT)


def passage(folder: Path) -> Image | None:
    """Five steps one below the other: the world at the left, the hierarchy at the right; None where there is none."""
    if not (path := folder / FILE).exists():
        return None
    try:
        found = set_up(str(path), compiled(path), TASK, MASTER)
    except SetupError:
        return None
    rollout = found.rollout()
    for seed in SEEDS:
        recorded = record_run(found, rollout, seed)
        for first, last in passages(recorded):
            about = {"seed": seed, **outcome.run_data(found.task, rollout.score(NO_GENOME, [seed]))}
            x, y = recorded.body[first : last + 1, :2].mean(axis=0)
            ticks = np.linspace(first - MARGIN_TICKS, last + MARGIN_TICKS, SNAPSHOT_COUNT).astype(int)
            return strip(Close(recorded, about, float(x), float(y)), ticks.tolist())
    return None


def passages(recorded: RecordedRun) -> Iterator[tuple[int, int]]:
    """The first and the last tick of each time in which the robot dodges on its way to the object, and hits nothing."""
    names = [skill.name for skill in recorded.graph.skills]
    dodging, seeking = (recorded.influence[:, names.index(name)] for name in (DODGER, SEEKER))
    changes = np.diff(np.concatenate([[0], (dodging > seeking).astype(np.int8), [0]]))
    for first, last in np.flatnonzero(changes).reshape(-1, 2).tolist():
        around = slice(max(0, first - 2 * MARGIN_TICKS), last + 2 * MARGIN_TICKS)
        whole = (
            MIN_PASSAGE_TICKS <= last - first <= MAX_PASSAGE_TICKS
            and first > 2 * MARGIN_TICKS
            and last + 2 * MARGIN_TICKS < recorded.ticks
        )
        calm = not recorded.touching[around].any() and (recorded.held[around] < 0).all()
        if whole and calm and min(seeking[around.start : first].max(), seeking[last : around.stop].max()) > 0.5:
            yield first, last


def strip(images: FilmImages, ticks: list[int]) -> Image:
    """The images of some ticks one below the other."""
    frames = [images.image(tick) for tick in ticks]
    return np.concatenate(
        [cv2.resize(f, None, fx=FRAME_SCALE, fy=FRAME_SCALE, interpolation=cv2.INTER_AREA) for f in frames]
    )
