"""`mindc whatif`: a run with something changed, beside the run as it was."""

from __future__ import annotations

from pathlib import Path

import click

from mindlang.cli._declared_names import SKILLS, declared
from mindlang.cli._options import (
    LAYOUT,
    OF_A_RUN,
    OF_RUNS_ALONE,
    OF_TASK,
    UNDER_MASTER,
    NewFile,
    WholeOption,
    refuse_ineffective,
)

EXAMPLES = """\b
Examples:
  mindc whatif collect.mind --task Collect --seed 3 --tick 812 --without Avoid
  mindc whatif collect.mind --seed 3 --sensor proximity=1 --picture paths.png
  mindc whatif collect.mind --tick 812 --set object_bearing=0.5 --ticks 60
  mindc whatif collect.mind --seed 3 --tick 812 --without Avoid --json
  mindc whatif collect.mind --seed 3 --tick 812 --with other.mind
  mindc whatif collect.mind --seed 3 --sensor proximity=other.rec
  mindc whatif day.rec ball.bundle --without Avoid
"""


@click.command(epilog=EXAMPLES)
@click.argument("file")
@click.argument("bundle", required=False, type=click.Path(path_type=Path))
@OF_TASK
@click.option("--seed", type=LAYOUT, help="Of the run. Default: 1.")
@UNDER_MASTER
@click.option("--no-interruption", is_flag=True, help="Go on to the last tick, whatever would end the run.")
@click.option("--tick", type=WholeOption(1, 2**53), default=1, help="The first tick that is changed. Default: 1.")
@click.option("--ticks", type=WholeOption(1, 2**53), help="How many are. Default: all that follow; one with --set.")
@click.option(
    "--without", multiple=True, metavar="SKILL", shell_complete=SKILLS, help="Silence a skill: it has no influence."
)
@click.option(
    "--sensor",
    multiple=True,
    metavar="NAME=0.5",
    shell_complete=declared("sensor"),
    help="What a sensor reads: NAME=0.5, NAME=1,0.5,1, NAME=day.rec",
)
@click.option(
    "--set", "settings", multiple=True, metavar="NAME=0.5", help="A reading, a memory or an influence, for one tick."
)
@click.option("--with", "other", metavar="OTHER.mind", help="Another mind takes over: other weights, another version.")
@click.option("--picture", type=NewFile(), metavar="PATH.png", help="Draw both paths.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document instead.")
@click.option("-q", "--quiet", is_flag=True, help="Print nothing but results and errors.")
def command(
    file: str,
    bundle: Path | None,
    task: str | None,
    seed: int | None,
    master: str | None,
    no_interruption: bool,
    tick: int,
    ticks: int | None,
    without: tuple[str, ...],
    sensor: tuple[str, ...],
    settings: tuple[str, ...],
    other: str | None,
    picture: Path | None,
    as_json: bool,
    quiet: bool,
) -> None:
    """Run a task of FILE as it is, and again with something changed.

    Both runs are the same to the bit until the tick of the change. Says in which tick they differ first and in what,
    and what came of both. Runs the Python code of the file's procedures.

    Where FILE is a recording, BUNDLE is the one that was running, or the .mind file that it is built from: says what it
    would have sent for the same readings, in an open loop.
    """
    from mindlang.cli._comparing import Played, compare_recorded, compare_runs
    from mindlang.whatif.request import Request

    request = Request(tick, ticks, without, sensor, settings, other)
    if other and ticks:
        raise click.UsageError("A mind that takes over goes on to the end: leave out --ticks.")
    if bundle is None and file.endswith(".rec"):
        raise click.UsageError(f"{file} is a recording: say the bundle that was running after it.")
    if bundle is None:
        played = Played(task, 1 if seed is None else seed, master, not no_interruption, picture)
        compare_runs(file, played, request, as_json, quiet)
        return
    refuse_ineffective(OF_RUNS_ALONE, *OF_A_RUN, "picture")
    compare_recorded(Path(file), bundle, request, as_json)
