"""`mindc bench`: many runs of a task, for a figure that can be trusted."""

from __future__ import annotations

import click

from mindlang.cli._options import SEED, WORKERS, WholeOption

EXAMPLES = """\b
Examples:
  mindc bench collect.mind
  mindc bench collect.mind --task Collect --runs 200 --seed 1
  mindc bench collect.mind --task Collect --no-interruption --json
  mindc bench collect.mind --task Collect --master Avoid --workers 1
"""


@click.command(epilog=EXAMPLES)
@click.argument("file")
@click.option("--task", metavar="TASK", help="Default: that on which the master is taught, or of its name.")
@click.option(
    "--runs",
    type=WholeOption(1, 10_000_000),
    default=200,
    show_default=True,
    help="How many layouts to run the task on.",
)
@click.option("--seed", type=SEED, default=1, show_default=True, help="Draws the layouts.")
@click.option("--workers", type=WORKERS, help="How many cores to use (default: all). Changes nothing else.")
@click.option("--master", metavar="SKILL", help="Who is in charge. Default: the master of the task's first lesson.")
@click.option("--no-interruption", is_flag=True, help="Go on to the last tick, whatever would end a run.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document instead.")
@click.option("-q", "--quiet", is_flag=True, help="Print nothing but results and errors.")
def command(
    file: str,
    task: str | None,
    runs: int,
    seed: int,
    workers: int | None,
    master: str | None,
    no_interruption: bool,
    as_json: bool,
    quiet: bool,
) -> None:
    """Run a task of FILE on many layouts, for figures to trust.

    With the weights that its skills were taught. Runs the Python code of the file's procedures. Each run has a seed of
    its own; `mindc run --seed` repeats it.
    """
    from mindrun.sim.rollout import cores

    from mindlang.cli._run_session import RunSession
    from mindlang.cli._terminal import console, print_json
    from mindlang.run import outcome
    from mindlang.run.layouts import layouts
    from mindlang.run.summary import bench_summary

    session = RunSession(quiet)
    workers = workers or cores()
    setup, rollout = session.prepare(file, task, master, interrupt=not no_interruption, workers=workers, runs=runs)
    seeds = layouts(seed, runs)
    scores, seconds = session.score(rollout, seeds)
    found = {"task": setup.task.name, "master": setup.master, "seed": seed, "workers": workers}
    found |= outcome.bench_data(setup.task, scores, seeds, seconds) | {"notes": [*setup.ready.notes, *rollout.notes]}
    if as_json:
        print_json(found)
    else:
        console().print(bench_summary(found))
