"""`mindc bench`: many runs of a task for a figure that can be trusted, of one mind or of two on the same layouts.

Examples:
  mindc bench collect.mind
  mindc bench collect.mind --task Collect --runs 200 --seed 1
  mindc bench collect.mind --task Collect --no-interruption --json
  mindc bench collect.mind --task Collect --master Avoid --workers 1
  mindc bench collect.mind --task Collect --csv runs.csv   a row for each run
  mindc bench collect.mind best.mind --task Collect        on the same layouts
  mindc bench collect.mind --task Avoid --master Avoid --master Collect
  mindc bench collect.mind best.mind --worlds --runs 100   weaker, noisier …
  mindc bench collect.mind --task Collect --credit         of each skill
  mindc bench best.mind on_the_job.mind --credit           of what it learnt
  mindc bench collect.mind --runs 1000000 --on ssh:a,b     by two machines
  mindc bench collect.mind --runs 1000000 --on dask:scheduler.json
"""

from typing import Any

import click
from mindrun.processors import cores

from mindlang.cli import _options as options
from mindlang.cli import _terminal as terminal
from mindlang.cli._options import flag


@click.command
@click.argument("files", nargs=-1, required=True, metavar="FILE [OTHER]")
@options.OF_TASK
@click.option("--runs", type=options.RUNS, default=200, show_default=True, help="How many layouts to run the task on.")
@click.option("--seed", type=options.SEED, default=1, show_default=True, help="Draws the layouts.")
@options.WORKERS
@options.named(
    "--master masters", "SKILL", options.SKILLS, f"{options.IN_CHARGE} Twice: both are compared.", multiple=True
)
@options.ON(help="Who makes the runs: processes:N, ssh:HOST,HOST …")
@options.unless("--no-interruption interrupt", "Go on to the last tick, whatever would end a run.")
@flag("--worlds", "Run in changed worlds as well: denser, weaker, noisier, delayed …")
@flag("--credit", "Run without each skill as well, or as OTHER has it: what is it worth?")
@options.written("--csv table", "PATH.csv", "Write a row for each run.")
@options.json_flag()
@options.quiet_flag()
def command(files: tuple[str, ...], masters: tuple[str, ...], workers: int | None, **said: Any) -> None:
    """Run a task of FILE on many layouts, for figures to trust.

    With the weights that its skills were taught. Runs the Python code of the file's procedures. Each run has a seed of
    its own; `mindc run --seed` repeats it.

    With OTHER, or two masters, both run on the same layouts: how much they differ, with a confidence interval, and what
    may be said of it. It is said of the weights that both have, not of how such minds are taught in general.

    Of a task with several robots, also who does what: the share of ticks in which each skill that the master influences
    has the most influence on each robot, and how labour is divided by that.

    With --worlds, on the same layouts again with one number of the world or the robot changed, in a table with the
    worst first: lengths, forces and their like by a quarter, readings 5 % off or lost, commands 0.1 s late. The share
    is that of what it is as taught.

    With --credit, on the same layouts again with each skill silent in turn: how much more the whole mind has, with a
    confidence interval, the greatest credit first. With OTHER, such as what a mind was before its last lesson, each
    skill is not silent but has the weights that it has there.
    """
    from mindlang.cli._bench import Bench, contenders
    from mindlang.cli._session import RunSession

    worlds, credit = said.pop("worlds"), said.pop("credit")
    bench = Bench(RunSession(), workers or cores(), **said)
    terminal.refuse_unwritable(bench.table, ".csv")
    if bench.where is not None:
        options.refuse_ineffective("for the cores of this machine: with --on others make the runs", "workers")
    who = contenders(files, masters)
    if credit:
        options.refuse_ineffective("another table: ask for one after the other", "worlds")
        bench.credit(who)
    elif worlds:
        bench.in_worlds(who)
    elif len(who) > 1:
        bench.compare(who)
    else:
        bench.measure(who)
