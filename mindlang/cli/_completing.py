"""Words completed for a shell: commands and options by click, and names of files where it knows of none."""

from __future__ import annotations

import click
from click.shell_completion import (
    BashComplete,
    CompletionItem,
    FishComplete,
    ShellComplete,
    ZshComplete,
    add_completion_class,
)

COMPLETE_VARIABLE = "_MINDC_COMPLETE"  # of the environment, in which a shell says what it wants


class _WithFiles(ShellComplete):
    def get_completions(self, args: list[str], incomplete: str) -> list[CompletionItem]:
        """As click finds them, and files where an argument or an option takes any word."""
        found = super().get_completions(args, incomplete)
        return found if found or incomplete.startswith("-") else [CompletionItem(incomplete, type="file")]


class _Bash(_WithFiles, BashComplete):
    @staticmethod
    def _check_version() -> None:
        """An old bash completes less, and says nothing of it in the middle of a line."""


class _Zsh(_WithFiles, ZshComplete):
    pass


class _Fish(_WithFiles, FishComplete):
    pass


SHELLS: dict[str, type[ShellComplete]] = {"bash": _Bash, "zsh": _Zsh, "fish": _Fish}


def complete_files() -> None:
    """Let click answer with these from now on."""
    for name, shell in SHELLS.items():
        add_completion_class(shell, name)


def script(shell: str, commands: click.Command) -> str:
    """What a shell reads so that it completes mindc."""
    return SHELLS[shell](commands, {}, "mindc", COMPLETE_VARIABLE).source().strip() + "\n"
