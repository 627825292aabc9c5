"""Print what lets a shell complete the words of mindrun. `mindc completion --install` installs it with that of mindc.

examples:
  mindrun completion bash >> ~/.bashrc
  mindrun completion zsh >> ~/.zshrc
  mindrun completion fish > ~/.config/fish/completions/mindrun.fish
"""

import argparse

from mindrun.driving_arguments import driving_parser
from mindrun.shell_completion import SHELLS, script
from mindrun.standard_streams import document
from mindrun.tools import tool_parser, tools


def options(parser: argparse.ArgumentParser) -> None:
    """The arguments."""
    parser.add_argument("shell", choices=tuple(SHELLS), metavar="SHELL", help="bash, zsh or fish")


def run(options: argparse.Namespace) -> int:
    """Print it."""
    document(script_of_mindrun(options.shell))
    return 0


def script_of_mindrun(shell: str) -> str:
    """The script for a shell, with all that may be said to mindrun now."""
    return script(shell, {name: tool_parser(name) for name in tools()} | {"": driving_parser()})
