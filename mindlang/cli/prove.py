"""`mindc prove`: what can be said about a mind without running it."""

from __future__ import annotations

import click

from mindlang.cli._declared_names import SKILLS, TASKS
from mindlang.cli._options import LAYOUT, NumberOption

EXAMPLES = """\b
Examples:
  mindc prove collect.mind
  mindc prove collect.mind --leak 0.05
  mindc prove collect.mind --master GoToObject+Avoid
  mindc prove collect.mind --run --seed 3
  mindc prove collect.mind --json
"""


@click.command(epilog=EXAMPLES)
@click.argument("file")
@click.option(
    "--leak",
    type=NumberOption(0, 1, min_open=True),
    default=0.01,
    metavar="δ",
    help="What a learnt line sends where it should send 0. Default: 0.01.",
)
@click.option("--master", metavar="SKILL", shell_complete=SKILLS, help="Who is in charge. Default: the mind's master.")
@click.option("--run", "with_run", is_flag=True, help="Run a task, too, and count ticks without influence.")
@click.option(
    "--task", metavar="TASK", shell_complete=TASKS, help="Of the run. Default: the one that `mindc run` takes."
)
@click.option("--seed", type=LAYOUT, default=1, help="Of the run. Default: 1.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document instead.")
def command(
    file: str, leak: float, master: str | None, with_run: bool, task: str | None, seed: int, as_json: bool
) -> None:
    """Prove what FILE can and cannot do, for any readings.

    From the declaration alone: the paths of influence to each actuator, and how much of a command small leaks of
    influence along them can take. With weights: what each actuator can be sent, whether it can be without influence
    (its neutral is sent then), which skills and lines are dead. Every claim says what it rests on.

    Runs no Python code of the file's procedures, except with --run.
    """
    if task is not None and not with_run:
        raise click.UsageError("--task is of the run: say --run, too.")
    from mindlang.cli._proving import ProofOptions, perform

    perform(file, ProofOptions(leak, master, with_run, task, seed, as_json))
