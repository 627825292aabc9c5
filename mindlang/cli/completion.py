"""`mindc completion`: click's script with which a shell completes the words of mindc, and names of files.

Examples:
  mindc completion bash >> ~/.bashrc
  mindc completion zsh >> ~/.zshrc
  mindc completion fish > ~/.config/fish/completions/mindc.fish
"""

import click
from click import shell_completion as shells

from mindlang.cli._terminal import print_document

SHELLS = {"bash": shells.BashComplete, "zsh": shells.ZshComplete, "fish": shells.FishComplete}


@click.command
@click.argument("shell", type=click.Choice(tuple(SHELLS)))
@click.pass_context
def command(context: click.Context, shell: str) -> None:
    """Print what lets a shell complete the words of mindc.

    Commands, options, files, and the names in the mind that stands on the line.
    """
    script = shells.get_completion_class(shell)
    assert script
    print_document(script(context.find_root().command, {}, "mindc", "_MINDC_COMPLETE").source())


class Files(shells.ShellComplete):
    """Names of files where an argument or an option takes any word."""

    def get_completions(self, args: list[str], incomplete: str) -> list[shells.CompletionItem]:
        """Complete a word as click does, and by names of files where click knows nothing."""
        found = super().get_completions(args, incomplete)
        return found if found or incomplete.startswith("-") else [shells.CompletionItem(incomplete, type="file")]


for _name, _class in SHELLS.items():
    shells.add_completion_class(type(_class.__name__, (Files, _class), {}), _name)
