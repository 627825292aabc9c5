"""`mindc whatif`: a run with something changed, beside the run as it was."""

from __future__ import annotations

from pathlib import Path

import click

from mindlang.cli._options import NewFile, WholeOption

EXAMPLES = """\b
Examples:
  mindc whatif collect.mind --task Collect --seed 3 --tick 812 --without Avoid
  mindc whatif collect.mind --task Collect --seed 3 --sensor proximity=1 --picture paths.png
  mindc whatif collect.mind --task Collect --seed 3 --tick 812 --set object_bearing=0.5 --ticks 60
  mindc whatif collect.mind --task Collect --seed 3 --tick 812 --without Avoid --json
"""


@click.command(epilog=EXAMPLES)
@click.argument("file")
@click.option("--task", metavar="TASK", help="Default: that on which the master is taught, or of its name.")
@click.option("--seed", type=WholeOption(0, 2**64 - 1), default=1, show_default=True, help="Of the run.")
@click.option("--master", metavar="SKILL", help="Who is in charge. Default: the master of the task's first lesson.")
@click.option("--no-interruption", is_flag=True, help="Go on to the last tick, whatever would end the run.")
@click.option("--tick", type=WholeOption(1, 2**53), default=1, help="The first tick that is changed. Default: 1.")
@click.option(
    "--ticks", type=WholeOption(1, 2**53), help="How many are. Default: all that follow; one with --set alone."
)
@click.option("--without", multiple=True, metavar="SKILL", help="Silence a skill: it has no influence.")
@click.option("--sensor", multiple=True, metavar="NAME=0.5", help="What a sensor reads; NAME=1,0.5,1 of a wide one.")
@click.option(
    "--set", "settings", multiple=True, metavar="NAME=0.5", help="A reading, a memory or an influence, for one tick."
)
@click.option("--picture", type=NewFile(), metavar="PATH.png", help="Draw both paths.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document instead.")
@click.option("-q", "--quiet", is_flag=True, help="Print nothing but results and errors.")
def command(
    file: str,
    task: str | None,
    seed: int,
    master: str | None,
    no_interruption: bool,
    tick: int,
    ticks: int | None,
    without: tuple[str, ...],
    sensor: tuple[str, ...],
    settings: tuple[str, ...],
    picture: Path | None,
    as_json: bool,
    quiet: bool,
) -> None:
    """Run a task of FILE as it is, and again with something changed from a tick on.

    Both runs are the same to the bit until then. Says in which tick they differ first and in what, and what came of
    both. Runs the Python code of the file's procedures.
    """
    from mindlang.cli._comparing import Played, compare_runs
    from mindlang.cli._terminal import refuse_unwritable
    from mindlang.whatif.request import Request

    request = Request(tick, ticks, without, sensor, settings)
    refuse_unwritable(picture, ".png")
    compare_runs(file, Played(task, seed, master, not no_interruption), request, picture, as_json, quiet)
