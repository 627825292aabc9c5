"""What the robot's sensors look at: rays, points of the floor, and switches around the body; what is seen is lit."""

import numpy as np

from mindlang.pictures.canvas import Canvas
from mindlang.pictures.pose import Floats, placed
from mindlang.pictures.theme import Theme
from mindlang.run.recorded_run import RecordedRun

RAY_END_PIXELS, SPOT_PIXELS = 2.5, 2.6  # radii
SECTOR_POINTS = 9  # of the line that shows a switch
SECTOR_PIXELS = 3.0  # the width of that line


def draw_rays(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """Each ray as far as it went."""
    x, y, angle = run.body[tick]
    for sensor in (each for each in run.graph.sensors if each.kind.rays):
        rows = slice(sensor.start, sensor.start + sensor.width)
        for at, reading in zip(sensor.kind.rays, run.readings[tick - 1, rows], strict=True):
            # How far an eye saw is not known: something may be in the way; nor what was not measured.
            if np.isnan(reading) or (sensor.kind.thing and reading == 1.0):
                continue
            way = np.array([np.cos(angle + at), np.sin(angle + at)])
            rim = run.graph.body.rim(at)
            end = (x, y) + way * (rim + float(reading) * sensor.kind.reach)
            canvas.line([(x, y) + way * rim, end], theme.ray, 1.0, 0.3 + 0.4 * (reading < 1.0))
            if reading < 1.0:
                canvas.disc(end[0], end[1], RAY_END_PIXELS * canvas.pen / canvas.view.scale, theme.ray)


def draw_touches(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """Each switch of a bumper along the rim of the body, lit where it is pressed; the pressed ones lie on top."""
    shown = [
        (float(reading), _rim(run, at, sensor.kind.sector))
        for sensor in run.graph.sensors
        if sensor.kind.sector
        for at, reading in zip(sensor.kind.directions, _readings(run, sensor.start, sensor.width, tick), strict=True)
        if not np.isnan(reading)
    ]
    for reading, points in sorted(shown, key=lambda switch: switch[0]):
        line = placed(points, run.body[tick])
        canvas.line(line, theme.floor, SECTOR_PIXELS + 1.5)
        canvas.line(line, theme.crash if reading > 0.5 else theme.faint, SECTOR_PIXELS)


def draw_spots(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """Each point of the floor that a sensor looks down at, filled where it is over what it looks for."""
    radius = SPOT_PIXELS * canvas.pen / canvas.view.scale
    for sensor in run.graph.sensors:
        if sensor.kind.spots:
            readings = _readings(run, sensor.start, sensor.width, tick)
            for (x, y), reading in zip(placed(sensor.kind.spots, run.body[tick]), readings, strict=True):
                if not np.isnan(reading):
                    canvas.disc(x, y, radius, theme.ray if reading > 0.5 else theme.floor)
                    canvas.disc(x, y, radius, theme.ray, width=1.0)


def _readings(run: RecordedRun, start: int, width: int, tick: int) -> Floats:
    """What a sensor reads in a tick; as the run begins, nothing yet."""
    return run.readings[tick - 1, start : start + width].astype(float) if tick else np.zeros(width)


def _rim(run: RecordedRun, at: float, sector: float) -> Floats:
    """Points [n, 2] along the part of the rim, in the frame of the body, that is so wide around a direction."""
    angles = at + np.linspace(-sector / 2, sector / 2, SECTOR_POINTS)
    return np.array([(np.cos(angle), np.sin(angle)) for angle in angles]) * [
        [run.graph.body.rim(angle)] for angle in angles
    ]
