"""How skills were learnt, as a figure for a notebook or a program."""

from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from mindrun.errors import MindError

from mindlang.pictures.learning_log import along_ticks, by_lesson, load_curves

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def plot_training(*runs: Path | str, mean: bool = False, ticks: bool = False) -> "Figure":
    """How the skills of these runs were learnt, as `mindc plot` draws it: a matplotlib figure.

    Each is the folder of a run (a result of `train` has its own as `run`), a folder with runs beneath it, or a table of
    a log. With `mean`, runs of one lesson become one panel with their mean; with `ticks`, they are drawn along those.
    MindError where there is nothing to draw.

    >>> [result] = mind.train("GoToObject", options=mindlang.TrainOptions(generations=1, attempts=1))
    >>> mindlang.plot_training(result["run"]).savefig("curves.svg")
    """
    if find_spec("matplotlib") is None:
        raise MindError("curves are drawn with matplotlib, which is not installed", "pip install 'mindlang[plot]'")
    from mindlang.pictures.curves import figure, mean_figure

    curves = load_curves([Path(run) for run in runs])
    if not curves:
        raise MindError("there is no run to draw", 'name one: mindlang.plot_training("runs")')
    curves = [*map(along_ticks, curves)] if ticks else curves
    return mean_figure(by_lesson(curves)) if mean else figure(curves)
