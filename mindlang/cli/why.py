"""`mindc why`: who made a command, an influence or a reward."""

from pathlib import Path

import click

from mindlang.cli import _options as options
from mindlang.cli._terminal import MISUSE, print_result, procedures_talk, refusing

EXAMPLES = """\b
Examples:
  mindc why collect.mind --task Collect --seed 3 --tick 812 left_wheel
  mindc why collect.mind --task Collect --seed 3 --tick 800..812 Avoid
  mindc why collect.mind --task Collect --seed 3 --tick 800..812 reward
  mindc why collect.mind --task Collect --seed 3 claw --json
  mindc why day.rec ball.bundle --tick 812 left_wheel
  mindc why run.rec collect.mind --tick 812 left_wheel   of mindc run --record
"""
ASKED_ABOUT = options.declared("actuator", "memory", "skill")


@click.command(epilog=EXAMPLES)
@click.argument("words", nargs=-1, required=True, metavar="FILE [BUNDLE] WHAT", shell_complete=ASKED_ABOUT)
@options.run_options(seed="Of the run. Default: 1.")
@click.option("--tick", type=options.tick_span, metavar="T or T..U", help="Which ticks, from 1. Default: all of them.")
@click.option("--paths", type=options.WholeOption(1, 1000), help="How many are named. Default: 10.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document instead.")
@click.option("-q", "--quiet", is_flag=True, help="Print nothing but results and errors.")
def command(
    words: tuple[str, ...],
    chosen: options.RunChoice,
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
    from mindlang.attribution.answer import QuestionError, answer, attributed_recording, attributed_run
    from mindlang.attribution.report import answer_text
    from mindlang.cli._session import RunSession, refusing_recordings

    *files, what = words
    match files:
        case [file] if not file.endswith(".rec"):
            session, seed = RunSession(quiet), 1 if chosen.seed is None else chosen.seed
            made = session.record(*session.prepare(file, chosen), seed)
            attributed = attributed_run(made.run, seed)
        case [recording, bundle]:
            options.refuse_ineffective(options.OF_RUNS_ALONE, *options.OF_A_RUN)
            with refusing_recordings():
                attributed = attributed_recording(Path(recording), Path(bundle))
        case _:
            raise click.UsageError(
                "Say a file and what is asked about: mindc why collect.mind left_wheel, or mindc why day.rec "
                "ball.bundle left_wheel."
            )
    with refusing(MISUSE, of=QuestionError), procedures_talk():
        found = answer(attributed, what, tick, paths)
    print_result(as_json, found, lambda: answer_text(found))
