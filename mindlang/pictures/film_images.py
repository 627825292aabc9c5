"""One image of a film, after the paper's Figure 15: the world beside the hierarchy and the readings, or above them."""

from dataclasses import dataclass
from math import ceil
from typing import Any

import numpy as np
from mindrun.graph.run_scores import score_of

from mindlang.pictures import path
from mindlang.pictures.canvas import Canvas, Image, Region, Viewport, blank, flow_layout, letterbox, paste, text_width
from mindlang.pictures.environments import seen_run
from mindlang.pictures.panels import COLUMN_PIXELS, ROW_PIXELS, HierarchyPanel, ReadingsPanel, sensors_read
from mindlang.pictures.scene import (
    WALL_UNITS,
    draw_items,
    draw_names,
    draw_robot,
    draw_zones,
    each_thing,
    empty_world,
    half_sides,
)
from mindlang.pictures.theme import NIGHT
from mindlang.run.outcome import robot_words
from mindlang.run.recorded_run import RecordedRun

FILM_WIDTH, FILM_HEIGHT = 1280, 720  # pixels, the height where the world is square
LEAST_HEIGHT, LEAST_WORLD_WIDTH = 480, 240
LONG_RATIO = 16 / 9  # of width and depth, above which the world has the whole width
TITLE_PIXELS, MARGIN_PIXELS = 86, 8  # above the hierarchy, and around it
LOW_PANEL_PIXELS = 240  # the height of a hierarchy below its world
BELOW_SHARE, BESIDE_SHARE = 0.36, 0.36  # at most of the panel: readings below a hierarchy, or beside it
WINDOW_UNITS = 84.0  # of a plain scene that are seen around the robot
TITLE_INDENT_PIXELS, NAME_LINE_PIXELS, NAME_TEXT_PIXELS = 24.0, 38.0, 17.0  # of the name of the task
TITLE_LINE_PIXELS, TITLE_TEXT_PIXELS, TITLE_GAP_PIXELS = 22.0, 11.0, 22.0
FIRST_LINE_PIXELS = 66.0  # from the upper edge of the title to its first line


