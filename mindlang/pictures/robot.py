"""The robot of a run: its body, its claw, its lamps, the wheels of a car, and where its thrusters push."""

import numpy as np
from mindrun.kinds.bodies.body import BodyKind

from mindlang.pictures.canvas import Canvas, rectangle
from mindlang.pictures.pose import Floats, placed
from mindlang.pictures.sensing import draw_rays, draw_spots, draw_touches
from mindlang.pictures.theme import Theme
from mindlang.run.recorded_run import RecordedRun

LIT_COMMAND = 0.5  # of a lamp: above it, it throws a beam
BEAM_UNITS, BEAM_SLOPE = 5.0, 0.4  # how many of its sides a beam is long, and how fast it widens
JET_SIDES = 1.6  # how long a thruster's jet is at most: one in the middle of the body is seen, too
WHEEL_SHARES = 0.16, 0.07  # half of a car's wheel, long and wide: shares of the car's length


def draw_robot(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """The robot as it is after a tick: what it senses, claw, body, and a line that shows its heading."""
    x, y, angle = run.body[tick]
    body = run.graph.body
    if tick:
        draw_rays(canvas, run, theme, tick)
        _claw(canvas, run, theme, tick)
        _jets(canvas, run, theme, tick)
    _outline(canvas, body, run.body[tick], theme)
    _wheels(canvas, run, theme, tick)
    tip = (x + 0.95 * body.front * np.cos(angle), y + 0.95 * body.front * np.sin(angle))
    canvas.line([(x, y), tip], theme.floor, 2.0)
    _lamps(canvas, run, theme, tick)
    draw_touches(canvas, run, theme, tick)
    draw_spots(canvas, run, theme, tick)


def _outline(canvas: Canvas, body: BodyKind, pose: Floats, theme: Theme) -> None:
    if body.outline:
        corners = placed(body.outline, pose)
        canvas.polygon(corners, theme.robot)
        canvas.line(corners, theme.floor, 1.2, closed=True)
    else:
        canvas.disc(pose[0], pose[1], body.radius, theme.robot)
        canvas.disc(pose[0], pose[1], body.radius, theme.floor, width=1.2)


def _wheels(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """The four wheels of a car, the front ones turned."""
    body = run.graph.body
    long, wide = (share * 2 * body.front for share in WHEEL_SHARES)
    for ahead, turn in ((-0.5, 0.0), (0.5, steering_angle(run, tick))):
        for side in (body.side, -body.side) if body.axle_distance else ():
            wheel = placed(rectangle(0, 0, long, wide), np.array([ahead * body.axle_distance, side, turn]))
            shape = placed(wheel, run.body[tick])
            canvas.polygon(shape, theme.robot)
            canvas.line(shape, theme.floor, 1.0, closed=True)


def steering_angle(run: RecordedRun, tick: int) -> float:
    """How far a car's front wheels are turned after a tick, counterclockwise."""
    for number, actuator in enumerate(run.graph.actuators):
        if actuator.kind.drive == "steering":
            command = float(run.commands[tick - 1, number]) if tick else actuator.kind.neutral
            return (1 - 2 * command) * actuator.kind.row(run.graph.body)["turn"]
    return 0.0


def _jets(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """What each thruster throws, away from where it pushes, as long as its force is strong."""
    body, pose = run.graph.body, run.body[tick]
    for number, actuator in enumerate(run.graph.actuators):
        if (push := actuator.kind.push(body)) is not None:
            at, way = (np.array(each) for each in push)
            force = 2 * float(run.commands[tick - 1, number]) - 1
            canvas.line(placed([at, at - JET_SIDES * body.side * force * way], pose), theme.lamp, 4.0)


def _lamps(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """The lamps side by side in front, each as bright as its command; one that is lit throws a beam."""
    lamps = [number for number, actuator in enumerate(run.graph.actuators) if actuator.kind.is_light]
    body, pose = run.graph.body, run.body[tick]
    size = 0.7 * body.side / (2 + len(lamps))
    for place, number in enumerate(lamps):
        kind = run.graph.actuators[number].kind
        bright = float(run.commands[tick - 1, number]) if tick else kind.neutral
        ahead, aside = 0.6 * body.front, ((len(lamps) - 1) / 2 - place) * 2.4 * size
        if bright > LIT_COMMAND:
            far, wide = BEAM_UNITS * body.side, BEAM_SLOPE * BEAM_UNITS * body.side
            ends = [(ahead + far, aside - wide), (ahead + far, aside + wide)]
            canvas.polygon(placed([(ahead, aside), *ends], pose), theme.lamp, 0.35 * bright)
        [(x, y)] = placed([(ahead, aside)], pose)
        canvas.disc(x, y, size, theme.floor)
        canvas.disc(x, y, size, theme.lamp, bright)
        canvas.disc(x, y, 1.9 * size, theme.lamp, 0.4 * bright)


def _claw(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    body = run.graph.body
    for number, actuator in enumerate(run.graph.actuators):
        if actuator.kind.can_hold:
            apart = 0.35 if run.commands[tick - 1, number] > 0.5 else 0.75
            for side in (-1.0, 1.0):
                shape = np.array([(-0.2, 0.5 * side), (0.4, apart * side), (0.9, apart * 0.8 * side)]) * body.side
                canvas.line(placed(shape + np.array([body.front, 0.0]), run.body[tick]), theme.robot, 2.2)
