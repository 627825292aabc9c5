"""The lives of agents as a figure: for each what it can do after each lesson, and how all of them get on."""

from collections.abc import Mapping
from math import ceil
from typing import Any

import numpy as np
from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from mindlang.pictures.curves import ATTEMPTS, FAINT, INK, PAGE, STYLE

PANEL_COLUMNS, PANEL_INCHES = 4, 2.1  # panels in a row; the height of one, and without names its width
NAMES_INCHES = 1.4  # for the names of the tasks, and the scale
SHADES, UNKNOWN = "YlGnBu", "#ececee"  # from nothing to all; of who could not play yet
MARKS = ("o", "s", "^", "D", "v", "P", "X", "*")


@style.context(STYLE)
def figure(found: Mapping[str, Any]) -> Figure:
    """A panel for each agent, with a field for each task after each lesson; their means in the last panel."""
    agents = found["agents"]
    rows = ceil((len(agents) + 1) / PANEL_COLUMNS)
    size = PANEL_COLUMNS * PANEL_INCHES + NAMES_INCHES, rows * PANEL_INCHES + 0.4
    drawn = Figure(figsize=size, layout="constrained", facecolor=PAGE)
    panels = drawn.subplots(rows, PANEL_COLUMNS, squeeze=False).ravel()
    for place, (name, of) in enumerate(agents.items()):
        fields = _fields(panels[place], np.array(of["performance_after"], float)[:, : found["lessons"]])
        panels[place].set_yticklabels([] if place % PANEL_COLUMNS else found["setup"]["tasks"][: found["lessons"]])
        performance, forgetting = (np.mean(of[measure]) + 0.0 for measure in ("performance", "forgetting"))
        _head(panels[place], name, f"performance {performance:.2f}, forgetting {forgetting:.2f}")
    for axes in panels[len(agents) :]:
        axes.set_axis_off()
    _means(panels[len(agents)], found)
    scale = drawn.colorbar(fields, ax=panels.tolist(), shrink=0.6, aspect=40, pad=0.01, label="performance")
    scale.outline.set_visible(False)
    looks = panels[len(agents)].get_legend_handles_labels()
    drawn.legend(*looks, loc="outside lower center", ncols=len(agents), fontsize=7, columnspacing=1.2)
    return drawn


def _head(axes: Axes, name: str, note: str) -> None:
    """The name of a panel, and a note below it."""
    axes.set_title(name, pad=12)
    axes.annotate(note, (0, 1), (0, 4), xycoords="axes fraction", textcoords="offset points", size=6.5, color=FAINT)


def _fields(axes: Axes, shares: Any) -> Any:
    """A column for each lesson and a row for each task; the task of each lesson has a frame."""
    axes.grid(False)
    axes.set_facecolor(UNKNOWN)
    fields = axes.imshow(shares.T, cmap=SHADES, vmin=0, vmax=1, aspect="auto", interpolation="nearest")
    for i in range(len(shares)):
        axes.add_patch(Rectangle((i - 0.5, i - 0.5), 1, 1, fill=False, edgecolor=INK, linewidth=0.8))
    axes.set_xticks(range(len(shares)), [str(i + 1) for i in range(len(shares))])
    axes.set_yticks(range(len(shares)))
    axes.tick_params(length=0)
    axes.set_xlabel("after lesson")
    return fields


def _means(axes: Axes, found: Mapping[str, Any]) -> None:
    """After each lesson the mean performance on the tasks taught so far, a line for each agent."""
    axes.set_axis_on()
    lessons = range(1, found["lessons"] + 1)
    for number, (name, of) in enumerate(found["agents"].items()):
        shares = np.array(of["performance_after"], float)
        means = [shares[lesson - 1, :lesson].mean() for lesson in lessons]
        look: dict[str, Any] = {"color": ATTEMPTS[number], "marker": MARKS[number], "markersize": 3.4, "linewidth": 1.2}
        axes.plot(lessons, means, label=name, zorder=3, clip_on=False, **look)
    axes.set_ylim(0, 1)
    axes.set_xticks(list(lessons))
    axes.set_xlabel("after lesson")
    _head(axes, "all of them", "mean of the tasks taught so far")
