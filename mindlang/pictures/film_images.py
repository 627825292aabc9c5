"""One image of a film: the world at the left, hierarchy and readings at the right, after the paper's Figure 15."""

from typing import Any

import numpy as np
from mindrun.graph.run_scores import score_of

from mindlang.pictures.canvas import Canvas, Image, Viewport, blank, pasted, text_width
from mindlang.pictures.ending import LEAST_WORLD_PIXELS, draw_banner, draw_end_mark, ending_colour, ending_words
from mindlang.pictures.film_layout import TITLE_PIXELS, FilmLayout
from mindlang.pictures.hierarchy_panel import Panel
from mindlang.pictures.layout import Place
from mindlang.pictures.names import Label, draw_names
from mindlang.pictures.path import Path, draw_cross
from mindlang.pictures.readings_panel import ReadingsPanel, sensors_read
from mindlang.pictures.robot import draw_robot
from mindlang.pictures.scene import WALL_UNITS, draw_floor, draw_items, draw_zones, each_thing, half_sides
from mindlang.pictures.theme import NIGHT
from mindlang.run.recorded_run import RecordedRun

WINDOW_UNITS = 84.0  # of a plain scene that are seen around the robot
TITLE_LINE_PIXELS, TITLE_TEXT_PIXELS, TITLE_GAP_PIXELS = 22.0, 11.0, 22.0
FIRST_LINE_PIXELS = 66.0  # from the upper edge of the title to its first line