@dataclass(frozen=True, slots=True)
class FilmLayout:
    """The size of a film's images, that of the world in their upper left corner, and where all else begins."""

    width: int
    height: int
    world: tuple[int, int]
    left: int
    top: int

    @classmethod
    def of(cls, ratio: float) -> "FilmLayout":
        """The page for a world so many times as wide as deep. Video needs even numbers."""
        if ratio > LONG_RATIO:
            high = _even(FILM_WIDTH / ratio)
            return cls(FILM_WIDTH, high + TITLE_PIXELS + LOW_PANEL_PIXELS, (FILM_WIDTH, high), 0, high)
        wide, high = max(LEAST_WORLD_WIDTH, _even(FILM_HEIGHT * min(1.0, ratio))), _even(FILM_HEIGHT / max(1.0, ratio))
        return cls(FILM_WIDTH, max(LEAST_HEIGHT, high), (wide, high), wide, 0)

    @property
    def panel(self) -> Region:
        left, top = self.left + MARGIN_PIXELS, self.top + TITLE_PIXELS
        return Region(left, top, self.width - left - MARGIN_PIXELS, self.height - top - MARGIN_PIXELS - 2)

    def divided(self, sensors: int, lower: float = 0.0) -> tuple[Region, Region]:
        """The rectangles of the hierarchy and of the readings of so many sensors: below it, or beside where it is low.

        The readings have at most their share, and show what fits. Both begin so many pixels `lower`, for a long title.
        """
        x, y, width, height = self.panel
        y, height = y + lower, height - lower
        if self.left == 0:
            wide = BESIDE_SHARE * width if sensors else 0.0
            return Region(x, y, width - wide, height), Region(x + width - wide, y, wide, height)
        rows = min(ceil(sensors / int(width // COLUMN_PIXELS)), int(BELOW_SHARE * height // ROW_PIXELS))
        high = ROW_PIXELS * rows
        return Region(x, y, width, height - high), Region(x, y + height - high, width, high)


def _even(pixels: float) -> int:
    return 2 * round(pixels / 2)


class FilmImages:
    """Draws any tick of a run: its path of the last `trail` ticks, its collisions of the last `flash` ones."""

    def __init__(self, run: RecordedRun, found: dict[str, Any], speed: float, trail: int, flash: float) -> None:
        self._run, self._found, self._speed = run, found, speed
        self._trail_ticks, self._flash_ticks = trail, flash
        self._path = path.Path.of(run, NIGHT)
        self._seen = seen_run(run, found["seed"]) if run.task.scene.environment else None
        wide, high = self._seen.image(0).shape[1::-1] if self._seen else half_window(run)
        self.layout = FilmLayout.of(float(wide / high))
        lines = self._title_places(self._facts(run.ticks))[-1][1] + 1
        lower = max(0.0, FIRST_LINE_PIXELS + TITLE_LINE_PIXELS * (lines - 0.5) - TITLE_PIXELS)
        hierarchy, readings = self.layout.divided(len(sensors_read(run)), lower)
        self._panel = HierarchyPanel(run, hierarchy)
        self._readings = ReadingsPanel(run, readings)
        page = Canvas.of_page(blank(self.layout.width, self.layout.height, NIGHT.page))
        left, low = self.layout.left + TITLE_INDENT_PIXELS, self.layout.top + NAME_LINE_PIXELS
        page.text(left, low, run.task.name, NAME_TEXT_PIXELS, NIGHT.ink, bold=True)
        self._readings.draw_names(page)
        self._empty_image = page.image
        self._empty_world = self._floor(1).image if run.task.scene.is_bounded else None

    def image(self, tick: int) -> Image:
        """The film's image of a tick, the first of which is 1."""
        return self._drawn(tick, self._world(tick)).image

    def end(self) -> Image:
        """The last image, with a mark where the run ended and the words how."""
        run, found = self._run, self._found
        page = self._drawn(run.ticks, self._world(run.ticks, has_ended=True))
        wide, high = self.layout.world
        if high >= path.LEAST_WORLD_PIXELS:
            path.draw_banner(page, run, found, Region(0.0, 0.0, wide, high), self._occupied())
        else:
            place = self.layout.width - 20, self.layout.top + NAME_LINE_PIXELS
            page.text(*place, path.ending_words(found), 14, path.ending_colour(found, NIGHT), bold=True, align="right")
        return page.image

    def _occupied(self) -> list[Region]:
        """The rectangles of the robot and the things in the end, in pixels; none for an environment."""
        run, view = self._run, self.view(self._run.ticks)
        if self._seen:
            return []
        (x, y, _), radius = run.body[-1], run.graph.body.radius
        places = [np.array([x, y, 2 * radius]), *(place for _, _, place in each_thing(run, NIGHT, run.ticks))]
        corners = [(x - size / 2 - view.left, view.top - y - size / 2, size, size) for x, y, size in places]
        return [Region(*each) for each in (np.array(corners) * view.scale).tolist()]

    def view(self, tick: int) -> Viewport:
        return window(self._run, tick, *self.layout.world)

    def _drawn(self, tick: int, world: Image) -> Canvas:
        page = Canvas.of_page(self._empty_image.copy())
        paste(page.image, world, 0, 0)
        facts = self._facts(tick)
        for text, (along, line) in zip(facts, self._title_places(facts), strict=True):
            low = self.layout.top + FIRST_LINE_PIXELS + TITLE_LINE_PIXELS * line
            page.text(self.layout.left + TITLE_INDENT_PIXELS + along, low, text, TITLE_TEXT_PIXELS, NIGHT.faint)
        self._panel.draw(page, tick)
        self._readings.draw(page, tick)
        return page

    def _floor(self, tick: int) -> Canvas:
        return empty_world(self._run, NIGHT, self.view(tick), *self.layout.world)

    def _world(self, tick: int, has_ended: bool = False) -> Image:
        if self._seen:
            return letterbox(self._seen.image(tick), *self.layout.world, NIGHT.page)
        run = self._run
        empty = self._empty_world
        canvas = self._floor(tick) if empty is None else Canvas(empty.copy(), self.view(tick))
        draw_zones(canvas, run, NIGHT, tick)
        first = max(0, tick - self._trail_ticks)
        path.draw_others(canvas, run, NIGHT, first, tick)
        self._path.draw(canvas, first, tick, 2.0)
        if has_ended:
            path.draw_end_mark(canvas, run, self._found, NIGHT)
        draw_items(canvas, run, NIGHT, tick)
        draw_robot(canvas, run, NIGHT, tick)
        draw_names(canvas, run, NIGHT, tick)
        recent = tick - self._flash_ticks
        for x, y, _ in run.body[run.collisions[(run.collisions > recent) & (run.collisions <= tick)]]:
            path.draw_cross(canvas, x, y, 9 / canvas.view.scale, NIGHT)
        return canvas.image

    def _facts(self, tick: int) -> list[str]:
        run = self._run
        return [
            f"{tick * run.graph.tick:.1f} s",
            f"speed {self._speed:g}",
            f"score {score_of(run.lines[tick - 1]):,.1f}",
            *(f"{event} {times}" for event, times in zip(self._found["counted"], run.counts[tick - 1], strict=True)),
            f"seed {self._found['seed']}{robot_words(self._found)}",
        ]

    def _title_places(self, facts: list[str]) -> list[tuple[float, int]]:
        """The left end and the line of each fact of the title."""
        widths = [text_width(text, TITLE_TEXT_PIXELS) for text in facts]
        return flow_layout(widths, TITLE_GAP_PIXELS, self.layout.width - 12 - self.layout.left - TITLE_INDENT_PIXELS)


def half_window(run: RecordedRun) -> tuple[float, float]:
    """Half of what is seen of the world along x and y: the arena; of a plain scene what is around the robot."""
    scene = run.task.scene
    x, y = half_sides(scene) if scene.is_bounded else (WINDOW_UNITS / 2, WINDOW_UNITS / 2)
    margin = 2 * WALL_UNITS * scene.is_bounded
    return x + margin, y + margin


def window(run: RecordedRun, tick: int, width: int, height: int) -> Viewport:
    half = np.array(half_window(run))
    middle = run.body[tick, :2] * (not run.task.scene.is_bounded)
    return Viewport.around(middle - half, middle + half, width, height)
