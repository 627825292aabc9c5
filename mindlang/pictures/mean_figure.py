"""Mean learning curves with a band: one panel a lesson."""

from collections.abc import Sequence
from typing import Any

from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from mindlang.pictures.curves import ATTEMPTS, CURVE_STYLES, STYLE, frame, grid, panels_per_row
from mindlang.pictures.mean_curves import MeanCurve

COLOURS = {"best": ATTEMPTS[2], "reevaluated": ATTEMPTS[0], "verdict": ATTEMPTS[1]}
BAND: dict[str, Any] = {"alpha": 0.22, "linewidth": 0}
MEANINGS = {
    "best": "best of the generation, mean",
    "reevaluated": "champion, tried again on fresh layouts, mean",
    "verdict": "champion in the end, mean",
}


@style.context(["default", STYLE])
def mean_figure(curves: Sequence[MeanCurve]) -> Figure:
    """A panel for each lesson, and below them what the lines and bands mean."""
    drawn, panels = grid(len(curves))
    for axes, curve in zip(panels, curves, strict=True):
        _panel(axes, curve)
    _legend(drawn, curves)
    return drawn


def _panel(axes: Axes, curve: MeanCurve) -> None:
    for layer, column in enumerate(("best", "reevaluated"), 3):
        points, colour = curve.points(column), COLOURS[column]
        generations, means = [point.generation for point in points], [point.mean for point in points]
        axes.plot(generations, means, color=colour, label=column, zorder=layer, **CURVE_STYLES[column])
        if curve.attempts > 1:
            low, high = ([p.mean + sign * (p.error or 0.0) for p in points] for sign in (-1, 1))
            axes.fill_between(generations, low, high, color=colour, label=f"{column} band", **BAND)
    if verdict := curve.verdict():
        look = CURVE_STYLES["verdict"] | {"color": COLOURS["verdict"], "label": "verdict", "zorder": 5}
        axes.errorbar([verdict.generation], [verdict.mean], yerr=verdict.error, elinewidth=1.3, **look)
    frame(axes, curve.name, curve.note, curve.generations)


def _legend(drawn: Figure, curves: Sequence[MeanCurve]) -> None:
    shown = [column for column in MEANINGS if any(curve.points(column) for curve in curves)]
    handles: list[Any] = [Line2D([], [], color=COLOURS[column], **CURVE_STYLES[column]) for column in shown]
    labels = [MEANINGS[column] for column in shown]
    if any(curve.attempts > 1 for curve in curves):
        handles.append(Patch(color=COLOURS["reevaluated"], **BAND))
        labels.append("± the standard error of the mean")
    columns = 4 if panels_per_row(len(curves)) > 2 else 2
    drawn.legend(handles, labels, loc="outside lower center", ncols=columns)
