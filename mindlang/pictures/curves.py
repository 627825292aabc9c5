"""Learning curves, as in the paper's Figures 11 to 14: one panel a lesson, one colour an attempt, or their mean."""

from collections.abc import Callable, Sequence
from io import BytesIO
from math import ceil, sqrt
from pathlib import Path
from typing import Any, TypeVar

from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend_handler import HandlerTuple
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import EngFormatter, MaxNLocator
from matplotlib.transforms import offset_copy

from mindlang.pictures.learning_log import Curve, MeanCurve

INK, FAINT, PAGE = "#23272f", "#8a8f99", "#ffffff"
ATTEMPTS = (  # Paul Tol's muted colours, which all eyes tell apart, and a grey
    *("#332288", "#cc6677", "#44aa99", "#ddaa33", "#88ccee"),
    *("#882255", "#117733", "#aa4499", "#999933", "#7a7f8a"),
)
STYLE: Sequence[str | Path] = ["default", Path(__file__).with_name("curves.mplstyle")]
SINGLE_PANEL_INCHES, GRID_PANEL_INCHES = (6.4, 3.8), (3.7, 2.7)  # inches: a panel by itself, and one of several
MAX_PANELS_PER_ROW = 4  # panels
ROUND = [1, 2, 5, 10]  # steps of the axes
VERDICT_OFFSET_POINTS = 9.0  # points from the last generation to the verdict on it

T = TypeVar("T", Curve, MeanCurve)
Entry = tuple[Any, str]  # of a legend: what is drawn, and what it means
EDGE = {"markeredgecolor": PAGE, "markeredgewidth": 0.6}  # so that marks which overlap can be told apart
CURVE_STYLES: dict[str, dict[str, Any]] = {
    "best": {"linewidth": 0.6, "alpha": 0.45},
    "reevaluated": {"linewidth": 1.3, "marker": "o", "markersize": 3.8, **EDGE},
    "verdict": {"linestyle": "none", "marker": "D", "markersize": 4.8, **EDGE},
}
MEANINGS = {
    "best": "best of the generation",
    "reevaluated": "champion, tried again on fresh layouts",
    "verdict": "champion in the end, on layouts that chose nothing",
}
MEAN_COLOURS = {"best": ATTEMPTS[2], "reevaluated": ATTEMPTS[0], "verdict": ATTEMPTS[1]}
MEAN_MEANINGS = {
    "best": "best of the generation, mean",
    "reevaluated": "champion, tried again on fresh layouts, mean",
    "verdict": "champion in the end, mean",
}
BAND: dict[str, Any] = {"alpha": 0.22, "linewidth": 0}  # of a standard error around a mean
MAX_LEGEND_COLOURS = 5  # of attempts


@style.context(STYLE)
def figure(curves: Sequence[Curve]) -> Figure:
    """A panel for each curve, and below them what its lines and marks mean."""
    shown = [name for name in MEANINGS if any(curve.points(a, name) for curve in curves for a in curve.attempts)]
    entries: list[Entry] = [(Line2D([], [], color=INK, **CURVE_STYLES[name]), MEANINGS[name]) for name in shown]
    if (attempts := max(len(curve.attempts) for curve in curves)) > 1:
        colours = ATTEMPTS[: min(attempts, MAX_LEGEND_COLOURS)]
        entries.append((tuple(Line2D([], [], color=each, linewidth=1.5) for each in colours), "one colour per attempt"))
    return _figure(curves, _draw, entries)


@style.context(STYLE)
def mean_figure(curves: Sequence[MeanCurve]) -> Figure:
    """A panel for each lesson, and below them what the lines and bands mean."""
    shown = [column for column in MEAN_MEANINGS if any(curve.points(column) for curve in curves)]
    entries: list[Entry] = [
        (Line2D([], [], color=MEAN_COLOURS[column], **CURVE_STYLES[column]), MEAN_MEANINGS[column]) for column in shown
    ]
    if any(curve.attempts > 1 for curve in curves):
        entries.append((Patch(color=MEAN_COLOURS["reevaluated"], **BAND), "± the standard error of the mean"))
    return _figure(curves, _draw_mean, entries)


