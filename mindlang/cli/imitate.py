"""`mindc imitate`: a skill learns from recordings what a mind or a hand did there.

Examples:
  mindc imitate collect.mind GoToObject drive.rec
  mindc imitate collect.mind GoToObject drives/*.rec --seed 2
  mindc imitate collect.mind GoToObject drives/*.rec --json
  mindc imitate collect.mind GoToObject drive.rec --force
"""

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mindlang.cli import _options as options
from mindlang.cli import _terminal as terminal
from mindlang.number_format import short_score

if TYPE_CHECKING:
    from rich.console import RenderableType

    from mindlang.weights.imitation import Imitation
    from mindlang.weights.importing import Imported


@click.command
@click.argument("file")
@click.argument("skill", shell_complete=options.SKILLS)
@click.argument("recordings", nargs=-1, required=True, metavar="DRIVE.rec...", type=options.PATH)
@click.option("--seed", type=options.SEED, default=1, show_default=True, help="Draws weights, and what is held out.")
@options.flag("--force", "Take the weights even where they do worse than those that are there.")
@options.json_flag()
@options.quiet_flag()
def command(file: str, skill: str, recordings: tuple[Path, ...], seed: int, force: bool) -> None:
    """Fit SKILL of FILE to what was done in recordings.

    What it reads in each tick is to lead to what its actuators got then, from another skill, a rule or a hand. Of a
    skill that influences others it is the influence that these had. A fifth of the drives is held out, at least one, or
    of a single one the last fifth: how far the skill is off there is said of each output, in 0..1.

    Then it is tried on fresh layouts of its lesson, or of the task of the recordings. Its weights go to the lock,
    unless those that are there do better, and `mindc train FILE SKILL` goes on from them. Runs the Python code of the
    file's procedures.

    Ends with 1 where the lock stays as it is.
    """
    terminal.refuse_standard_input(file, "Weights are kept beside a file, and standard input is none.")
    made, found = _imitated(file, skill, recordings, seed, force)
    terminal.print_result(made.data(found), lambda: _report(made, found))
    sys.exit(terminal.OK if found.is_kept else terminal.FINDINGS)


def _imitated(
    file: str, skill: str, recordings: Sequence[Path], seed: int, force: bool
) -> "tuple[Imitation, Imported]":
    """The weights that a skill learns from recordings, and what became of them in its lesson."""
    from mindrun.train import NotFoundError

    from mindlang.cli._session import RunSession, ensure_compiled
    from mindlang.run.drives import read_drives
    from mindlang.training.subject import open_subject
    from mindlang.weights.imitation import imitation, lesson_of
    from mindlang.weights.importing import other_weights, trial_of, try_weights
    from mindlang.weights.least_squares import step_count
    from mindlang.weights.network import network_of

    session = RunSession()
    with (
        terminal.refusing(end="."),
        terminal.refusing(terminal.MISUSE, ".", of=NotFoundError),
        terminal.procedures_talk(),
    ):
        subject = open_subject(Path(file), terminal.load_compiled(file))
        network, drives = network_of(subject.graph, skill), read_drives(recordings, subject.graph)
        lesson = lesson_of(subject.graph, skill, drives)
        others = other_weights(subject, skill, lesson)
        with session.counting(f"{skill} imitates", step_count()) as told:
            made = imitation(subject.graph, network, drives, seed, told)
        lineage, digest = made.lineage
        trial = trial_of(subject, network, made.genome, lesson, others, Path(lineage), digest)
        ensure_compiled(trial.rollout, session.say)
        return made, try_weights(trial, force)


def _report(made: "Imitation", found: "Imported") -> "RenderableType":
    from mindrun.terminal.command_line import command_line
    from mindrun.terminal.tick_count import ticks
    from rich.console import Group

    from mindlang.run.drives import in_words
    from mindlang.run.summary import aligned
    from mindlang.training.lock_update import COMPARED_LAYOUTS
    from mindlang.weights.imitation import held_out_words

    trial = found.trial
    skill, lesson, subject = trial.network.skill.name, trial.lesson, trial.subject
    rows = [
        (each.to, f"{each.error:.4f}", f"{each.of_mean:.4f}", "" if each.explained is None else f"{each.explained:.0%}")
        for each in made.outputs
    ]
    lock, again = subject.keep_path(lesson).name, command_line("mindc", "train", subject.shown, skill)
    if found.is_unchanged:
        kept = f"{lock} has these weights already, and stays as it is"
    elif not found.is_kept:
        kept = f"{found.scores}, and stay in {lock}; --force takes the new ones all the same"
    elif not lesson.number:
        kept = f"weights in {lock}; a curriculum that teaches {skill} goes on from them"
    elif lesson.from_scratch:
        kept = f"weights in {lock}; its lesson says `from scratch`: without that {again} goes on from them"
    else:
        kept = f"weights in {lock}; {again} goes on from them"
    return Group(
        f"{skill}: {len(made.genome):,} weights fitted to {ticks(made.ticks)} of {in_words(made.drives)}",
        f"held out: {ticks(made.held_out_ticks)}, {held_out_words(made)}",
        "",
        aligned(rows, (0,), ("", "error", "of the mean", "explained")),
        "",
        f"{skill} scores {short_score(found.score)} on {COMPARED_LAYOUTS} fresh layouts of {lesson.task}",
        kept,
        *found.notes,
    )
