"""`mindc completion`: shells complete the words of mindc and mindrun."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

import click

EXAMPLES = """\b
Examples:
  mindc completion --install              for the shell in which you are
  mindc completion zsh --install
  mindc completion bash                   what is installed, to be read
  eval "$(mindc completion bash)"         for this shell alone
"""
SHELLS = ("bash", "zsh", "fish")


@click.command(epilog=EXAMPLES)
@click.argument("shell", type=click.Choice(SHELLS), required=False)
@click.option("--install", is_flag=True, help="Install it for you: mindc completion --install")
def command(shell: str | None, install: bool) -> None:
    """Let a shell complete the words of mindc and mindrun.

    Commands, options, files, and the names in the mind that stands on the line. Prints a script for SHELL, or installs
    it: for fish in its folder of completions; for bash and zsh in your data folder, with a line in ~/.bashrc or
    ~/.zshrc that reads it. Without SHELL it is that of $SHELL.
    """
    from mindlang.cli._terminal import MISUSE, fail, print_document, talk, write_file
    from mindlang.compiler.diagnostic import listed

    chosen = shell or Path(os.environ.get("SHELL", "")).name
    if chosen not in SHELLS:
        fail("$SHELL says no shell that is known.", "Write mindc completion bash, zsh or fish.", MISUSE)
    scripts = _scripts(chosen)
    if not install:
        print_document("\n".join(scripts.values()))
        return
    try:
        for path, text in scripts.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            write_file(path, text.encode())
        readers = [] if chosen == "fish" else [_read_in(Path.home() / f".{chosen}rc", scripts)]
    except OSError as error:
        fail(f"{error.filename} cannot be written: {error.strerror}", code=MISUSE)
    talk.print(f"written: {listed(map(str, [*scripts, *readers]), 'and')}", markup=False)
    talk.print("Every shell that you start from now on completes mindc and mindrun.", markup=False)


def _scripts(shell: str) -> dict[Path, str]:
    """What completes both programs, by the files into which it is installed."""
    from mindrun.cli.shell_completion import script

    mindc, mindrun = script(shell, "mindc"), script(shell, "mindrun")
    if shell == "fish":
        folder = Path(os.environ.get("XDG_CONFIG_HOME") or Path.home() / ".config") / "fish" / "completions"
        return {folder / "mindc.fish": mindc, folder / "mindrun.fish": mindrun}
    folder = Path(os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share") / "mind"
    begin = "(( $+functions[compdef] )) || { autoload -Uz compinit && compinit }\n" if shell == "zsh" else ""
    return {folder / f"completion.{shell}": f"{begin}{mindc}\n{mindrun}"}


def _read_in(settings: Path, scripts: Iterable[Path]) -> Path:
    """A shell's file of settings, which reads these files from now on; each is named in it once."""
    text = settings.read_text(encoding="utf-8", errors="surrogateescape") if settings.exists() else ""
    lines = [f'source "{path}"' for path in scripts if f'source "{path}"' not in text.splitlines()]
    with settings.open("a", encoding="utf-8") as file:
        file.writelines(f"\n{line}\n" for line in lines)
    return settings
