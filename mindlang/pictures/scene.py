"""The world of a run: floor, walls, obstacles and things, each with its name beside it and none over another.

Of the robot its body is drawn, what moves it, and what its sensors look at; what is seen is lit.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import cycle
from math import cos, sin
from operator import itemgetter
from typing import NamedTuple

import numpy as np
from mindrun.graph.graph import Thing
from mindrun.graph.named_readings import servo_reading
from mindrun.kinds.actuators.actuator import ActuatorKind
from mindrun.kinds.registry import names
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.kinds.sensors.sensor import SensorKind
from mindrun.sim.numbering import opened_boxes
from numpy.typing import ArrayLike, NDArray

from mindlang.pictures.canvas import Canvas, Region, Viewport, blank, rectangle_corners, text_width
from mindlang.pictures.theme import Colour, Theme, mixed
from mindlang.run.recorded_run import RecordedRun

Floats = NDArray[np.float64]
GRID_UNITS = 10.0
WALL_UNITS = 0.8
MAX_NAMED_COPIES = 6  # things of one name that each have it beside them
NAME_PIXELS = 10.0  # the capitals of a thing's name
GAP_PIXELS = 4.0  # between a thing and its name
MAX_LINES_AWAY = 8  # how far a name gives way to others


def to_world(points: ArrayLike, pose: Floats) -> Floats:
    """Points [n, 2] of a body in the world, where it stands at x, y and is turned by an angle."""
    x, y, angle = pose
    turned = np.asarray(points, float) @ np.array([(cos(angle), sin(angle)), (-sin(angle), cos(angle))])
    there: Floats = turned + np.array([x, y])
    return there


def empty_world(run: RecordedRun, theme: Theme, view: Viewport, width: int, height: int, pen: float = 1.0) -> Canvas:
    """An image of the floor with a line every ten units, the walls and the obstacles; of what opens the rim alone."""
    canvas = Canvas(blank(width, height, theme.page if run.task.scene.is_bounded else theme.floor), view, pen)
    left, right, low, high = view.left, view.left + width / view.scale, view.top - height / view.scale, view.top
    if run.task.scene.is_bounded:
        right, high = half_sides(run.task.scene)
        left, low = -right, -high
        canvas.polygon(rectangle_corners(0, 0, right + WALL_UNITS, high + WALL_UNITS), theme.wall)
        canvas.polygon(rectangle_corners(0, 0, right, high), theme.floor)
    for x in _grid(left, right):
        canvas.line([(x, low), (x, high)], theme.grid)
    for y in _grid(low, high):
        canvas.line([(left, y), (right, y)], theme.grid)
    for box in run.standing.values():
        canvas.line(rectangle_corners(*box), theme.rock_edge, 2.4, closed=True)
    opened = opened_boxes(run.task)
    for number, box in run.standing.items():
        canvas.polygon(rectangle_corners(*box), theme.floor if number in opened else theme.rock)
    return canvas


def _grid(first: float, last: float) -> Floats:
    return np.arange((np.floor(first / GRID_UNITS) + 1) * GRID_UNITS, last - 1e-6, GRID_UNITS)


def half_sides(scene: SceneKind) -> tuple[float, float]:
    width, depth = scene.sides
    return width / 2, depth / 2


def thing_colours(things: Sequence[Thing], theme: Theme) -> list[Colour]:
    """A colour for each name: the one that it says (`red`, `red_bin`), else the next of its kind, round and round."""
    left = {name: cycle(colours) for name, colours in theme.things.items()}
    known: dict[str, Colour] = {}
    for thing in things:
        if thing.name not in known:
            said = next((theme.named[word] for word in thing.name.split("_") if word in theme.named), None)
            known[thing.name] = said or next(left[names()[type(thing.kind)]])
    return [known[thing.name] for thing in things]


def each_thing(run: RecordedRun, theme: Theme, tick: int) -> Iterable[tuple[Thing, Colour, Floats]]:
    """Every thing that has not vanished, its colour, and its place and size after a tick."""
    each = zip(run.contents, thing_colours(run.contents, theme), run.things[tick], strict=True)
    return (found for found in each if np.isfinite(found[2][0]))


def draw_zones(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """Draw the zones as they are after a tick: below the path."""
    for thing, fill, (x, y, size) in each_thing(run, theme, tick):
        if thing.kind.is_area:
            corners = rectangle_corners(x, y, size / 2, size / 2)
            canvas.polygon(corners, fill, 0.22)
            canvas.line(corners, fill, 1.6, closed=True)


def draw_items(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """Draw the items, boxes, balls and other robots as they are after a tick."""
    turned = run.turned[tick][np.isfinite(run.things[tick, :, 0])]
    for (thing, fill, (x, y, size)), angle in zip(each_thing(run, theme, tick), turned, strict=True):
        edge = mixed(fill, theme.ink, 0.45)
        if thing.kind.is_robot:
            _body(canvas, run, fill, theme, np.array([x, y, angle]))
        elif thing.kind.is_round:
            canvas.disc(x, y, size / 2, fill)
            canvas.disc(x, y, size / 2, edge, width=1.2)
        elif not thing.kind.is_area:
            shape = to_world(rectangle_corners(0.0, 0.0, size / 2, size / 2), np.array([x, y, angle]))
            canvas.polygon(shape, fill)
            canvas.line(shape, edge, 1.2, closed=True)


class SceneLabel(NamedTuple):
    """Words with capitals of so many `pixels`, and the place and size of what they are about."""

    words: str
    pixels: float
    colour: Colour
    x: float
    y: float
    size: float


def draw_names(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int, ending: SceneLabel | None = None) -> None:
    """Draw the name of each thing in sight: below it, or where neither the robot nor a thing nor another name is.

    Of many things of one name the first alone has it. Words about the robot, how its run ended, stand beside it.
    """
    pixel = 1 / canvas.view.scale
    (height, width), (left, top) = canvas.image.shape[:2], (canvas.view.left, canvas.view.top)
    sight = Region(left, top - height * pixel, width * pixel, height * pixel)
    gap = GAP_PIXELS * canvas.pixel
    (x, y, _), radius = run.body[tick], run.graph.body.radius
    each = list(each_thing(run, theme, tick))
    squares = [np.array((x, y, 2 * radius)), *(place for thing, _, place in each if not thing.kind.is_area)]
    taken = [Region(x - side / 2, y - side / 2, side, side) for x, y, side in squares]
    many = Counter(run.labels)
    labels = [name for name, there in zip(run.labels, run.things[tick], strict=True) if np.isfinite(there[0])]
    said: dict[int | str | None, SceneLabel] = {None: ending} if ending else {}
    for number, (name, (_, _, there)) in enumerate(zip(labels, each, strict=True)):
        if Region(there[0], there[1], 0.0, 0.0).is_within(sight):
            key: int | str = number if many[name] <= MAX_NAMED_COPIES else name
            said.setdefault(key, SceneLabel(name, NAME_PIXELS, theme.ink, *there))
    for text in said.values():
        high, wide = text.pixels * canvas.pixel, text_width(text.words, text.pixels * canvas.pen) * pixel
        middle = min(max(text.x, left + wide / 2), left + width * pixel - wide / 2)
        below = Region(middle - wide / 2, text.y - text.size / 2 - gap - high, wide, high)
        place = free(_places(below, text, gap), taken, sight)
        taken.append(place._replace(low=place.low - gap / 2, height=high + gap))
        canvas.text(place.left, place.low, text.words, text.pixels, text.colour, halo=theme.floor)


def _places(below: Region, text: SceneLabel, gap: float) -> Iterator[Region]:
    above = below._replace(low=text.y + text.size / 2 + gap)
    yield from (below, above)
    level = below._replace(low=text.y - below.height / 2)
    aside = text.size / 2 + gap
    yield from (level._replace(left=text.x + aside), level._replace(left=text.x - aside - below.width))
    for line in range(1, MAX_LINES_AWAY):
        away = line * (below.height + gap)
        yield from (below._replace(low=below.low - away), above._replace(low=above.low + away))


def free(places: Iterable[Region], taken: Iterable[Region], sight: Region) -> Region:
    """The first of the places that is in sight and free; the very first, where none is."""
    choices, occupied = list(places), list(taken)
    for place in choices:
        if place.is_within(sight) and not any(place.overlaps(other) for other in occupied):
            return place
    return choices[0]


LIT_COMMAND = 0.5  # of a lamp: above it, it throws a beam
BEAM_UNITS, BEAM_SLOPE = 5.0, 0.4  # how many of its sides a beam is long, and how fast it widens
JET_SIDES = 1.6  # how long a thruster's jet is at most: one in the middle of the body is seen, too
WHEEL_SHARES = 0.16, 0.07  # half of a car's wheel, long and wide: shares of the car's length
RAY_END_PIXELS, SPOT_PIXELS = 2.5, 2.6  # radii
SECTOR_POINTS = 9  # of the line that shows a switch
SECTOR_PIXELS = 3.0  # the width of that line


def draw_robot(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """Draw the robot as it is after a tick: what it senses, claw, body, and a line that shows its heading."""
    if tick:
        _rays(canvas, run, theme, tick)
        _claw(canvas, run, theme, tick)
        _jets(canvas, run, theme, tick)
    _body(canvas, run, theme.robot, theme, run.body[tick])
    _wheels(canvas, run, theme, tick)
    _lamps(canvas, run, theme, tick)
    _touches(canvas, run, theme, tick)
    _spots(canvas, run, theme, tick)


def _body(canvas: Canvas, run: RecordedRun, colour: Colour, theme: Theme, pose: Floats) -> None:
    """Draw a robot's body, and a line that shows its heading."""
    body = run.graph.body
    if body.outline:
        _part(canvas, to_world(body.outline, pose), colour, theme, 1.2)
    else:
        canvas.disc(pose[0], pose[1], body.radius, colour)
        canvas.disc(pose[0], pose[1], body.radius, theme.floor, width=1.2)
    canvas.line([pose[:2], *to_world([(0.95 * body.front, 0.0)], pose)], theme.floor, 2.0)


