"""The robot of a run: its body, its rays, its claw, its lamps, and where its thrusters push."""

from math import cos, sin

import numpy as np
from mindrun.bodies import BodyKind
from numpy.typing import ArrayLike, NDArray

from mindlang.pictures.canvas import Canvas
from mindlang.pictures.recorded_run import RecordedRun
from mindlang.pictures.theme import Theme

Floats = NDArray[np.float64]


def draw_robot(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """The robot as it is after a tick: rays, claw, body, and a line that shows its heading."""
    x, y, angle = run.body[tick]
    body = run.graph.body
    if tick:
        _rays(canvas, run, theme, tick)
        _claw(canvas, run, theme, tick)
    _outline(canvas, body, run.body[tick], theme)
    tip = (x + 0.95 * body.front * cos(angle), y + 0.95 * body.front * sin(angle))
    canvas.line([(x, y), tip], theme.floor, 2.0)
    if tick:
        _lamps(canvas, run, theme, tick)


def _outline(canvas: Canvas, body: BodyKind, pose: Floats, theme: Theme) -> None:
    if body.outline:
        corners = _placed(body.outline, pose)
        canvas.polygon(corners, theme.robot)
        canvas.line(corners, theme.floor, 1.2, closed=True)
    else:
        canvas.disc(pose[0], pose[1], body.radius, theme.robot)
        canvas.disc(pose[0], pose[1], body.radius, theme.floor, width=1.2)


def _placed(points: ArrayLike, pose: Floats) -> Floats:
    """Points [n, 2] of the robot in the world."""
    x, y, angle = pose
    turned = np.asarray(points, float) @ np.array([(cos(angle), sin(angle)), (-sin(angle), cos(angle))])
    placed: Floats = turned + np.array([x, y])
    return placed


def _lamps(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """A glow for each lamp, the first in the middle, as bright as its command."""
    lamps = [number for number, actuator in enumerate(run.graph.actuators) if actuator.kind.is_light]
    radius = run.graph.body.side / (2 + len(lamps))
    for place, number in enumerate(lamps):
        (x, y), bright = (
            _placed([(-2.0 * radius * place, 0.0)], run.body[tick])[0],
            float(run.commands[tick - 1, number]),
        )
        canvas.disc(x, y, 0.7 * radius, theme.floor)
        canvas.disc(x, y, 0.7 * radius, theme.lamp, bright)
        canvas.disc(x, y, 1.6 * radius, theme.lamp, 0.4 * bright)


def _rays(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    x, y, angle = run.body[tick]
    for sensor in run.graph.sensors:
        rows = slice(sensor.start, sensor.start + sensor.width)
        if not sensor.kind.rays or not run.readings[:, rows].any():  # nobody reads it
            continue
        for at, reading in zip(sensor.kind.rays, run.readings[tick - 1, rows], strict=True):
            if sensor.kind.pierces and reading == 1.0:  # how far an eye saw is not known: something may be in the way
                continue
            way = np.array([cos(angle + at), sin(angle + at)])
            rim = run.graph.body.rim(at)
            end = (x, y) + way * (rim + float(reading) * sensor.kind.reach)
            canvas.line([(x, y) + way * rim, end], theme.ray, 1.0, 0.3 + 0.4 * (reading < 1.0))
            if reading < 1.0:
                canvas.disc(end[0], end[1], 2.5 * canvas.pen / canvas.view.scale, theme.ray)


def _claw(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    body = run.graph.body
    for number, actuator in enumerate(run.graph.actuators):
        if actuator.kind.can_hold:
            apart = 0.35 if run.commands[tick - 1, number] > 0.5 else 0.75
            for side in (-1.0, 1.0):
                shape = np.array([(-0.2, 0.5 * side), (0.4, apart * side), (0.9, apart * 0.8 * side)]) * body.side
                canvas.line(_placed(shape + np.array([body.front, 0.0]), run.body[tick]), theme.robot, 2.2)