class FilmImages:
    """Draws any tick of a run: its path of the last `trail` ticks, its collisions of the last `flash` ones."""

    def __init__(self, run: RecordedRun, found: dict[str, Any], speed: float, trail: int, flash: float) -> None:
        self._run, self._found, self._speed = run, found, speed
        self._trail_ticks, self._flash_ticks = trail, flash
        self._path = Path.of(run, NIGHT)
        self.layout = FilmLayout.of(self.ratio())
        lines = self._title_places(self._facts(run.ticks))[-1][1] + 1
        lower = max(0.0, FIRST_LINE_PIXELS + TITLE_LINE_PIXELS * (lines - 0.5) - TITLE_PIXELS)
        hierarchy, readings = self.layout.divided(len(sensors_read(run)), lower)
        self._panel = Panel(run, NIGHT, hierarchy)
        self._readings = ReadingsPanel(run, NIGHT, readings)
        self._empty_image = self._drawn_once()
        self._empty_world = self._floor(1) if run.task.scene.is_bounded else None

    def ratio(self) -> float:
        """How many times as wide as deep the world is that is seen."""
        return float(np.divide(*half_window(self._run)))

    def image(self, tick: int) -> Image:
        """The film's image of a tick, the first of which is 1."""
        return self._drawn(tick, self._world(tick))

    def end(self) -> Image:
        """The last image, with a mark where the run ended and the words how."""
        run, found, tick = self._run, self._found, self._run.ticks
        page = self._drawn(tick, self._world(tick, has_ended=True))
        over = Canvas(page, Viewport(0.0, 0.0, 1.0), down=True)
        wide, high = self.layout.world
        if high >= LEAST_WORLD_PIXELS:
            draw_banner(over, run, found, NIGHT, Place(0.0, 0.0, wide, high), self._occupied(self.view(tick)))
        else:
            words, colour = ending_words(found), ending_colour(found, NIGHT)
            over.text(self.layout.width - 20, self.layout.top + 38, words, 14, colour, bold=True, align="right")
        return page

    def _occupied(self, view: Viewport) -> list[Label]:
        """Where the robot and the things are in the end, in pixels, by their upper left corners."""
        (x, y, _), radius = self._run.body[-1], self._run.graph.body.radius
        things = [place.tolist() for _, _, place in each_thing(self._run, NIGHT, self._run.ticks)]
        corners = [(x - size / 2, y + size / 2, size) for x, y, size in ((x, y, 2 * radius), *things)]
        placed = (np.array(corners) - [view.left, view.top, 0.0]) * view.scale * [1.0, -1.0, 1.0]
        return [Label(left, top, size, size) for left, top, size in placed.tolist()]

    def view(self, tick: int) -> Viewport:
        """What is seen of the world in a tick."""
        half = np.array(half_window(self._run))
        middle = self._run.body[tick, :2] * (not self._run.task.scene.is_bounded)
        return Viewport.around(middle - half, middle + half, *self.layout.world)

    def _drawn_once(self) -> Image:
        """What no tick changes: the page, the name of the task and those of the sensors."""
        page = blank(self.layout.width, self.layout.height, NIGHT.page)
        canvas = Canvas(page, Viewport(0.0, 0.0, 1.0), down=True)
        canvas.text(self.layout.left + 24.0, self.layout.top + 38.0, self._run.task.name, 17, NIGHT.ink, bold=True)
        self._readings.draw_names(canvas)
        return page

    def _drawn(self, tick: int, world: Image) -> Image:
        page = self._empty_image.copy()
        pasted(page, world, 0, 0)
        canvas = Canvas(page, Viewport(0.0, 0.0, 1.0), down=True)
        facts = self._facts(tick)
        for text, (left, line) in zip(facts, self._title_places(facts), strict=True):
            low = self.layout.top + FIRST_LINE_PIXELS + TITLE_LINE_PIXELS * line
            canvas.text(left, low, text, TITLE_TEXT_PIXELS, NIGHT.faint)
        self._panel.draw(canvas, tick)
        self._readings.draw(canvas, tick)
        return page

    def _floor(self, tick: int) -> Image:
        ground = NIGHT.page if self._run.task.scene.is_bounded else NIGHT.floor
        canvas = Canvas(blank(*self.layout.world, ground), self.view(tick))
        draw_floor(canvas, self._run, NIGHT)
        return canvas.image

    def _world(self, tick: int, has_ended: bool = False) -> Image:
        run = self._run
        image = self._floor(tick) if self._empty_world is None else self._empty_world.copy()
        canvas = Canvas(image, self.view(tick))
        draw_zones(canvas, run, NIGHT, tick)
        self._path.draw(canvas, max(0, tick - self._trail_ticks), tick, 2.0)
        if has_ended:
            draw_end_mark(canvas, run, self._found, NIGHT)
        draw_items(canvas, run, NIGHT, tick)
        draw_robot(canvas, run, NIGHT, tick)
        draw_names(canvas, run, NIGHT, tick)
        recent = tick - self._flash_ticks
        for x, y, _ in run.body[run.collisions[(run.collisions > recent) & (run.collisions <= tick)]]:
            draw_cross(canvas, x, y, 9 / canvas.view.scale, NIGHT)
        return canvas.image

    def _facts(self, tick: int) -> list[str]:
        run = self._run
        return [
            f"{tick * run.graph.tick:.1f} s",
            f"speed {self._speed:g}",
            f"score {score_of(run.lines[tick - 1]):,.1f}",
            *(f"{event} {times}" for event, times in zip(self._found["counted"], run.counts[tick - 1], strict=True)),
            f"seed {self._found['seed']}",
        ]

    def _title_places(self, facts: list[str]) -> list[tuple[float, int]]:
        """Where each fact begins, and in which line."""
        begin = self.layout.left + 24.0
        left, line, places = begin, 0, []
        for text in facts:
            wide = text_width(text, TITLE_TEXT_PIXELS)
            if left > begin and left + wide > self.layout.width - 12:
                left, line = begin, line + 1
            places.append((left, line))
            left += wide + TITLE_GAP_PIXELS
        return places


def half_window(run: RecordedRun) -> tuple[float, float]:
    """Half of what is seen of the world along x and y: the arena; of a plain scene what is around the robot."""
    scene = run.task.scene
    x, y = half_sides(scene) if scene.is_bounded else (WINDOW_UNITS / 2, WINDOW_UNITS / 2)
    margin = 2 * WALL_UNITS * scene.is_bounded
    return x + margin, y + margin
