"""Learning curves, as in the paper's Figures 11 to 14: one panel a lesson, one colour an attempt."""

from collections.abc import Sequence
from io import BytesIO
from math import ceil, sqrt
from typing import Any

from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend_handler import HandlerTuple
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator
from matplotlib.transforms import offset_copy

from mindlang.pictures.learning_log import Curve

INK, FAINT, GRID, PAGE = "#23272f", "#8a8f99", "#ececee", "#ffffff"
ATTEMPTS = (  # Paul Tol's muted colours, which all eyes tell apart, and a grey
    *("#332288", "#cc6677", "#44aa99", "#ddaa33", "#88ccee"),
    *("#882255", "#117733", "#aa4499", "#999933", "#7a7f8a"),
)
STYLE = {
    "font.family": "DejaVu Sans",  # comes with matplotlib: the same letters everywhere
    "font.size": 8.0,
    "text.color": INK,
    "text.parse_math": False,
    "axes.edgecolor": FAINT,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.6,
    "axes.spines.left": False,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.titleweight": "bold",
    "axes.grid": True,
    "axes.grid.axis": "y",
    "axes.axisbelow": True,
    "grid.color": GRID,
    "grid.linewidth": 0.7,
    "xtick.color": FAINT,
    "ytick.color": FAINT,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.major.width": 0.6,
    "xtick.major.size": 3.0,
    "ytick.major.size": 0.0,
    "legend.frameon": False,
    "lines.solid_joinstyle": "round",
    "figure.constrained_layout.h_pad": 0.08,
    "figure.constrained_layout.w_pad": 0.08,
    "savefig.dpi": 220.0,
    "svg.hashsalt": "mind",  # names that do not change from one drawing to the next
}
SINGLE_PANEL_INCHES, GRID_PANEL_INCHES = (6.4, 3.8), (3.7, 2.7)  # inches: a panel by itself, and one of several
MAX_PANELS_PER_ROW = 4  # panels
ROUND = [1, 2, 5, 10]  # steps of the axes
VERDICT_OFFSET_POINTS = 9.0  # points from the last generation to the verdict on it

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


@style.context(["default", STYLE])
def figure(curves: Sequence[Curve]) -> Figure:
    """A panel for each curve, and below them what its lines and marks mean."""
    drawn, panels = grid(len(curves))
    for axes, curve in zip(panels, curves, strict=True):
        _panel(drawn, axes, curve)
    _legend(drawn, curves)
    return drawn


def panels_per_row(count: int) -> int:
    """How many of so many panels are beside each other."""
    return count if count <= 3 else min(MAX_PANELS_PER_ROW, ceil(sqrt(count)))


def grid(count: int) -> tuple[Figure, list[Axes]]:
    """A figure with `count` empty panels, and the panels."""
    columns = panels_per_row(count)
    rows = ceil(count / columns)
    wide, high = SINGLE_PANEL_INCHES if count == 1 else GRID_PANEL_INCHES
    drawn = Figure(figsize=(wide * columns, high * rows + 0.4), layout="constrained", facecolor=PAGE)
    panels = [drawn.add_subplot(rows, columns, number + 1) for number in range(count)]
    for axes in panels[::columns]:
        axes.set_ylabel("score")
    return drawn, panels


def frame(axes: Axes, name: str, note: str, generations: int) -> None:
    """What is around the lines of a panel: its name, a note below that, and its axes."""
    axes.set_title(name, pad=20.0 if note else 8.0)
    axes.annotate(note, (0, 1), (0, 8), xycoords="axes fraction", textcoords="offset points", size=6.5, color=FAINT)
    axes.set_xlim(0, generations * 1.07)
    axes.set_xlabel("generation")
    axes.xaxis.set_major_locator(MaxNLocator(6, steps=ROUND, integer=True))
    axes.yaxis.set_major_locator(MaxNLocator(6, steps=ROUND))


@style.context(["default", STYLE])
def image(drawn: Figure, suffix: str) -> bytes:
    """The contents of an .svg or a .png file, the same for the same figure."""
    file, kind = BytesIO(), suffix.lower().removeprefix(".")
    nothing = {"svg": {"Date": None, "Creator": None}, "png": {"Software": None}}[kind]
    drawn.savefig(file, format=kind, metadata=nothing)
    return file.getvalue()


def _panel(drawn: Figure, axes: Axes, curve: Curve) -> None:
    beyond = offset_copy(axes.transData, drawn, x=VERDICT_OFFSET_POINTS, units="points")
    for layer, (column, look) in enumerate(CURVE_STYLES.items(), 3):
        where = beyond if column == "verdict" else axes.transData
        for attempt in curve.attempts:
            points = curve.points(attempt, column)
            generations, scores = [generation for generation, _ in points], [score for _, score in points]
            colour, label = ATTEMPTS[(attempt - 1) % len(ATTEMPTS)], f"{column} {attempt}"
            axes.plot(generations, scores, color=colour, label=label, transform=where, zorder=layer, **look)
            axes.update_datalim(points)  # whose own place does not count where it is shifted
    name = f"{curve.name}, failed" if curve.failure else curve.name
    frame(axes, name, curve.note, max(map(curve.last, curve.attempts)))


def _legend(drawn: Figure, curves: Sequence[Curve]) -> None:
    shown = [name for name in CURVE_STYLES if any(curve.points(a, name) for curve in curves for a in curve.attempts)]
    handles: list[Any] = [Line2D([], [], color=INK, **CURVE_STYLES[name]) for name in shown]
    labels = [MEANINGS[name] for name in shown]
    if (attempts := max(len(curve.attempts) for curve in curves)) > 1:
        handles.append(tuple(Line2D([], [], color=colour, linewidth=1.5) for colour in ATTEMPTS[: min(attempts, 5)]))
        labels.append("one colour per attempt")
    drawn.legend(
        handles,
        labels,
        loc="outside lower center",
        ncols=4 if panels_per_row(len(curves)) > 2 else 2,
        handler_map={tuple: HandlerTuple(ndivide=None, pad=0.0)},
    )
