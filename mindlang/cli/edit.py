"""`mindc edit`: every edit is a command, built from the signature of its function."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import click

from mindlang.cli import Suggesting
from mindlang.cli._declared_names import SKILLS, declared

if TYPE_CHECKING:
    from mindlang.editing.edits import Edit, EditOption

EXAMPLES = """\b
Examples:
  mindc edit rename collect.mind Avoid Dodge --noun skill
  mindc edit encapsulate collect.mind Collect CarefulCollect \\
    --with Avoid --reads proximity --write
  mindc edit undo collect.mind                 takes that back
"""

UNDO = "undo"
# What a shell completes the parameters of edits with; whatever is not among them is not declared yet.
NAMED = {
    **dict.fromkeys(("skill", "parent", "subskills", "--with"), SKILLS),
    **dict.fromkeys(("target", "what", "old", "names", "--to", "--from"), declared()),
    "--reads": declared("sensor", "memory"),
}


class Edits(Suggesting):
    """The edits that there are, each imported when it is asked for, and what takes the last one back."""

    noun = "edit"

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Their names."""
        from mindlang.editing.edits import names

        return sorted([*names(), UNDO])

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The edit of that name as a command."""
        from mindlang.editing.edits import edit

        if cmd_name == UNDO:
            from mindlang.cli._undoing import command as undo

            return undo
        return _command(edit(cmd_name)) if cmd_name in self.list_commands(ctx) else None


@click.group(cls=Edits, epilog=EXAMPLES)
def command() -> None:
    """Edit a hierarchy in its source.

    Prints the diff; --write makes the edit: sources, locks and weights together. `undo` takes back the last one.
    """


def _command(of: Edit) -> click.Command:
    """A click command with the parameters of an edit, and those that all of them have."""

    def run(file: str, write: bool, anyway: bool, keep_weights: bool, verify: bool, as_json: bool, **said: Any) -> None:
        from mindlang.cli._editing import EditOptions, perform

        file, said = _file_first(of, file, said)
        perform(of, said, file, EditOptions(write, anyway, keep_weights, verify, as_json))

    parameters = [
        click.Argument(["file"]),
        *(
            click.Argument([name], nargs=-1 if many else 1, required=True, shell_complete=NAMED.get(name))
            for name, many in of.arguments
        ),
        *(_option(option) for option in of.options),
        click.Option(["--write"], is_flag=True, help="Make the edit, and not only print it."),
        click.Option(
            ["--anyway"], is_flag=True, help="Make it even where a mind that uses this one no longer compiles.",
        ),
        click.Option(
            ["--keep-weights"], is_flag=True,
            help="Let a skill that reads or influences more go on as it was taught: weights of zero for what is new.",
        ),
        click.Option(
            ["--verify"], is_flag=True,
            help="Run every trained skill before and after on the same readings, and refuse what changes one of them.",
        ),
        click.Option(["--json", "as_json"], is_flag=True, help="One JSON document instead."),
    ]  # fmt: skip
    return click.Command(of.name, params=parameters, callback=run, help=of.text, epilog=f"\b\n{of.example}")


def _file_first(of: Edit, first: str, said: dict[str, Any]) -> tuple[str, dict[str, Any]]:
    """The file stands first; where only the last word is one, it is that, as it was until 0.1."""
    words = [first, *(word for name, many in of.arguments for word in (said[name] if many else [said[name]]))]
    is_first = _is_mind(first) and not _is_mind(words[-1])
    if is_first or not (_is_mind(words[-1]) or _is_file(words[-1])) or (_is_file(first) and not _is_mind(words[-1])):
        return first, said
    *words, last = words
    single = {name: words.pop(0) for name, many in of.arguments if not many}
    return last, said | single | {name: tuple(words) for name, many in of.arguments if many}


def _is_mind(word: str) -> bool:
    return word.endswith(".mind") or word == "-"


def _is_file(word: str) -> bool:
    return os.path.isfile(word)  # noqa: PTH113 (pathlib raises where one may not look)


def _option(option: EditOption) -> click.Option:
    flags = [f"--{option.name.strip('_').replace('_', '-')}", option.name]
    if isinstance(option.default, bool):
        return click.Option(flags, is_flag=True, help=option.help)
    default, names = None if option.many else option.default, NAMED.get(flags[0])
    return click.Option(flags, multiple=option.many, default=default, help=option.help, shell_complete=names)
