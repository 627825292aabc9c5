"""`mindc plot`: how skills were learnt, as curves."""

from importlib.util import find_spec
from pathlib import Path

import click

from mindlang.cli._options import PATH, written
from mindlang.cli._terminal import MISUSE, fail, print_json, refuse_unwritable, refusing, write_file

EXAMPLES = """\b
Examples:
  mindc plot runs/GoToObject/20260714T120000Z-1
  mindc plot runs/GoToObject runs/Avoid -o curves.png
  mindc plot runs                           every run beneath it, side by side
  mindc plot GoToObject.csv.gz --json
  mindc plot runs/GoToObject --mean    the mean of its runs, and its error
  mindc plot runs --ticks              score by what it took
"""


@click.command(epilog=EXAMPLES)
@click.argument("runs", nargs=-1, required=True, metavar="RUN…", type=PATH)
@written("-o --output", "PATH", "A .svg or a .png file.", default="curves.svg", show_default=True)
@click.option("--mean", is_flag=True, help="A panel for each lesson: the mean of its runs, and how sure it is.")
@click.option("--ticks", is_flag=True, help="Along the ticks of an attempt so far, not its generations.")
@click.option("--json", "as_json", is_flag=True, help="Say what was drawn as one JSON document.")
@click.option("-q", "--quiet", is_flag=True, help="Print nothing but results and errors.")
def command(runs: tuple[Path, ...], output: Path, mean: bool, ticks: bool, as_json: bool, quiet: bool) -> None:
    """Draw how the skills of every RUN were learnt.

    The best of each generation, and the champion on fresh layouts. A RUN is the folder of a run, which may still go on,
    a folder with runs beneath it, or a log as .csv or .csv.gz with the columns of progress.csv: attempt, generation,
    best, and where there are any reevaluated, verdict and ticks.

    With --mean, runs of one lesson of the same mind, begun with different seeds, become one panel: the mean over all
    their attempts, and a band of its standard error. An attempt that has ended or was given up keeps what it had last.
    """
    from mindrun.train import NotFoundError

    from mindlang.pictures.learning_log import along_ticks, by_lesson, load_curves
    from mindlang.training.standstill import idle_note

    if find_spec("matplotlib") is None:
        fail("Curves are drawn with matplotlib, which is not installed.", "pip install 'mindlang[plot]'", MISUSE)
    refuse_unwritable(output, ".svg", ".png")
    with refusing(), refusing(MISUSE, of=NotFoundError):
        loaded = load_curves(runs)
        curves = [*map(along_ticks, loaded)] if ticks else loaded

    from mindlang.pictures.curves import figure, image, mean_figure

    lessons = by_lesson(curves) if mean else []
    write_file(output, image(mean_figure(lessons) if mean else figure(curves), output.suffix))
    if as_json:
        print_json({"picture": str(output), "curves": [each.data() for each in lessons or curves]})
    if not quiet:
        shown = curves[0].name if len(curves) == 1 else f"{len(curves)} runs"
        for curve in loaded:
            if note := idle_note(curve.records):
                click.echo(f"{curve.name}: {note}", err=True)
        click.echo(f"{output}: how {shown} {'was' if len(curves) == 1 else 'were'} learnt", err=True)
