"""What stands around a picture: the run in words above it, its legend and its scale below."""

from collections.abc import Sequence
from typing import Any

from mindlang.number_format import score
from mindlang.pictures.canvas import Canvas, square, text_width
from mindlang.pictures.ending import draw_rings
from mindlang.pictures.path import MIN_CONTROL_SHARE, Path, Stroke, draw_cross
from mindlang.pictures.scene import thing_colours
from mindlang.pictures.theme import Theme, mixed
from mindlang.run.recorded_run import RecordedRun

ENTRY_GAP_PIXELS = 22.0  # between two entries
SMALL_PIXELS, LARGE_PIXELS, MIN_TEXT_PIXELS = 11.0, 14.0, 5.0
LEGEND_LINES, LEGEND_LINE_PIXELS = 2, 22.0  # how many, and how high
LEGEND_MARK_PIXELS = 26.0  # the width of what stands before a name


def draw_title(
    canvas: Canvas, run: RecordedRun, found: dict[str, Any], theme: Theme, x: float, y: float, right: float
) -> None:
    """The task, and the facts of the run side by side up to `right`, each below its name."""
    canvas.text(x, y, run.task.name, 24, theme.ink, bold=True)
    facts = _facts(run, found)
    wide = [
        max(_width(canvas, name, SMALL_PIXELS), _width(canvas, value, LARGE_PIXELS)) + 1.6 * ENTRY_GAP_PIXELS
        for name, value in facts
    ]
    fit = min(1.0, (right - x) / (sum(wide) - 1.6 * ENTRY_GAP_PIXELS))  # smaller, where much is counted
    for (name, value), width in zip(facts, wide, strict=True):
        canvas.text(x, y + 25, name, fit * SMALL_PIXELS, theme.faint)
        canvas.text(x, y + 46, value, fit * LARGE_PIXELS, theme.ink)
        x += fit * width


def _facts(run: RecordedRun, found: dict[str, Any]) -> list[tuple[str, str]]:
    seconds = found["ticks"] * run.graph.tick
    facts = [("in charge", found["master"]), ("seed", str(found["seed"])), ("score", score(found["score"]))]
    facts += [(event, str(times)) for event, times in found["by_event"].items()]
    facts.append(("ticks", f"{found['ticks']:,} of {found['of_ticks']:,} ({seconds:,.1f} s)"))
    return [*facts, ("success" if found.get("succeeded") else "ended by", found["ended_by"] or "time")]


def draw_legend(
    canvas: Canvas,
    run: RecordedRun,
    found: dict[str, Any],
    path: Path,
    theme: Theme,
    x: float,
    y: float,
    right: float,
) -> None:
    """What the colours and marks mean, in lines that end before `right`, smaller where they are many."""
    entries = _entries(canvas, run, found, path, theme)
    size, places = fitted(canvas, [name for _, name in entries], right - x)
    for (draw, name), (along, line) in zip(entries, places, strict=True):
        low = y + LEGEND_LINE_PIXELS * line
        draw(x + along, low - 4)
        canvas.text(x + along + LEGEND_MARK_PIXELS, low, name, size, theme.ink)


def fitted(canvas: Canvas, names: Sequence[str], room: float) -> tuple[float, list[tuple[float, int]]]:
    """The largest size at which so many names fit into the lines, and where each entry begins."""
    size = SMALL_PIXELS
    while True:
        places = _places([_width(canvas, name, size) for name in names], room)
        if places[-1][1] < LEGEND_LINES or size <= MIN_TEXT_PIXELS:
            return size, places
        size -= 0.5


def _places(widths: Sequence[float], room: float) -> list[tuple[float, int]]:
    """Where each name's entry begins and in which line, from 0."""
    places, along, line = [], 0.0, 0
    for width in widths:
        if along and along + LEGEND_MARK_PIXELS + width > room:
            along, line = 0.0, line + 1
        places.append((along, line))
        along += LEGEND_MARK_PIXELS + width + ENTRY_GAP_PIXELS
    return places


def _entries(canvas: Canvas, run: RecordedRun, found: dict[str, Any], path: Path, theme: Theme) -> list[Any]:
    def bar(stroke: Stroke) -> Any:
        return lambda x, y: stroke.draw(canvas, [(x, y), (x + 18, y)], 3.0)

    def ramp(x: float, y: float) -> None:
        for i in range(18):
            canvas.line([(x + i, y), (x + i + 1, y)], mixed(theme.early, theme.late, i / 17), 3.0)

    def box(colour: Any) -> Any:
        return lambda x, y: canvas.polygon(square(x + 9, y, 6), colour, 0.75)

    seconds, colours = run.ticks * run.graph.tick, thing_colours(run.contents, theme)
    entries: list[Any] = [
        (bar(stroke), f"{name} {share:.0%}")
        for stroke, (name, share) in zip(path.strokes, path.shares.items(), strict=False)
        if share >= MIN_CONTROL_SHARE
    ] or [(ramp, f"path, 0 to {seconds:.0f} s")]
    entries.append((lambda x, y: canvas.disc(x + 9, y, 4.5, theme.ink, width=1.6), "start"))
    entries.append((lambda x, y: draw_rings(canvas, x + 9, y, 3.0, found, theme), "end"))
    coloured = {thing.name: (thing, colour) for thing, colour in zip(run.contents, colours, strict=True)}
    for name, (thing, colour) in coloured.items():
        entries.append((_dot(canvas, colour) if thing.kind.is_round else box(colour), name))
    if len(run.boxes):
        solid = dict.fromkeys(thing.name for thing in run.task.things if thing.kind.is_obstacle)
        entries.append((box(theme.rock_edge), ", ".join(solid)))
    if hits := len(run.collisions):
        entries.append((lambda x, y: draw_cross(canvas, x + 9, y, 5, theme), f"collision ({hits})"))
    return entries


def _dot(canvas: Canvas, colour: Any) -> Any:
    return lambda x, y: canvas.disc(x + 9, y, 6, colour)


def draw_scale(canvas: Canvas, units_per_pixel: float, theme: Theme, right: float, y: float) -> None:
    """A bar of a round number of units that ends at `right`."""
    units = next(n for n in (1000, 500, 200, 100, 50, 20, 10, 5, 2, 1, 0.5, 0) if n / units_per_pixel <= 130)
    long = units / units_per_pixel
    canvas.line([(right - long, y), (right, y)], theme.ink, 1.6)
    for end in (right - long, right):
        canvas.line([(end, y - 4), (end, y + 4)], theme.ink, 1.6)
    canvas.text(right - long / 2, y - 9, f"{units:g} units", SMALL_PIXELS, theme.ink, align="centre")


def _width(canvas: Canvas, text: str, size: float) -> float:
    return text_width(text, size * canvas.pen) / canvas.pen
