"""`mindc why`: who made a command, an influence or a reward."""

from __future__ import annotations

import click

from mindlang.cli._declared_names import declared
from mindlang.cli._options import (
    LAYOUT,
    OF_A_RUN,
    OF_RUNS_ALONE,
    OF_TASK,
    UNDER_MASTER,
    TickSpan,
    WholeOption,
    refuse_ineffective,
)

EXAMPLES = """\b
Examples:
  mindc why collect.mind --task Collect --seed 3 --tick 812 left_wheel
  mindc why collect.mind --task Collect --seed 3 --tick 800..812 Avoid
  mindc why collect.mind --task Collect --seed 3 --tick 800..812 reward
  mindc why collect.mind --task Collect --seed 3 claw --json
  mindc why day.rec ball.bundle --tick 812 left_wheel
  mindc why run.rec collect.mind --tick 812 left_wheel   of mindc run --record
"""


@click.command(epilog=EXAMPLES)
@click.argument(
    "words",
    nargs=-1,
    required=True,
    metavar="FILE [BUNDLE] WHAT",
    shell_complete=declared("actuator", "memory", "skill"),
)
@OF_TASK
@click.option("--seed", type=LAYOUT, help="Of the run. Default: 1.")
@UNDER_MASTER
@click.option("--no-interruption", is_flag=True, help="Go on to the last tick, whatever would end the run.")
@click.option("--tick", type=TickSpan(), metavar="T or T..U", help="Which ticks, from 1. Default: all of them.")
@click.option("--paths", type=WholeOption(1, 1000), help="How many are named. Default: 10.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document instead.")
@click.option("-q", "--quiet", is_flag=True, help="Print nothing but results and errors.")
def command(
    words: tuple[str, ...],
    task: str | None,
    seed: int | None,
    master: str | None,
    no_interruption: bool,
    tick: tuple[int, int] | None,
    paths: int | None,
    as_json: bool,
    quiet: bool,
) -> None:
    """Say who made a command, and with which shares.

    WHAT is an actuator, a memory, a skill (who influenced it?) or `reward` (what each line paid). Shares add up to the
    command. Over several ticks all numbers are means. Runs the task of FILE as `mindc run` does; runs the Python code
    of its procedures.

    Where FILE is a recording, BUNDLE is the one that was running, or the .mind file that it is built from, and ticks
    are the rows of the recording.
    """
    from mindlang.cli._asking import Asked, explain_recording, explain_run

    *files, what = words
    asked = Asked(what, tick, paths, as_json)
    match files:
        case [file] if not file.endswith(".rec"):
            explain_run(file, task, 1 if seed is None else seed, master, not no_interruption, quiet, asked)
        case [recording, bundle]:
            refuse_ineffective(OF_RUNS_ALONE, *OF_A_RUN)
            explain_recording(recording, bundle, asked)
        case _:
            raise click.UsageError(
                "Say a file and what is asked about: mindc why collect.mind left_wheel, or mindc why day.rec "
                "ball.bundle left_wheel."
            )
