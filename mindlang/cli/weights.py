"""`mindc weights`: weights of a skill from other programs, and for them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from mindlang.cli import Suggesting
from mindlang.cli._declared_names import SKILLS

if TYPE_CHECKING:
    from mindlang.training.subject import Subject

EXAMPLES = """\b
Examples:
  mindc weights export collect.mind GoToObject goto.safetensors
  mindc weights import collect.mind GoToObject goto.safetensors
"""
IMPORT_EXAMPLES = """\b
Examples:
  mindc weights import collect.mind GoToObject goto.safetensors
  mindc weights import collect.mind GoToObject goto.safetensors --recording day.rec,collect.bundle
  mindc weights import collect.mind GoToObject goto.safetensors --force --json
"""
EXPORT_EXAMPLES = """\b
Examples:
  mindc weights export collect.mind GoToObject goto.safetensors
"""


@click.group(cls=Suggesting, epilog=EXAMPLES)
def command() -> None:
    """Exchange the weights of a skill with other programs.

    As matrices in a file of safetensors. In PyTorch, mindlang.torch.Skill is the function that they are for.
    """


@command.command("import", epilog=IMPORT_EXAMPLES)
@click.argument("file")
@click.argument("skill", shell_complete=SKILLS)
@click.argument("weights", metavar="WEIGHTS.safetensors", type=click.Path(path_type=Path))
@click.option(
    "--recording", metavar="DAY.rec[,BUNDLE]", help="Compare on what was read there. Default: in a run of the task."
)
@click.option("--force", is_flag=True, help="Take them even where they do worse than those that are there.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document instead.")
@click.option("-q", "--quiet", is_flag=True, help="Print nothing but errors.")
def import_weights(
    file: str, skill: str, weights: Path, recording: str | None, force: bool, as_json: bool, quiet: bool
) -> None:
    """Take the weights of SKILL from a file into the lock of FILE.

    Says by how much the function in PyTorch (where that is not installed, in float64) and the engine differ at most on
    the same readings, and how the skill scores with them in its lesson. Weights that do worse than those of the lock,
    on common fresh layouts, do not take their place. The lock says from which file they are. Runs the Python code of
    the file's procedures.

    Ends with 1 where the lock stays as it is.
    """
    from mindlang.cli._importing import import_file

    import_file(_subject(file), skill, weights, recording, force, as_json, quiet)


@command.command("export", epilog=EXPORT_EXAMPLES)
@click.argument("file")
@click.argument("skill", shell_complete=SKILLS)
@click.argument("weights", metavar="WEIGHTS.safetensors", type=click.Path(path_type=Path))
def export_weights(file: str, skill: str, weights: Path) -> None:
    """Write the weights that SKILL of FILE was taught to a file.

    With what they read and send, in their order. Brought back by import they are the same to the bit.
    """
    from mindrun.errors import MindError

    from mindlang.cli._terminal import console, fail, refuse_unwritable, write_file
    from mindlang.weights.network import to_bytes, trained_network

    refuse_unwritable(weights, ".safetensors")
    try:
        network, genome = trained_network(_subject(file), skill)
    except MindError as error:
        fail(f"{error}.", error.hint)
    write_file(weights, to_bytes(network, genome))
    talk = console(stderr=True)
    talk.print(f"{weights}: {len(genome):,} weights of {skill}", markup=False)


def _subject(file: str) -> Subject:
    """The mind of a file with its lock, of which this ends the program where it is damaged."""
    from mindrun.errors import MindError

    from mindlang.cli._terminal import MISUSE, fail, load_compiled
    from mindlang.training.subject import open_subject

    if file == "-":
        fail("Weights are kept beside a file, and standard input is none.", "Save it as a file.", MISUSE)
    try:
        return open_subject(Path(file), load_compiled(file))
    except MindError as error:
        fail(f"{error}.", error.hint)
