"""`mindc weights`: weights of a skill from other programs, and for them.

Examples:
  mindc weights export collect.mind GoToObject goto.safetensors
  mindc weights import collect.mind GoToObject goto.safetensors
"""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mindlang.cli import Suggesting
from mindlang.cli import _terminal as terminal
from mindlang.cli._options import PATH, SKILLS, flag, json_flag, quiet_flag
from mindlang.number_format import short_score

if TYPE_CHECKING:
    from mindlang.training.subject import Subject
    from mindlang.weights.importing import Imported


@click.group(cls=Suggesting)
def command() -> None:
    """Exchange the weights of a skill with other programs.

    As matrices in a file of safetensors. In PyTorch, mindlang.torch.Skill is the function that they are for.
    """


@command.command("import")
@click.argument("file")
@click.argument("skill", shell_complete=SKILLS)
@click.argument("weights", metavar="WEIGHTS.safetensors", type=PATH)
@click.option(
    "--recording", metavar="DAY.rec[,BUNDLE]", help="Compare on what was read there. Default: in a run of the task."
)
@flag("--force", "Take them even where they do worse than those that are there.")
@json_flag()
@quiet_flag("Print nothing but errors.")
def import_weights(file: str, skill: str, weights: Path, recording: str | None, force: bool) -> None:
    """Take the weights of SKILL from a file into the lock of FILE.

    Says by how much the function in PyTorch (where that is not installed, in float64) and the engine differ at most on
    the same readings, and how the skill scores with them in its lesson. Weights that do worse than those of the lock,
    on common fresh layouts, do not take their place. The lock says from which file they are. Runs the Python code of
    the file's procedures.

    Ends with 1 where the lock stays as it is.

    Examples:
      mindc weights import collect.mind GoToObject goto.safetensors
      mindc weights import collect.mind GoToObject goto.safetensors --recording day.rec,collect.bundle
      mindc weights import collect.mind GoToObject goto.safetensors --force --json
    """
    from mindrun.train import NotFoundError

    from mindlang.cli._session import RunSession, ensure_compiled
    from mindlang.weights import importing

    subject, session = _subject(file), RunSession()
    with (
        terminal.refusing(end="."),
        terminal.refusing(terminal.MISUSE, ".", of=NotFoundError),
        terminal.procedures_talk(),
    ):
        trial = importing.open_trial(subject, skill, weights)
        ensure_compiled(trial.rollout, session.say)
        found = importing.import_weights(trial, recording, force)
    session.say(*_lines(found, subject.keep_path(trial.lesson).name, recording))
    if terminal.is_asked("as_json"):
        terminal.print_json(found.data())
    sys.exit(terminal.OK if found.is_kept else terminal.FINDINGS)


def _lines(found: "Imported", lock: str, recording: str | None) -> Iterator[str]:
    from mindrun.terminal.tick_count import ticks as in_words

    from mindlang.training.lock_update import COMPARED_LAYOUTS

    trial, compared = found.trial, found.deviation
    assert compared
    skill, lesson = trial.network.skill.name, trial.lesson
    where = recording or f"a run of {lesson.task}"
    yield (
        f"{trial.path}: {len(trial.genome):,} weights of {skill}; "
        f"{compared.reference} and the engine differ by at most {compared.difference:.3g} "
        f"in {in_words(compared.ticks)} of {where}"
    )
    if compared.faults:
        yield f"{compared.faults:,} outputs were not finite, and are not sent"
    if compared.reference == "float64":
        yield "PyTorch is not installed: pip install 'mindlang[torch]' compares with the function there"
    yield f"{skill} scores {short_score(found.score)} on {COMPARED_LAYOUTS} fresh layouts of {lesson.task}"
    if found.is_unchanged:
        yield f"{lock} has these weights already, and stays as it is"
    elif not found.is_kept:
        yield f"{found.scores}, and stay in {lock}; --force takes the new ones all the same"
    else:
        worse = f"; but {found.scores}" if found.scores and found.scores.is_worse else ""
        yield f"weights in {lock}{worse}"
    yield from found.notes


@command.command("export")
@click.argument("file")
@click.argument("skill", shell_complete=SKILLS)
@click.argument("weights", metavar="WEIGHTS.safetensors", type=PATH)
def export_weights(file: str, skill: str, weights: Path) -> None:
    """Write the weights that SKILL of FILE was taught to a file.

    With what they read and send, in their order. Brought back by import they are the same to the bit.

    Examples:
      mindc weights export collect.mind GoToObject goto.safetensors
    """

    from mindlang.weights.network import to_bytes, trained_network

    terminal.refuse_unwritable(weights, ".safetensors")
    with terminal.refusing(end="."):
        network, genome = trained_network(_subject(file), skill)
    terminal.write_file(weights, to_bytes(network, genome))
    terminal.tell(f"{weights}: {len(genome):,} weights of {skill}")


def _subject(file: str) -> "Subject":
    """The mind of a file with its lock; a damaged lock ends the program."""
    from mindlang.training.subject import open_subject

    terminal.refuse_standard_input(file, "Weights are kept beside a file, and standard input is none.")
    with terminal.refusing(end="."):
        return open_subject(Path(file), terminal.load_compiled(file))
