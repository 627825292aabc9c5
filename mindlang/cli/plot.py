"""`mindc plot`: how skills were learnt, as curves.

Examples:
  mindc plot runs/GoToObject/20260714T120000Z-1
  mindc plot runs/GoToObject runs/Avoid -o curves.png
  mindc plot runs                           every run beneath it, side by side
  mindc plot GoToObject.csv.gz --json
  mindc plot runs/GoToObject --mean    the mean of its runs, and its error
  mindc plot runs --ticks              score by what it took
"""

from pathlib import Path

import click

from mindlang.cli._options import PATH, flag, json_flag, quiet_flag, written
from mindlang.cli._terminal import is_asked, need, print_json, refuse_unwritable, refusing_lessons, write_file


@click.command
@click.argument("runs", nargs=-1, required=True, metavar="RUN…", type=PATH)
@written("-o --output", "PATH", "A .svg or a .png file.", default="curves.svg", show_default=True)
@flag("--mean", "A panel for each lesson: the mean of its runs, and how sure it is.")
@flag("--ticks", "Along the ticks of an attempt so far, not its generations.")
@json_flag("Say what was drawn as one JSON document.")
@quiet_flag()
def command(runs: tuple[Path, ...], output: Path, mean: bool, ticks: bool) -> None:
    """Draw how the skills of every RUN were learnt.

    The best of each generation, and the champion on fresh layouts. A RUN is the folder of a run, which may still go on,
    a folder with runs beneath it, or a log as .csv or .csv.gz with the columns of progress.csv: attempt, generation,
    best, and where there are any reevaluated, verdict and ticks.

    With --mean, runs of one lesson of the same mind, begun with different seeds, become one panel: the mean over all
    their attempts, and a band of its standard error. An attempt that has ended or was given up keeps what it had last.
    """
    from mindlang.pictures.learning_log import along_ticks, by_lesson, load_curves
    from mindlang.training.standstill import idle_note

    need("matplotlib", "Curves are drawn with", "plot")
    refuse_unwritable(output, ".svg", ".png")
    with refusing_lessons():
        loaded = load_curves(runs)
        curves = [*map(along_ticks, loaded)] if ticks else loaded

    from mindlang.pictures.curves import figure, image, mean_figure

    lessons = by_lesson(curves) if mean else []
    write_file(output, image(mean_figure(lessons) if mean else figure(curves), output.suffix))
    if is_asked("as_json"):
        print_json({"picture": str(output), "curves": [each.data() for each in lessons or curves]})
    if not is_asked("quiet"):
        shown = curves[0].name if len(curves) == 1 else f"{len(curves)} runs"
        for curve in loaded:
            if note := idle_note(curve.records):
                click.echo(f"{curve.name}: {note}", err=True)
        click.echo(f"{output}: how {shown} {'was' if len(curves) == 1 else 'were'} learnt", err=True)
