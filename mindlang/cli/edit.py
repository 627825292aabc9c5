"""`mindc edit`: every edit is a command, built from the signature of its function."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from mindlang.cli import Suggesting

if TYPE_CHECKING:
    from mindlang.edits import Edit, EditOption

EXAMPLES = """\b
Examples:
  mindc edit rename Avoid Dodge --noun skill collect.mind
  mindc edit encapsulate Collect CarefulCollect --with Avoid \\
    --reads proximity collect.mind --write
"""


class Edits(Suggesting):
    """The edits that there are, each imported when it is asked for."""

    noun = "edit"

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Their names."""
        from mindlang.edits import names

        return names()

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The edit of that name as a command."""
        from mindlang.edits import edit

        return _command(edit(cmd_name)) if cmd_name in self.list_commands(ctx) else None


@click.group(cls=Edits, epilog=EXAMPLES)
def command() -> None:
    """Edit a hierarchy in its source.

    Prints the diff; --write makes the edit: sources, locks and weights together. The file stands last or first.
    """


def _command(of: Edit) -> click.Command:
    """A click command with the parameters of an edit, and those that all of them have."""

    def run(file: str, write: bool, anyway: bool, keep_weights: bool, verify: bool, as_json: bool, **said: Any) -> None:
        from mindlang.cli._editing import EditOptions, perform

        said, file = _file_first(of, said, file)
        perform(of, said, file, EditOptions(write, anyway, keep_weights, verify, as_json))

    parameters = [
        *(click.Argument([name], nargs=-1 if many else 1, required=True) for name, many in of.arguments),
        click.Argument(["file"]),
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


def _file_first(of: Edit, said: dict[str, Any], file: str) -> tuple[dict[str, Any], str]:
    """The file stands last or, as in other commands, first: there it is where only the first word is one."""
    words = [word for name, many in of.arguments for word in (said[name] if many else [said[name]])] + [file]
    if _is_file(file) or file == "-" or not _is_file(words[0]):
        return said, file
    first, *words = words
    single = {name: words.pop(0) for name, many in of.arguments if not many}
    return said | single | {name: tuple(words) for name, many in of.arguments if many}, first


def _is_file(word: str) -> bool:
    from pathlib import Path

    return word.endswith(".mind") or Path(word).is_file()


def _option(option: EditOption) -> click.Option:
    flags = [f"--{option.name.strip('_').replace('_', '-')}", option.name]
    if isinstance(option.default, bool):
        return click.Option(flags, is_flag=True, help=option.help)
    return click.Option(flags, multiple=option.many, default=None if option.many else option.default, help=option.help)
