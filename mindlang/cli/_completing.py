"""Words completed for a shell: commands and options by click, and names of files where it knows of none."""

from __future__ import annotations

from collections.abc import Iterator

import click
from click.shell_completion import ShellComplete
from mindrun.cli.shell_completion import BEGINNING, FILES, WORD, Answer, variable

PROGRAM = "mindc"


def answers(commands: click.Command, before: list[str], begun: str) -> Iterator[Answer]:
    """As click finds them, and files where an argument or an option takes any word.

    An item of type `file` may say how a name `ends` and `behind` which part of the word it stands, a plain one that the
    word `goes_on`; any other type says that nothing is known.
    """
    found = ShellComplete(commands, {}, PROGRAM, variable(PROGRAM)).get_completions(before, begun)
    for item in found:
        match item.type:
            case "file" | "dir":
                yield Answer(item.ends or "", item.behind or "", FILES)
            case "plain":
                yield Answer(item.value, item.help or "", BEGINNING if item.goes_on else WORD)
    if not found and not begun.startswith("-"):
        yield Answer("", kind=FILES)