def _figure(curves: Sequence[T], draw: Callable[[Axes, T], None], entries: Sequence[Entry]) -> Figure:
    """A panel for each curve, which `draw` fills, and a legend below them."""
    count = len(curves)
    columns = count if count <= 3 else min(MAX_PANELS_PER_ROW, ceil(sqrt(count)))
    rows = ceil(count / columns)
    wide, high = SINGLE_PANEL_INCHES if count == 1 else GRID_PANEL_INCHES
    drawn = Figure(figsize=(wide * columns, high * rows + 0.4), layout="constrained", facecolor=PAGE)
    for place, curve in enumerate(curves):
        axes = drawn.add_subplot(rows, columns, place + 1)
        axes.set_ylabel("" if place % columns else "score")
        draw(axes, curve)
    handles, labels = zip(*entries, strict=True) if entries else ((), ())
    looks = {tuple: HandlerTuple(ndivide=None, pad=0.0)}
    drawn.legend(handles, labels, loc="outside lower center", ncols=4 if columns > 2 else 2, handler_map=looks)
    return drawn


def _draw(axes: Axes, curve: Curve) -> None:
    beyond = offset_copy(axes.transData, axes.get_figure(root=True), x=VERDICT_OFFSET_POINTS, units="points")
    for layer, (column, look) in enumerate(CURVE_STYLES.items(), 3):
        where = beyond if column == "verdict" else axes.transData
        for attempt in curve.attempts:
            points = curve.points(attempt, column)
            generations, scores = [generation for generation, _ in points], [score for _, score in points]
            colour, label = ATTEMPTS[(attempt - 1) % len(ATTEMPTS)], f"{column} {attempt}"
            axes.plot(generations, scores, color=colour, label=label, transform=where, zorder=layer, **look)
            axes.update_datalim(points)  # whose own place does not count where it is shifted
    name = f"{curve.name}, failed" if curve.failure else curve.name
    _frame(axes, name, curve.note, max(map(curve.last, curve.attempts)), curve.is_along_ticks)


def _draw_mean(axes: Axes, curve: MeanCurve) -> None:
    for layer, column in enumerate(("best", "reevaluated"), 3):
        points, colour = curve.points(column), MEAN_COLOURS[column]
        generations, means = [point.generation for point in points], [point.mean for point in points]
        axes.plot(generations, means, color=colour, label=column, zorder=layer, **CURVE_STYLES[column])
        if curve.attempts > 1:
            low, high = ([p.mean + sign * (p.error or 0.0) for p in points] for sign in (-1, 1))
            axes.fill_between(generations, low, high, color=colour, label=f"{column} band", **BAND)
    if verdict := curve.verdict():
        look = CURVE_STYLES["verdict"] | {"color": MEAN_COLOURS["verdict"], "label": "verdict", "zorder": 5}
        axes.errorbar([verdict.generation], [verdict.mean], yerr=verdict.error, elinewidth=1.3, **look)
    _frame(axes, curve.name, curve.note, curve.generations, curve.runs[0].is_along_ticks)


def _frame(axes: Axes, name: str, note: str, last: int, is_along_ticks: bool) -> None:
    """Draw the frame of a panel: its name, a note below that, and its axes, up to the last generation or tick."""
    axes.set_title(name, pad=20.0 if note else 8.0)
    axes.annotate(note, (0, 1), (0, 8), xycoords="axes fraction", textcoords="offset points", size=6.5, color=FAINT)
    axes.set_xlim(0, last * 1.07)
    axes.set_xlabel("ticks" if is_along_ticks else "generation")
    if is_along_ticks:
        axes.xaxis.set_major_formatter(EngFormatter())
    axes.xaxis.set_major_locator(MaxNLocator(6, steps=ROUND, integer=True))
    axes.yaxis.set_major_locator(MaxNLocator(6, steps=ROUND))


@style.context(STYLE)
def image(drawn: Figure, suffix: str) -> bytes:
    """The contents of an .svg or a .png file, the same for the same figure."""
    file, kind = BytesIO(), suffix.lower().removeprefix(".")
    nothing = {"svg": {"Date": None, "Creator": None}, "png": {"Software": None}}[kind]
    drawn.savefig(file, format=kind, metadata=nothing)
    return file.getvalue()
