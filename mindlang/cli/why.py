"""`mindc why`: who made a command, an influence or a reward.

Examples:
  mindc why collect.mind --task Collect --seed 3 --tick 812 left_wheel
  mindc why collect.mind --task Collect --seed 3 --tick 800..812 Avoid
  mindc why collect.mind --task Collect --seed 3 --tick 800..812 reward
  mindc why collect.mind --task Collect --seed 3 claw --json
  mindc why day.rec ball.bundle --tick 812 left_wheel
  mindc why run.rec collect.mind --tick 812 left_wheel   of mindc run --record
  mindc why collect.mind --task Collect --ends --runs 300
  mindc why drive.rec collect.mind --skills            a drive taken apart
"""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from mindrun.processors import cores

from mindlang.cli import _options as options
from mindlang.cli._terminal import MISUSE, print_result, procedures_talk, refusing

if TYPE_CHECKING:
    from mindlang.attribution.answer import AttributedRun

ASKED_ABOUT = options.declared("actuator", "memory", "skill")


@click.command
@click.argument("words", nargs=-1, required=True, metavar="FILE [BUNDLE] WHAT", shell_complete=ASKED_ABOUT)
@options.run_options(seed="Of the run; with --ends of the layouts, as in bench. Default: 1.")
@click.option("--tick", type=options.tick_span, metavar="T or T..U", help="Which ticks, from 1. Default: all of them.")
@click.option("--paths", type=options.WholeOption(1, 1000), help="How many are named. Default: 10.")
@options.flag("--ends", "Say how many runs end, and where the robot ran into something.")
@options.flag("--skills", "Say which skills, with which influence when, explain a recorded drive.")
@click.option("--runs", type=options.RUNS, default=200, show_default=True, help="With --ends: on how many layouts.")
@options.json_flag()
@options.quiet_flag()
def command(
    words: tuple[str, ...],
    chosen: options.RunChoice,
    tick: tuple[int, int] | None,
    paths: int | None,
    ends: bool,
    skills: bool,
    runs: int,
) -> None:
    """Say who made a command, and with which shares.

    WHAT is an actuator, a memory, a skill (who influenced it?) or `reward` (what each line paid). Shares add up to the
    command. Over several ticks all numbers are means. Runs the task of FILE as `mindc run` does; runs the Python code
    of its procedures.

    Where FILE is a recording, BUNDLE is the one that was running, or the .mind file that it is built from, and ticks
    are the rows of the recording.

    With --ends and no WHAT many runs are made. Of those that are over before their time it is said what ended them,
    which skill moved the robot most, where on its body it ran into something, and what its rays had read.

    With --skills and no WHAT it is said of a recorded drive, by whomever, which skills of the mind explain its commands
    with which shares of influence, which stretches none of them does, and which skill could be taught for those.
    """
    if ends:
        where_runs_end(words, chosen, runs)
        return
    options.refuse_ineffective("of --ends", "runs")
    if skills:
        take_apart(words)
        return
    from mindlang.attribution.answer import QuestionError, answer
    from mindlang.attribution.report import answer_text

    *files, what = words
    attributed = attributed_files(files, chosen)
    with refusing(MISUSE, of=QuestionError), procedures_talk():
        found = answer(attributed, what, tick, paths)
    print_result(found, lambda: answer_text(found))


def attributed_files(files: Sequence[str], chosen: options.RunChoice) -> "AttributedRun":
    """The run of a mind, made now, or the recording that is asked about, with its flows."""
    from mindlang.attribution.answer import attributed_recording, attributed_run
    from mindlang.cli._session import RunSession, refusing_recordings

    match files:
        case [file] if not file.endswith(".rec"):
            session, seed = RunSession(), 1 if chosen.seed is None else chosen.seed
            return attributed_run(session.record(*session.prepare(file, chosen), seed).run, seed)
        case [recording, bundle]:
            options.refuse_ineffective(options.OF_RUNS_ALONE, *options.OF_A_RUN)
            with refusing_recordings():
                return attributed_recording(Path(recording), Path(bundle))
        case _:
            raise click.UsageError(
                "Say a file and what is asked about: mindc why collect.mind left_wheel, or mindc why day.rec "
                "ball.bundle left_wheel."
            )


def where_runs_end(words: Sequence[str], chosen: options.RunChoice, runs: int) -> None:
    """Make many runs, and print what the last ticks of those have in common that are over before their time."""
    from mindrun.sim.codes import GOING_ON

    from mindlang.attribution.ends import ends_data, run_ends
    from mindlang.attribution.ends_report import ends_text
    from mindlang.cli._session import RunSession, refusing_setups

    options.refuse_ineffective("not for --ends, which looks at last ticks alone", "tick", "paths", "interrupt")
    file, *more = words
    if more or file.endswith(".rec"):
        raise click.UsageError("--ends is of many runs of one mind: mindc why collect.mind --ends.")
    session, seed = RunSession(), 1 if chosen.seed is None else chosen.seed
    setup, rollout = session.prepare(file, chosen, cores(), runs)
    with refusing_setups():
        seeds = setup.layouts(seed, runs)
    session.note(*setup.world_notes)
    scores, *_ = session.score(rollout, seeds)
    with session.progress() as progress, procedures_talk():
        over = scores.ended_by[0] != GOING_ON
        made = progress.track(run_ends(setup, rollout, seeds, scores), int(over.sum()), description="their ends")
        data = ends_data(setup, seed, scores, [*made])
    print_result(data, lambda: ends_text(data))


def take_apart(words: Sequence[str]) -> None:
    """Print which skills explain a drive, and what is left over."""
    from mindlang.attribution.mixture import taken_apart
    from mindlang.attribution.mixture_report import mixture_data, mixture_text
    from mindlang.cli._session import refusing_recordings
    from mindlang.cli._terminal import fail, load_compiled
    from mindlang.training.subject import open_subject

    options.refuse_ineffective("not for --skills, which takes a whole recording apart", "tick", "paths")
    options.refuse_ineffective(options.OF_RUNS_ALONE, *options.OF_A_RUN)
    if len(words) != 2 or not words[0].endswith(".rec"):
        raise click.UsageError("--skills is of a recording and a mind: mindc why drive.rec collect.mind --skills.")
    recording, file = words
    with refusing_recordings():
        subject, found = open_subject(Path(file), load_compiled(file)), list[dict[str, Any]]()
        for drive, mixtures in taken_apart(subject, [Path(recording)]):
            found += mixture_data(subject.graph, drive, mixtures)
    if not found:
        fail(f"No skill of {file} that is taught reads what {recording} has.", "mindc status says which are.", MISUSE)
    print_result(found, lambda: mixture_text(found, recording, file))
