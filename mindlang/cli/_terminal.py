"""What every command needs: a mind loaded or its report printed, data on stdout, talk on stderr."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

if TYPE_CHECKING:
    from mindrun.files.atomic_write import Data
    from rich.console import Console, RenderableType

    from mindlang.compiler.compile import Compiled

OK, FINDINGS, MISUSE, INTERRUPTED = 0, 1, 2, 130  # how a program ends
talk: Console
PIPE_COLUMNS = 1000


def __getattr__(name: str) -> Any:
    """`talk`, the console on stderr, made when first asked for: rich is slow to import."""
    if name != "talk":
        raise AttributeError(name)
    return console(stderr=True)


@cache
def console(stderr: bool = False) -> Console:
    """A console that colours only a terminal, and honours NO_COLOR and CI."""
    from rich.console import Console

    plain = bool(os.environ.get("CI")) or not (sys.stderr if stderr else sys.stdout).isatty()
    width = PIPE_COLUMNS if plain else None  # a file or a pipe has no edge to cut lines at
    return Console(stderr=stderr, force_terminal=False if plain else None, highlight=False, soft_wrap=True, width=width)


def say(message: str, hint: str = "") -> None:
    """Print a message and what to do about it on stderr."""
    from mindrun.files.printable import visible
    from rich.text import Text

    console(stderr=True).print(Text(visible(message), "red"))
    if hint:
        console(stderr=True).print(Text(f"  {visible(hint)}"))


def fail(message: str, hint: str = "", code: int = FINDINGS) -> NoReturn:
    """Print a message and what to do about it on stderr, and end with `code`."""
    say(message, hint)
    sys.exit(code)


def print_table(table: RenderableType) -> None:
    """A table on stdout; in a file or a pipe no line of it ends in blanks."""
    out = console()
    with out.capture() as captured:
        out.print(table)
    text = captured.get()
    print_document(text if out.is_terminal else "".join(f"{line.rstrip()}\n" for line in text.splitlines()))


def print_json(value: object) -> None:
    """One JSON document on stdout."""
    print_document(json.dumps(value, indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def print_document(text: str) -> None:
    """What programs read, on stdout: in UTF-8 on any terminal."""
    from mindrun.terminal.standard_streams import document

    document(text)


@contextmanager
def procedures_talk() -> Iterator[None]:
    """Around whatever runs procedures or environments, or above it as a decorator: what they print is talk, and goes
    to stderr.
    """
    from mindrun.terminal.standard_streams import talk

    with talk():
        yield


def refuse_unwritable(path: Path | None, *suffixes: str) -> None:
    """End the program where no file could be written to `path`, before any work is done."""
    from mindrun.files.atomic_write import refuse

    if path is None:
        return
    if path.suffix.lower() not in suffixes:
        fail(f"{path} must end in {' or '.join(suffixes)}", code=MISUSE)
    try:
        refuse(path)
    except OSError as error:
        fail(f"{path} cannot be written: {error.strerror}", code=MISUSE)


def write_file(path: Path, data: Data) -> None:
    """Write a file whose contents are done; where that fails the program ends, and the old one is still there."""
    from mindrun.files.atomic_write import write_out

    try:
        write_out(path, data)
    except OSError as error:
        fail(f"{path} cannot be written: {error.strerror}", code=MISUSE)


def load_compiled(path: Path | str) -> Compiled:
    """The compiled file; one whose text has errors is reported to stderr, and ends the program (2 when unreadable).

    Of procedures that cannot be called nothing is said: who calls one does.
    """
    from mindlang.cli._diagnostic_printer import print_report
    from mindlang.compiler.compile import load

    compiled = load(path)
    if compiled.graph is None:
        print_report(compiled.diagnostics, console(stderr=True))
        sys.exit(FINDINGS if compiled.readable else MISUSE)
    return compiled