def _part(canvas: Canvas, corners: Floats, colour: Colour, theme: Theme, edge: float) -> None:
    canvas.polygon(corners, colour)
    canvas.line(corners, theme.floor, edge, closed=True)


def _commanded(run: RecordedRun, tick: int) -> Iterator[tuple[ActuatorKind, float]]:
    """Each actuator and its command in a tick; as the run begins, its neutral."""
    for number, actuator in enumerate(run.graph.actuators):
        yield actuator.kind, float(run.commands[tick - 1, number]) if tick else actuator.kind.neutral


def _sensed(run: RecordedRun, tick: int) -> Iterator[tuple[SensorKind, Floats]]:
    """Each sensor and what it reads in a tick; as the run begins, nothing yet."""
    for sensor in run.graph.sensors:
        yield sensor.kind, run.readings[tick - 1, sensor.place].astype(float) if tick else np.zeros(sensor.width)


def _wheels(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    body = run.graph.body
    long, wide = (share * 2 * body.front for share in WHEEL_SHARES)
    for ahead, turn in ((-0.5, 0.0), (0.5, steering_angle(run, tick))):
        for side in (body.side, -body.side) if body.axle_distance else ():
            wheel = to_world(rectangle_corners(0, 0, long, wide), np.array([ahead * body.axle_distance, side, turn]))
            _part(canvas, to_world(wheel, run.body[tick]), theme.robot, theme, 1.0)


def steering_angle(run: RecordedRun, tick: int) -> float:
    """How far a car's front wheels are turned after a tick, counterclockwise."""
    for kind, command in _commanded(run, tick):
        if kind.drive == "steering":
            return float((1 - 2 * command) * kind.row(run.graph.body)["turn"])
    return 0.0


def _jets(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """Draw the jet of each thruster, opposite to its push, of a length proportional to its force."""
    body, pose = run.graph.body, run.body[tick]
    for kind, command in _commanded(run, tick):
        if (push := kind.push(body)) is not None:
            at, way = (np.array(each) for each in push)
            canvas.line(to_world([at, at - JET_SIDES * body.side * (2 * command - 1) * way], pose), theme.lamp, 4.0)


def _lamps(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """Draw the lamps side by side in front, each as bright as its command; one that is lit throws a beam."""
    lamps = [command for kind, command in _commanded(run, tick) if kind.is_light]
    body, pose = run.graph.body, run.body[tick]
    size = 0.7 * body.side / (2 + len(lamps))
    for place, bright in enumerate(lamps):
        ahead, aside = 0.6 * body.front, ((len(lamps) - 1) / 2 - place) * 2.4 * size
        if bright > LIT_COMMAND:
            far, wide = BEAM_UNITS * body.side, BEAM_SLOPE * BEAM_UNITS * body.side
            ends = [(ahead + far, aside - wide), (ahead + far, aside + wide)]
            canvas.polygon(to_world([(ahead, aside), *ends], pose), theme.lamp, 0.35 * bright)
        [(x, y)] = to_world([(ahead, aside)], pose)
        canvas.disc(x, y, size, theme.floor)
        canvas.disc(x, y, size, theme.lamp, bright)
        canvas.disc(x, y, 1.9 * size, theme.lamp, 0.4 * bright)


def _claw(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    body = run.graph.body
    for kind, command in _commanded(run, tick):
        apart = 0.35 if command > 0.5 else 0.75
        for side in (-1.0, 1.0) if kind.can_hold else ():
            shape = np.array([(-0.2, 0.5 * side), (0.4, apart * side), (0.9, apart * 0.8 * side)]) * body.side
            canvas.line(to_world(shape + np.array([body.front, 0.0]), run.body[tick]), theme.robot, 2.2)


def _rays(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """Draw each ray as far as it went; of those that a servo turns, where a sensor says how far it has turned."""
    x, y, angle = run.body[tick]
    for kind, readings in _sensed(run, tick):
        turned = _turned(run, kind, tick)
        for at, reading in zip(kind.rays, readings, strict=False):
            # How far an eye saw is not known: something may be in the way; nor what was not measured.
            if np.isnan(reading + turned) or (kind.thing and reading == 1.0):
                continue
            way = np.array([np.cos(angle + at + turned), np.sin(angle + at + turned)])
            rim = run.graph.body.rim(at + turned)
            end = (x, y) + way * (rim + reading * kind.reach)
            canvas.line([(x, y) + way * rim, end], theme.ray, 1.0, 0.3 + 0.4 * (reading < 1.0))
            if reading < 1.0:
                canvas.disc(end[0], end[1], RAY_END_PIXELS * canvas.pixel, theme.ray)


def _turned(run: RecordedRun, kind: SensorKind, tick: int) -> float:
    """The angle by which the servo has turned that a sensor is on; NaN where nobody knows it."""
    if not kind.servo:
        return 0.0
    told = servo_reading(run.graph, kind)
    return np.nan if told is None else 2 * np.pi * (0.5 - float(run.readings[tick - 1, told]))


def _touches(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """Draw the switches of a bumper along the rim of the body, lit where pressed; the pressed ones lie on top."""
    shown = [
        (reading, _rim(run, at, kind.sector))
        for kind, readings in _sensed(run, tick)
        if kind.sector
        for at, reading in zip(kind.directions, readings, strict=True)
        if not np.isnan(reading)
    ]
    for reading, points in sorted(shown, key=itemgetter(0)):
        line = to_world(points, run.body[tick])
        canvas.line(line, theme.floor, SECTOR_PIXELS + 1.5)
        canvas.line(line, theme.crash if reading > 0.5 else theme.faint, SECTOR_PIXELS)


def _rim(run: RecordedRun, at: float, sector: float) -> Floats:
    angles = at + np.linspace(-sector / 2, sector / 2, SECTOR_POINTS)
    far = np.array([run.graph.body.rim(angle) for angle in angles])
    points: Floats = np.column_stack([np.cos(angles), np.sin(angles)]) * far[:, None]
    return points


def _spots(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int) -> None:
    """Draw each point of the floor that a sensor looks down at, filled where it is over what it looks for."""
    radius = SPOT_PIXELS * canvas.pixel
    for kind, readings in _sensed(run, tick):
        for (x, y), reading in zip(to_world(kind.spots, run.body[tick]) if kind.spots else (), readings, strict=False):
            if not np.isnan(reading):
                canvas.disc(x, y, radius, theme.ray if reading > 0.5 else theme.floor)
                canvas.disc(x, y, radius, theme.ray, width=1.0)
