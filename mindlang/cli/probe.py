"""`mindc probe`: what do the memories of a mind know of what was drawn for a run, and since when?

Examples:
  mindc probe tmaze.mind --of side
  mindc probe tmaze.mind Run --of side --runs 500
  mindc probe quiz.mind Ask --of asked --json
"""

from typing import Any

import click

from mindlang.cli import _options as options
from mindlang.cli import _terminal as terminal

DEFAULT_RUNS = 200


@click.command
@click.argument("file")
@click.argument("task", required=False, shell_complete=options.TASKS)
@click.option("--of", required=True, metavar="NAME", help="What is drawn: a number of the task, or an order.")
@click.option("--runs", type=options.RUNS, default=DEFAULT_RUNS, show_default=True, help="Fresh runs to ask in.")
@click.option("--seed", type=options.SEED, default=1, show_default=True, help="Draws the layouts.")
@options.named("--master", "SKILL", options.SKILLS, options.IN_CHARGE)
@options.json_flag()
@options.quiet_flag()
def command(file: str, task: str | None, of: str, runs: int, seed: int, master: str | None, **_: Any) -> None:
    """Ask what the memories of FILE know of what was drawn.

    On fresh runs of TASK a ridge regression tells the drawn number from what each memory keeps, and from the state of
    each skill that has one (elman, gru), at 24 ticks of a run. Of up to 10 values it is the share of runs in which the
    right one is told, of others the share of the variance that is explained; on runs that the regression has not seen,
    beside the mean of 20 permutations of the values (chance). It is known where no permutation does as well.

    Runs the Python code of the file's procedures.
    """
    from mindlang.attribution.knowledge import probe
    from mindlang.attribution.knowledge_report import probe_data, probe_summary
    from mindlang.cli._session import RunSession

    session = RunSession()
    setup, rollout = session.prepare(file, options.RunChoice(task, seed, master, True), 1, runs)
    seeds = setup.layouts(seed, runs)
    with session.counting(f"{setup.task.name} probed", len(seeds)) as ran:
        found = probe(setup, rollout, of, seeds, ran)
    session.note(*setup.world_notes, *rollout.notes)
    data = {"task": setup.task.name, "master": setup.master, "seed": seed} | probe_data(found)
    terminal.print_result(data, lambda: probe_summary(data))
