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
    columns = len(curves) if len(curves) <= 3 else min(MAX_PANELS_PER_ROW, ceil(sqrt(len(curves))))
    rows = ceil(len(curves) / columns)
    wide, high = SINGLE_PANEL_INCHES if len(curves) == 1 else GRID_PANEL_INCHES
    drawn = Figure(figsize=(wide * columns, high * rows + 0.4), layout="constrained", facecolor=PAGE)
    for number, curve in enumerate(curves):
        axes = drawn.add_subplot(rows, columns, number + 1)
        _panel(drawn, axes, curve)
        axes.set_ylabel("score" if number % columns == 0 else "")
    _legend(drawn, curves, columns)
    return drawn


@style.context(["default", STYLE])
def image(drawn: Figure, suffix: str) -> bytes:
    """The contents of an .svg or a .png file, the same for the same figure."""
    file, kind = BytesIO(), suffix.lower().removeprefix(".")
    nothing = {"svg": {"Date": None, "Creator": None}, "png": {"Software": None}}[kind]
    drawn.savefig(file, format=kind, metadata=nothing)
    return file.getvalue()


def _panel(drawn: Figure, axes: Axes, curve: Curve) -> None:
    axes.set_title(curve.name, pad=20.0 if curve.note else 8.0)
    axes.annotate(
        curve.note, (0, 1), (0, 8), xycoords="axes fraction", textcoords="offset points", size=6.5, color=FAINT
    )
    beyond = offset_copy(axes.transData, drawn, x=VERDICT_OFFSET_POINTS, units="points")
    for layer, (column, look) in enumerate(CURVE_STYLES.items(), 3):
        where = beyond if column == "verdict" else axes.transData
        for attempt in curve.attempts:
            points = curve.points(attempt, column)
            generations, scores = [generation for generation, _ in points], [score for _, score in points]
            colour, label = ATTEMPTS[(attempt - 1) % len(ATTEMPTS)], f"{column} {attempt}"
            axes.plot(generations, scores, color=colour, label=label, transform=where, zorder=layer, **look)
    last = max(int(record["generation"] or 0) for record in curve.records)
    axes.set_xlim(0, last * 1.07)
    axes.set_xlabel("generation")
    axes.xaxis.set_major_locator(MaxNLocator(6, steps=ROUND, integer=True))
    axes.yaxis.set_major_locator(MaxNLocator(6, steps=ROUND))


def _legend(drawn: Figure, curves: Sequence[Curve], columns: int) -> None:
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
        ncols=4 if columns > 2 else 2,
        handler_map={tuple: HandlerTuple(ndivide=None, pad=0.0)},
    )
