"""The film of a run: the world at the left, the hierarchy at the right, as in the paper's Figure 15."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import Any, ClassVar

import cv2
import numpy as np
from mindrun.atomic_write import destination, write

from mindlang.pictures.canvas import Canvas, Image, Viewport, blank, pasted, text_width
from mindlang.pictures.film_layout import FilmLayout
from mindlang.pictures.hierarchy_panel import Panel
from mindlang.pictures.names import draw_names
from mindlang.pictures.path import Path, draw_cross
from mindlang.pictures.robot import draw_robot
from mindlang.pictures.scene import (
    WALL_UNITS,
    draw_floor,
    draw_items,
    draw_zones,
    half_sides,
)
from mindlang.pictures.theme import NIGHT
from mindlang.run.recorded_run import RecordedRun

FILM_SECONDS = 60.0  # that a whole run lasts, sped up
WINDOW_UNITS = 84.0  # of a plain scene that are seen around the robot
TRAIL_SECONDS = 8.0  # of the film for which the path stays
COLLISION_SECONDS = 0.7  # of the film for which a collision does


class FilmError(Exception):
    """A video that cannot be encoded or written; the text is for the user."""


@dataclass(frozen=True, slots=True)
class Film:
    """A run at so many times the robot's speed."""

    run: RecordedRun
    found: dict[str, Any]
    speed: float
    FPS: ClassVar[int] = 30

    @classmethod
    def of(cls, run: RecordedRun, found: dict[str, Any], speed: float | None) -> "Film":
        """A film; without a speed one that shows the whole of the task's time in a minute, if that is not slower."""
        long = run.task.ticks * run.graph.tick
        return cls(run, found, speed or max(1.0, round(long / FILM_SECONDS, 1)))

    @property
    def step(self) -> float:
        """Ticks from one frame to the next."""
        return self.speed / self.FPS / self.run.graph.tick

    @property
    def frames(self) -> int:
        """How many frames the film has; the last shows the last tick."""
        return int(-(-(self.run.ticks - 1) // self.step)) + 1

    def write(self, path: FilePath, wrote: Callable[[], None]) -> None:
        """Encode the film into `path`, which is only replaced when it is whole; `wrote` is told of each frame."""
        place = destination(path)
        spare = place.with_name(f".{place.stem}.part{place.suffix}")
        size = self.layout.width, self.layout.height
        writer = cv2.VideoWriter(str(spare), cv2.VideoWriter.fourcc(*"mp4v"), self.FPS, size)
        try:
            if not writer.isOpened():
                raise FilmError(f"{path} cannot be written: OpenCV cannot encode a video there")
            panel, trail = Panel(self.run, NIGHT, self.layout.panel), Path.of(self.run, NIGHT)
            for number in range(self.frames):
                writer.write(self.frame(panel, trail, min(self.run.ticks, 1 + round(number * self.step))))
                wrote()
            writer.release()
            if _frames_in(spare) != self.frames:
                raise FilmError(f"{path} cannot be written whole: is the disk full?")
            write(place, spare.read_bytes())
        finally:
            writer.release()
            spare.unlink(missing_ok=True)

    def frame(self, panel: Panel, trail: Path, tick: int) -> Image:
        """The film's image of a tick."""
        page = blank(self.layout.width, self.layout.height, NIGHT.page)
        pasted(page, self._world(trail, tick), 0, 0)
        canvas = Canvas(page, Viewport(0.0, 0.0, 1.0), down=True)
        self._title(canvas, tick)
        panel.draw(canvas, tick)
        return page

    def _world(self, trail: Path, tick: int) -> Image:
        run, past = self.run, round(TRAIL_SECONDS * self.FPS * self.step)
        canvas = Canvas(blank(*self.layout.world, self._ground), self.view(tick))
        draw_floor(canvas, run, NIGHT)
        draw_zones(canvas, run, NIGHT, tick)
        trail.draw(canvas, max(0, tick - past), tick, 2.0)
        draw_items(canvas, run, NIGHT, tick)
        draw_robot(canvas, run, NIGHT, tick)
        draw_names(canvas, run, NIGHT, tick)
        recent = tick - COLLISION_SECONDS * self.FPS * self.step
        for x, y, _ in run.body[run.collisions[(run.collisions > recent) & (run.collisions <= tick)]]:
            draw_cross(canvas, x, y, 9 / canvas.view.scale, NIGHT)
        return canvas.image

    @property
    def layout(self) -> FilmLayout:
        """How its images are divided."""
        wide, deep = self._half_sides
        return FilmLayout.of(wide / deep)

    @property
    def _half_sides(self) -> tuple[float, float]:
        """Half of what is seen of the world along x and y: the arena; of a plain scene what is around the robot."""
        scene = self.run.task.scene
        x, y = half_sides(scene) if scene.is_bounded else (WINDOW_UNITS / 2, WINDOW_UNITS / 2)
        margin = 2 * WALL_UNITS * scene.is_bounded
        return x + margin, y + margin

    def view(self, tick: int) -> Viewport:
        """What is seen of the world in a tick."""
        half = np.array(self._half_sides)
        middle = self.run.body[tick, :2] * (not self.run.task.scene.is_bounded)
        return Viewport.around(middle - half, middle + half, *self.layout.world)

    @property
    def _ground(self) -> tuple[int, int, int]:
        return NIGHT.page if self.run.task.scene.is_bounded else NIGHT.floor

    def _title(self, canvas: Canvas, tick: int) -> None:
        run, left, y = self.run, self.layout.left + 24.0, self.layout.top + 66.0
        canvas.text(left, y - 28, run.task.name, 17, NIGHT.ink, bold=True)
        said: list[str] = [
            f"{tick * run.graph.tick:.1f} s",
            f"speed {self.speed:g}",
            f"score {run.lines[tick - 1].sum():,.1f}",
            *(f"{event} {times}" for event, times in zip(self.found["counted"], run.counts[tick - 1], strict=True)),
            f"seed {self.found['seed']}",
        ]
        for text in said:
            if left + text_width(text, 11) > self.layout.width - 12:
                left, y = self.layout.left + 24.0, y + 22
            left += canvas.text(left, y, text, 11, NIGHT.faint) + 22


def _frames_in(path: FilePath) -> int:
    video = cv2.VideoCapture(str(path))
    count = int(video.get(cv2.CAP_PROP_FRAME_COUNT))
    video.release()
    return count
