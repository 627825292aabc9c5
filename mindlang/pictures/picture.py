"""Pictures of a run: its world in the end, the path that led there, the words around it; and of a run changed."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import cv2
import numpy as np
from mindrun.sim.numbering import boxes_by_name
from mindrun.terminal.tick_count import ticks as in_words
from numpy.typing import NDArray

from mindlang.number_format import score
from mindlang.pictures import path, scene
from mindlang.pictures.canvas import Canvas, Image, Viewport, blank, flow_layout, paste, rectangle_corners, reduced
from mindlang.pictures.theme import PAPER, Colour, mixed
from mindlang.run.outcome import robot_words
from mindlang.run.recorded_run import RecordedRun

PICTURE_PIXELS = 1000
TOP_PIXELS, BOTTOM_PIXELS, SIDE_PIXELS = 96, 74, 28  # what stands around the world
TITLE_LINE_PIXELS = 34
SCALE_BAR_PIXELS = 170  # beside the legend
SCALE_FACTOR = 2  # drawn so many times larger, then averaged
PLAIN_MARGIN_UNITS = 6.0  # around a plain scene
ENTRY_GAP_PIXELS = 22.0  # between two entries
SMALL_PIXELS, LARGE_PIXELS, MIN_TEXT_PIXELS = 11.0, 14.0, 5.0
LEGEND_LINES, LEGEND_LINE_PIXELS = 2, 22.0  # how many, and how high
LEGEND_MARK_PIXELS = 26.0  # the width of what stands before a name
OUTCOME_PIXELS = 24.0  # the height of a line that says what came of a run
WORDS_PIXELS = 13.0
PATH_PIXELS = 3.6, 1.8  # the width of the paths: where they are one, both are seen
AROUND_PIXELS, MARK_PIXELS = 7.0, 5.0  # from a robot to the ring around it; the marks of the start and of the change
NAMES = "as it was", "changed"
Entry = tuple[Callable[[float, float], None], str]  # what draws the mark at a place, and the name behind it


def picture(run: RecordedRun, found: dict[str, Any]) -> Image:
    world, drawn = world_of(run), path.Path.of(run, PAPER)
    path.draw_former(world, run)
    scene.draw_zones(world, run, PAPER, run.ticks)
    path.draw_others(world, run, PAPER, 0, run.ticks)
    drawn.draw(world, 0, run.ticks, 2.0)
    path.draw_start(world, run)
    path.draw_end_mark(world, run, found, PAPER)
    scene.draw_items(world, run, PAPER, run.ticks)
    scene.draw_robot(world, run, PAPER, run.ticks)
    path.draw_collisions(world, run)
    scene.draw_names(world, run, PAPER, run.ticks, path.end_label(world, run, found))
    height = height_of(run)
    page = page_around(world, height)
    draw_title(page, run, found)
    draw_legend(page, run, found, drawn, height - 46)
    return reduced(page.image, 1 / SCALE_FACTOR)


def world_of(run: RecordedRun, *others: RecordedRun) -> Canvas:
    """A floor to draw on: the arena, or in a plain scene all that happened, in other runs of the task as well."""
    width = SCALE_FACTOR * (PICTURE_PIXELS - 2 * SIDE_PIXELS)
    height = SCALE_FACTOR * (height_of(run) - TOP_PIXELS - BOTTOM_PIXELS)
    return scene.empty_world(run, PAPER, view_of(run, width, height, *others), width, height, SCALE_FACTOR)


def height_of(run: RecordedRun) -> int:
    """How many pixels high the picture is: square, or lower where the arena is long."""
    if not run.task.scene.is_bounded:
        return PICTURE_PIXELS
    x, y = np.add(scene.half_sides(run.task.scene), scene.WALL_UNITS)
    return min(PICTURE_PIXELS, TOP_PIXELS + BOTTOM_PIXELS + round((PICTURE_PIXELS - 2 * SIDE_PIXELS) * float(y / x)))


def view_of(run: RecordedRun, width: int, height: int, *others: RecordedRun) -> Viewport:
    """The viewport of a picture of so many pixels: a bounded scene, or all places of the runs."""
    if run.task.scene.is_bounded:
        half = np.add(scene.half_sides(run.task.scene), scene.WALL_UNITS)
        return Viewport.around(-half, half, width, height)
    seen = np.concatenate([places for each in (run, *others) for places in _places(each)])
    seen = seen[np.isfinite(seen[:, 0])]
    return Viewport.around(seen.min(axis=0) - PLAIN_MARGIN_UNITS, seen.max(axis=0) + PLAIN_MARGIN_UNITS, width, height)


def _places(run: RecordedRun) -> list[NDArray[np.float64]]:
    each = enumerate(run.contents)
    things = (run.things[:, i, :2] if thing.kind.is_robot else run.placements(i)[:, :2] for i, thing in each)
    return [run.body[:, :2], *things, *(box[None, :2] for box in run.standing.values())]


def empty_page(height: int) -> Canvas:
    size = SCALE_FACTOR * PICTURE_PIXELS, SCALE_FACTOR * height
    return Canvas.of_page(blank(*size, PAPER.page), SCALE_FACTOR)


def page_around(world: Canvas, height: int) -> Canvas:
    """A page with this world on it, and its scale."""
    page = empty_page(height)
    paste(page.image, world.image, SCALE_FACTOR * SIDE_PIXELS, SCALE_FACTOR * TOP_PIXELS)
    right, y = PICTURE_PIXELS - SIDE_PIXELS, height - 44
    units = next(n for n in (1000, 500, 200, 100, 50, 20, 10, 5, 2, 1, 0.5, 0) if n / world.pixel <= 130)
    long = units / world.pixel
    page.line([(right - long, y), (right, y)], PAPER.ink, 1.6)
    for end in (right - long, right):
        page.line([(end, y - 4), (end, y + 4)], PAPER.ink, 1.6)
    page.text(right - long / 2, y - 9, f"{units:g} units", SMALL_PIXELS, PAPER.ink, align="centre")
    return page


def png(image: Image) -> bytes:
    """An image as the contents of a PNG file, which is kept and sent more often than written: as small as can be."""
    done, data = cv2.imencode(".png", image, [cv2.IMWRITE_PNG_COMPRESSION, 9])
    assert done
    return bytes(data)


def draw_title(canvas: Canvas, run: RecordedRun, found: dict[str, Any]) -> None:
    """Draw the task, and the facts of the run side by side, each below its name."""
    x = float(SIDE_PIXELS)
    canvas.text(x, TITLE_LINE_PIXELS, run.task.name, 24, PAPER.ink, bold=True)
    facts = [
        *(("in charge", found["master"]), ("seed", str(found["seed"]))),
        *([("robot", str(found["robot"]))] if "robot" in found else []),
        *((name, f"{number:.6g}") for name, number in run.drawn.items()),
        ("score", score(found["score"])),
        *((event, str(times)) for event, times in found["by_event"].items()),
        ("ticks", f"{found['ticks']:,} of {found['of_ticks']:,} ({found['ticks'] * run.graph.tick:,.1f} s)"),
        ("success" if found.get("succeeded") else "ended by", found["ended_by"] or "time"),
    ]
    gap = 1.6 * ENTRY_GAP_PIXELS
    wide = [max(canvas.width(name, SMALL_PIXELS), canvas.width(value, LARGE_PIXELS)) + gap for name, value in facts]
    fit = min(1.0, (PICTURE_PIXELS - 2 * SIDE_PIXELS) / (sum(wide) - gap))  # smaller, where much is counted
    for (name, value), width in zip(facts, wide, strict=True):
        canvas.text(x, TITLE_LINE_PIXELS + 25, name, fit * SMALL_PIXELS, PAPER.faint)
        canvas.text(x, TITLE_LINE_PIXELS + 46, value, fit * LARGE_PIXELS, PAPER.ink)
        x += fit * width


def draw_legend(canvas: Canvas, run: RecordedRun, found: dict[str, Any], drawn: path.Path, y: float) -> None:
    """Draw the legend of colours and marks, in lines that end before the scale, smaller where they are many."""
    entries = _entries(canvas, run, found, drawn)
    room = PICTURE_PIXELS - 2 * SIDE_PIXELS - SCALE_BAR_PIXELS
    size, places = legend_layout(canvas, [name for _, name in entries], room)
    for (draw, name), (along, line) in zip(entries, places, strict=True):
        low = y + LEGEND_LINE_PIXELS * line
        draw(SIDE_PIXELS + along, low - 4)
        canvas.text(SIDE_PIXELS + along + LEGEND_MARK_PIXELS, low, name, size, PAPER.ink)


def legend_layout(canvas: Canvas, names: Sequence[str], room: float) -> tuple[float, list[tuple[float, int]]]:
    """The largest size at which so many names fit into the lines, and where each entry begins."""
    size = SMALL_PIXELS
    while True:
        widths = [LEGEND_MARK_PIXELS + canvas.width(name, size) for name in names]
        places = flow_layout(widths, ENTRY_GAP_PIXELS, room)
        if places[-1][1] < LEGEND_LINES or size <= MIN_TEXT_PIXELS:
            return size, places
        size -= 0.5


def _entries(canvas: Canvas, run: RecordedRun, found: dict[str, Any], drawn: path.Path) -> list[Entry]:
    def ramp(x: float, y: float) -> None:
        for i in range(18):
            canvas.line([(x + i, y), (x + i + 1, y)], mixed(PAPER.early, PAPER.late, i / 17), 3.0)

    def box(colour: Colour, x: float, y: float) -> None:
        canvas.polygon(rectangle_corners(x + 9, y, 6, 6), colour, 0.75)

    def dot(colour: Colour, x: float, y: float) -> None:
        canvas.disc(x + 9, y, 6, colour)

    def bar(stroke: path.Stroke, x: float, y: float) -> None:
        stroke.draw(canvas, [(x, y), (x + 18, y)], 3.0)

    entries: list[Entry] = [
        (partial(bar, stroke), f"{name} {share:.0%}")
        for stroke, (name, share) in zip(drawn.strokes, drawn.shares.items(), strict=False)
        if share >= path.MIN_CONTROL_SHARE
    ] or [(ramp, f"path, 0 to {run.ticks * run.graph.tick:.0f} s")]
    entries.append((lambda x, y: canvas.disc(x + 9, y, 4.5, PAPER.ink, width=1.6), "start"))
    entries.append((lambda x, y: path.draw_rings(canvas, x + 9, y, 3.0, found, PAPER), "end"))
    things = {thing.name: thing for thing in run.contents}
    colours = dict(zip((thing.name for thing in run.contents), scene.thing_colours(run.contents, PAPER), strict=True))
    for name, thing in things.items():
        entries.append((partial(dot if thing.kind.is_round else box, colours[name]), name))
    boxes = boxes_by_name(run.task)
    solid = [each.name for each in run.task.things if not run.standing.keys().isdisjoint(boxes.get(each.name, ()))]
    if solid:
        entries.append((partial(box, PAPER.rock_edge), ", ".join(solid)))
    if hits := len(run.collisions):
        entries.append((lambda x, y: path.draw_cross(canvas, x + 9, y, 5, PAPER), f"collision ({hits})"))
    return entries


def two_paths(both: Sequence[tuple[RecordedRun, dict[str, Any]]], words: str, tick: int) -> Image:
    """The picture of two runs and what came of them; the second is changed, as `words` say, from a tick on."""
    (was, found), (now, _) = both
    height, right = height_of(was), PICTURE_PIXELS - SIDE_PIXELS
    page = page_around(_both(was, now, tick), height)
    page.text(SIDE_PIXELS, 40, was.task.name, 24, PAPER.ink, bold=True)
    said = f"{found['master']} in charge, seed {found['seed']}{robot_words(found)}, {words}"
    _fitting(page, SIDE_PIXELS, 70, said, WORDS_PIXELS, right - 110)
    when = f"tick {tick:,}"
    page.text(right, 70, when, SMALL_PIXELS, PAPER.ink, align="right")
    _mark(page, right - page.width(when, SMALL_PIXELS) - 2 * MARK_PIXELS, 66)
    for line, (name, (_, outcome)) in enumerate(zip(NAMES, both, strict=True)):
        low = height - 46.0 + OUTCOME_PIXELS * line
        page.line([(SIDE_PIXELS, low - 4), (SIDE_PIXELS + 20, low - 4)], PAPER.skills[line], 3.0)
        _fitting(page, SIDE_PIXELS + 30, low, f"{name}: {outcome_words(outcome)}", SMALL_PIXELS, right - 150.0)
    return reduced(page.image, 1 / SCALE_FACTOR)


def _both(was: RecordedRun, now: RecordedRun, tick: int) -> Canvas:
    """Floor and things as they were before the change, both paths, both robots where they came to."""
    parted = min(tick - 1, was.ticks, now.ticks)
    canvas = world_of(was, now)
    scene.draw_zones(canvas, was, PAPER, parted)
    scene.draw_items(canvas, was, PAPER, parted)
    canvas.line(was.body[: parted + 1, :2], PAPER.faint, PATH_PIXELS[1])
    for run, colour, thick in zip((was, now), PAPER.skills, PATH_PIXELS, strict=False):
        canvas.line(run.body[parted:, :2], colour, thick)
    path.draw_start(canvas, was)
    for run, colour in zip((was, now), PAPER.skills, strict=False):
        scene.draw_robot(canvas, run, PAPER, run.ticks)
        x, y, _ = run.body[-1]
        canvas.disc(x, y, was.graph.body.radius + AROUND_PIXELS * canvas.pixel, colour, width=3.0)
        path.draw_collisions(canvas, run)
    x, y, _ = was.body[parted]
    _mark(canvas, x, y)
    scene.draw_names(canvas, was, PAPER, parted)
    return canvas


def _mark(canvas: Canvas, x: float, y: float) -> None:
    """Draw a mark where the robot was when something was changed."""
    canvas.disc(x, y, MARK_PIXELS * canvas.pixel, PAPER.lamp)
    canvas.disc(x, y, MARK_PIXELS * canvas.pixel, PAPER.ink, width=1.8)


def outcome_words(found: dict[str, Any]) -> str:
    counted = [f"{times} × {event}" for event, times in found["by_event"].items()]
    return ", ".join([f"score {score(found['score'])}", *counted, in_words(found["ticks"]), path.ending_words(found)])


def _fitting(page: Canvas, x: float, y: float, text: str, size: float, right: float) -> None:
    """Draw a line of text, smaller where it would go beyond `right`."""
    page.text(x, y, text, size * min(1.0, (right - x) / page.width(text, size)), PAPER.ink)
