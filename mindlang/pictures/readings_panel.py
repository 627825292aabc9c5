"""The readings of one tick as a panel: beside each name a bar and its number, or a small bar for each reading."""

from collections.abc import Sequence

import numpy as np
from mindrun.graph.graph import Sensor
from mindrun.graph.weights import reachable
from numpy.typing import NDArray

from mindlang.pictures.canvas import Canvas, Region, text_width
from mindlang.pictures.theme import NIGHT
from mindlang.run.recorded_run import RecordedRun

TEXT_PIXELS, MIN_TEXT_PIXELS = 9.0, 6.5  # capitals
ROW_PIXELS, COLUMN_PIXELS = 20.0, 250.0  # of a sensor's readings
INDENT_PIXELS = 10.0  # on both sides of a cell
NAME_SHARE, NUMBER_SHARE = 0.54, 0.14  # of a cell: what its name and its number have
BAR_PIXELS, MANY_BARS_PIXELS = 5.0, 13.0  # the height of a bar, and of each among many
LEAST_BAR_PIXELS = 3.0  # the width of one bar among many: where there are more, some are left out


def sensors_read(run: RecordedRun) -> list[Sensor]:
    """The sensors that the master, or a skill that it can influence, reads; no other one is measured."""
    read = {index for skill in reachable(run.graph, run.setup.master) for index in skill.inputs}
    return [s for s in run.graph.sensors if not read.isdisjoint(range(s.start, s.start + s.width))]


class ReadingsPanel:
    """Draws the readings of a run into a rectangle of a canvas, as many sensors as fit."""

    def __init__(self, run: RecordedRun, room: Region) -> None:
        self._run = run
        self._sensors, self._cells, self._left_out = cell_layout(sensors_read(run), room)

    def draw_names(self, canvas: Canvas) -> None:
        """Draw what no tick changes: the names, and how many sensors are not shown."""
        names = [sensor.name for sensor in self._sensors]
        names += [f"and {self._left_out} more"] * (self._left_out > 0)
        for name, cell in zip(names, self._cells, strict=False):
            text, size = fit_name(name, NAME_SHARE * cell.width - 8)
            canvas.text(cell.left, cell.low + size / 2, text, size, NIGHT.faint)

    def draw(self, canvas: Canvas, tick: int) -> None:
        """Draw the readings in a tick, the first of which is 1."""
        for sensor, cell in zip(self._sensors, self._cells, strict=False):
            values = self._run.readings[tick - 1, sensor.start : sensor.start + sensor.width].astype(float)
            left, right = cell.left + NAME_SHARE * cell.width, cell.left + cell.width
            if len(values) == 1:
                self._number(canvas, float(values[0]), left, right - NUMBER_SHARE * cell.width, right, cell.low)
            else:
                self._many(canvas, values, left, right, cell.low)

    def _number(self, canvas: Canvas, value: float, left: float, end: float, right: float, y: float) -> None:
        share = _shares(np.array([value]))[0]
        canvas.line([(left, y), (end, y)], NIGHT.dark, BAR_PIXELS)
        if share > 0:
            canvas.line([(left, y), (left + share * (end - left), y)], NIGHT.ray, BAR_PIXELS)
        canvas.text(right, y + TEXT_PIXELS / 2, f"{value:.2f}", TEXT_PIXELS, NIGHT.ink, align="right")

    def _many(self, canvas: Canvas, values: NDArray[np.float64], left: float, right: float, y: float) -> None:
        """Draw bars of readings side by side; where there are too many, of some at equal distances."""
        low = y + MANY_BARS_PIXELS / 2
        count = min(len(values), int((right - left) // LEAST_BAR_PIXELS))
        shown = _shares(values)[np.linspace(0, len(values) - 1, count).astype(int)]
        wide = (right - left) / count
        for number, share in enumerate(shown):
            begin, end = left + number * wide, left + (number + 1) * wide - 1
            for high, colour in ((1.0, NIGHT.dark), (float(share), NIGHT.ray)):
                top = low - high * MANY_BARS_PIXELS
                if high > 0:
                    canvas.polygon([(begin, low), (end, low), (end, top), (begin, top)], colour)


def cell_layout(sensors: Sequence[Sensor], room: Region) -> tuple[Sequence[Sensor], list[Region], int]:
    """The sensors that are shown in a room, the cells column by column, and how many are left out: the last says that.

    A cell is given by its left end and its middle row.
    """
    columns = max(1, int(room.width // COLUMN_PIXELS))
    rows = min(int(room.height // ROW_PIXELS), -(-len(sensors) // columns))
    wide, cells = room.width / columns, []
    for number in range(min(len(sensors), rows * columns)):
        column, row = divmod(number, rows)
        left = room.left + column * wide + INDENT_PIXELS
        cells.append(Region(left, room.low + (row + 0.5) * ROW_PIXELS, wide - 2 * INDENT_PIXELS, ROW_PIXELS))
    shown = len(cells) if len(sensors) <= len(cells) else max(0, len(cells) - 1)
    return sensors[:shown], cells, len(sensors) - shown


def fit_name(name: str, room: float) -> tuple[str, float]:
    """A name and its size such that it is not wider than so many pixels: smaller, and if that is not enough, cut."""
    size = TEXT_PIXELS
    while size > MIN_TEXT_PIXELS and text_width(name, size) > room:
        size -= 0.5
    text = name
    while len(text) > 1 and text_width(text, size) > room:
        name = name[:-1]
        text = f"{name}.."
    return text, size


def _shares(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Readings as the lengths of bars, 0 to 1; what is not a finite number has none."""
    return np.clip(np.where(np.isfinite(values), values, 0.0), 0.0, 1.0)
