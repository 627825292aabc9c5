"""What a computed sensor reads while another changes: both over some seconds, computed by the sensor itself."""

from collections.abc import Iterator
from math import nan, sin

import numpy as np
from mindrun.kinds.sensors.sensor import Scene, SensorKind
from mindrun.numbers.arrays import Readings

from docs.reference import svg

WIDTH_PIXELS, HEIGHT_PIXELS = 520, 170
LEFT_PIXELS, RIGHT_PIXELS, TOP_PIXELS, FLOOR_PIXELS = 44, 500, 28, 136
TICK_SECONDS, END_SECONDS = 1 / 20, 8
SOURCE = "moving"
GRID_COLOUR = "#ddd8cc"


def over_time(title: str, sensor: SensorKind) -> str:
    """Draw the readings of a sensor over eight seconds as SVG, those of its source behind them."""
    ticks = round(END_SECONDS / TICK_SECONDS) + 1
    source = [_source(number * TICK_SECONDS) for number in range(ticks)]
    shapes = [*_axes()]
    if sensor.source:
        shapes += [_curve(source, svg.FAINT, 1.5)]
        shapes += [
            svg.words((RIGHT_PIXELS, TOP_PIXELS - 10), f"grey: {SOURCE}; red: this sensor", "end", svg.FAINT, 10)
        ]
    return svg.document(
        WIDTH_PIXELS, HEIGHT_PIXELS, [*shapes, _curve([*_readings(sensor, source)], svg.RED, 2.5)], title
    )


def _source(time: float) -> float:
    """A reading that rises, falls and trembles."""
    return min(1.0, max(0.0, 0.5 + 0.42 * sin(1.28 * time) + 0.09 * sin(9.7 * time)))


def _readings(sensor: SensorKind, source: list[float]) -> Iterator[float]:
    reader = sensor.reader(Scene(TICK_SECONDS, {SOURCE: slice(0, 1)}))
    before: Readings | None = None
    for number, value in enumerate(source):
        now = np.array([value], np.float32)
        yield float(np.ravel(reader(number, now, before))[0]) if reader else nan
        before = now


def _axes() -> Iterator[str]:
    for mark in (0.0, 0.5, 1.0):
        yield svg.line((LEFT_PIXELS, _y(mark)), (RIGHT_PIXELS, _y(mark)), GRID_COLOUR, 1)
        yield svg.words((LEFT_PIXELS - 8, _y(mark) + 4), f"{mark:g}", "end", size=11)
    for second in range(0, END_SECONDS + 1, 2):
        x = LEFT_PIXELS + (RIGHT_PIXELS - LEFT_PIXELS) * second / END_SECONDS
        yield svg.words((x, FLOOR_PIXELS + 20), f"{second} s", "middle", svg.FAINT, 10)


def _curve(values: list[float], colour: str, width: float) -> str:
    step = (RIGHT_PIXELS - LEFT_PIXELS) / (len(values) - 1)
    return svg.path([(LEFT_PIXELS + step * number, _y(value)) for number, value in enumerate(values)], colour, width)


def _y(value: float) -> float:
    return FLOOR_PIXELS - (FLOOR_PIXELS - TOP_PIXELS) * value
