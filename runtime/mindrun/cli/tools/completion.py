"""Print what lets a shell complete the words of mindrun. `mindc completion --install` installs it with that of mindc.

examples:
  mindrun completion bash >> ~/.bashrc
  mindrun completion zsh >> ~/.zshrc
  mindrun completion fish > ~/.config/fish/completions/mindrun.fish
"""

import argparse

from mindrun.cli.shell_completion import SHELLS, script
from mindrun.terminal.standard_streams import document


def options(parser: argparse.ArgumentParser) -> None:
    """The arguments."""
    parser.add_argument("shell", choices=tuple(SHELLS), metavar="SHELL", help="bash, zsh or fish")


def run(options: argparse.Namespace) -> int:
    """Print it."""
    document(script(options.shell, "mindrun"))
    return 0
