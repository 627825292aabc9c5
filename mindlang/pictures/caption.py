"""What stands around a picture: the run in words above it, its legend and its scale below."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from mindlang.number_format import score
from mindlang.pictures.canvas import Canvas, in_lines, square
from mindlang.pictures.ending import draw_rings
from mindlang.pictures.path import MIN_CONTROL_SHARE, Path, Stroke, draw_cross
from mindlang.pictures.scene import thing_colours
from mindlang.pictures.theme import PAPER, Colour, mixed
from mindlang.run.recorded_run import RecordedRun

ENTRY_GAP_PIXELS = 22.0  # between two entries
SMALL_PIXELS, LARGE_PIXELS, MIN_TEXT_PIXELS = 11.0, 14.0, 5.0
LEGEND_LINES, LEGEND_LINE_PIXELS = 2, 22.0  # how many, and how high
LEGEND_MARK_PIXELS = 26.0  # the width of what stands before a name
Entry = tuple[Callable[[float, float], None], str]  # what draws the mark at a place, and the name behind it


def draw_title(canvas: Canvas, run: RecordedRun, found: dict[str, Any], x: float, y: float, right: float) -> None:
    """The task, and the facts of the run side by side up to `right`, each below its name."""
    canvas.text(x, y, run.task.name, 24, PAPER.ink, bold=True)
    facts = _facts(run, found)
    gap = 1.6 * ENTRY_GAP_PIXELS
    wide = [max(canvas.width(name, SMALL_PIXELS), canvas.width(value, LARGE_PIXELS)) + gap for name, value in facts]
    fit = min(1.0, (right - x) / (sum(wide) - gap))  # smaller, where much is counted
    for (name, value), width in zip(facts, wide, strict=True):
        canvas.text(x, y + 25, name, fit * SMALL_PIXELS, PAPER.faint)
        canvas.text(x, y + 46, value, fit * LARGE_PIXELS, PAPER.ink)
        x += fit * width


def _facts(run: RecordedRun, found: dict[str, Any]) -> list[tuple[str, str]]:
    seconds = found["ticks"] * run.graph.tick
    return [
        *(("in charge", found["master"]), ("seed", str(found["seed"])), ("score", score(found["score"]))),
        *((event, str(times)) for event, times in found["by_event"].items()),
        ("ticks", f"{found['ticks']:,} of {found['of_ticks']:,} ({seconds:,.1f} s)"),
        ("success" if found.get("succeeded") else "ended by", found["ended_by"] or "time"),
    ]


def draw_legend(
    canvas: Canvas, run: RecordedRun, found: dict[str, Any], path: Path, x: float, y: float, right: float
) -> None:
    """What the colours and marks mean, in lines that end before `right`, smaller where they are many."""
    entries = _entries(canvas, run, found, path)
    size, places = fitted(canvas, [name for _, name in entries], right - x)
    for (draw, name), (along, line) in zip(entries, places, strict=True):
        low = y + LEGEND_LINE_PIXELS * line
        draw(x + along, low - 4)
        canvas.text(x + along + LEGEND_MARK_PIXELS, low, name, size, PAPER.ink)


def fitted(canvas: Canvas, names: Sequence[str], room: float) -> tuple[float, list[tuple[float, int]]]:
    """The largest size at which so many names fit into the lines, and where each entry begins."""
    size = SMALL_PIXELS
    while True:
        widths = [LEGEND_MARK_PIXELS + canvas.width(name, size) for name in names]
        places = in_lines(widths, ENTRY_GAP_PIXELS, room)
        if places[-1][1] < LEGEND_LINES or size <= MIN_TEXT_PIXELS:
            return size, places
        size -= 0.5


def _entries(canvas: Canvas, run: RecordedRun, found: dict[str, Any], path: Path) -> list[Entry]:
    def ramp(x: float, y: float) -> None:
        for i in range(18):
            canvas.line([(x + i, y), (x + i + 1, y)], mixed(PAPER.early, PAPER.late, i / 17), 3.0)

    def box(colour: Colour, x: float, y: float) -> None:
        canvas.polygon(square(x + 9, y, 6), colour, 0.75)

    def dot(colour: Colour, x: float, y: float) -> None:
        canvas.disc(x + 9, y, 6, colour)

    def bar(stroke: Stroke, x: float, y: float) -> None:
        stroke.draw(canvas, [(x, y), (x + 18, y)], 3.0)

    entries: list[Entry] = [
        (partial(bar, stroke), f"{name} {share:.0%}")
        for stroke, (name, share) in zip(path.strokes, path.shares.items(), strict=False)
        if share >= MIN_CONTROL_SHARE
    ] or [(ramp, f"path, 0 to {run.ticks * run.graph.tick:.0f} s")]
    entries.append((lambda x, y: canvas.disc(x + 9, y, 4.5, PAPER.ink, width=1.6), "start"))
    entries.append((lambda x, y: draw_rings(canvas, x + 9, y, 3.0, found, PAPER), "end"))
    things = {thing.name: thing for thing in run.contents}
    colours = dict(zip((thing.name for thing in run.contents), thing_colours(run.contents, PAPER), strict=True))
    for name, thing in things.items():
        entries.append((partial(dot if thing.kind.is_round else box, colours[name]), name))
    if len(run.boxes):
        solid = dict.fromkeys(thing.name for thing in run.task.things if thing.kind.is_obstacle)
        entries.append((partial(box, PAPER.rock_edge), ", ".join(solid)))
    if hits := len(run.collisions):
        entries.append((lambda x, y: draw_cross(canvas, x + 9, y, 5, PAPER), f"collision ({hits})"))
    return entries


def draw_scale(canvas: Canvas, units_per_pixel: float, right: float, y: float) -> None:
    """A bar of a round number of units that ends at `right`."""
    units = next(n for n in (1000, 500, 200, 100, 50, 20, 10, 5, 2, 1, 0.5, 0) if n / units_per_pixel <= 130)
    long = units / units_per_pixel
    canvas.line([(right - long, y), (right, y)], PAPER.ink, 1.6)
    for end in (right - long, right):
        canvas.line([(end, y - 4), (end, y + 4)], PAPER.ink, 1.6)
    canvas.text(right - long / 2, y - 9, f"{units:g} units", SMALL_PIXELS, PAPER.ink, align="centre")
