"""`mindc bench`: many runs of a task, for a figure that can be trusted."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mindlang import limits
from mindlang.cli._declared_names import SKILLS
from mindlang.cli._options import IN_CHARGE, OF_TASK, ON, SEED, WORKERS, NewFile, WholeOption, refuse_ineffective

if TYPE_CHECKING:
    from mindlang.cli._bench_pair import Contender
    from mindlang.cli._run_session import BenchChoice

EXAMPLES = """\b
Examples:
  mindc bench collect.mind
  mindc bench collect.mind --task Collect --runs 200 --seed 1
  mindc bench collect.mind --task Collect --no-interruption --json
  mindc bench collect.mind --task Collect --master Avoid --workers 1
  mindc bench collect.mind --task Collect --csv runs.csv   a row for each run
  mindc bench collect.mind best.mind --task Collect        on the same layouts
  mindc bench collect.mind --task Avoid --master Avoid --master Collect
  mindc bench collect.mind --runs 1000000 --on ssh:a,b     by two machines
  mindc bench collect.mind --runs 1000000 --on dask:scheduler.json
"""


@click.command(epilog=EXAMPLES)
@click.argument("files", nargs=-1, required=True, metavar="FILE [OTHER]")
@OF_TASK
@click.option(
    "--runs",
    type=WholeOption(*limits.RUN_BOUNDS),
    default=200,
    show_default=True,
    help="How many layouts to run the task on.",
)
@click.option("--seed", type=SEED, default=1, show_default=True, help="Draws the layouts.")
@click.option("--workers", type=WORKERS, help="How many cores to use (default: all). Changes nothing else.")
@click.option(
    "--master",
    "masters",
    metavar="SKILL",
    shell_complete=SKILLS,
    multiple=True,
    help=f"{IN_CHARGE} Twice: both are compared.",
)
@click.option("--on", "where", type=ON, metavar="WHERE", help="Who makes the runs: processes:N, ssh:HOST,HOST …")
@click.option("--no-interruption", is_flag=True, help="Go on to the last tick, whatever would end a run.")
@click.option("--csv", "table", type=NewFile(), metavar="PATH.csv", help="Write a row for each run.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document instead.")
@click.option("-q", "--quiet", is_flag=True, help="Print nothing but results and errors.")
def command(
    files: tuple[str, ...],
    task: str | None,
    runs: int,
    seed: int,
    workers: int | None,
    where: Any,
    masters: tuple[str, ...],
    no_interruption: bool,
    table: Path | None,
    as_json: bool,
    quiet: bool,
) -> None:
    """Run a task of FILE on many layouts, for figures to trust.

    With the weights that its skills were taught. Runs the Python code of the file's procedures. Each run has a seed of
    its own; `mindc run --seed` repeats it.

    With OTHER, or two masters, both run on the same layouts: how much they differ, with a confidence interval, and what
    may be said of it. It is said of the weights that both have, not of how such minds are taught in general.
    """
    from mindrun.processors import cores

    from mindlang.cli._bench_pair import compare_benched, contenders
    from mindlang.cli._run_session import BenchChoice
    from mindlang.cli._terminal import refuse_unwritable

    refuse_unwritable(table, ".csv")
    if where is not None:
        refuse_ineffective("for the cores of this machine: with --on others make the runs", "workers")
    chosen = BenchChoice(task, runs, seed, workers or cores(), not no_interruption, where)
    who = contenders(files, masters)
    if len(who) > 1:
        compare_benched(who, chosen, table, as_json, quiet)
    else:
        _bench(who[0], chosen, table, as_json, quiet)


def _bench(who: Contender, chosen: BenchChoice, table: Path | None, as_json: bool, quiet: bool) -> None:
    from mindlang.cli._run_session import RunSession
    from mindlang.cli._terminal import console, print_json, write_file
    from mindlang.run import outcome
    from mindlang.run.summary import bench_summary
    from mindlang.run.tables import csv_parts, runs_table

    session = RunSession(quiet)
    cast = chosen.task, who.master, chosen.interrupt, chosen.workers, chosen.runs
    setup, rollout = session.prepare(who.file, *cast)
    session.say(*(f"note: {note}" for note in setup.world_notes))
    seeds = setup.layouts(chosen.seed, chosen.runs)
    with session.scorer(setup, rollout, chosen) as scorer:
        scores, seconds, cpu = session.score(scorer, seeds)
    found: dict[str, Any] = {"task": setup.task.name, "master": setup.master, "seed": chosen.seed, **chosen.by}
    found |= outcome.bench_data(setup.task, scores, seeds, seconds, None if chosen.where else cpu)
    over = outcome.over_at_once(setup.task, scores)
    session.say(*(f"note: {note}" for note in over))
    found["notes"] = setup.notes(rollout, *over)
    if table:
        write_file(table, csv_parts(runs_table(setup.task, scores, seeds)))
        session.say(f"{table}: a row for each of {len(seeds):,} runs")
    if as_json:
        print_json(found)
    else:
        console().print(bench_summary(found))
