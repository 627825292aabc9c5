"""The output of every command: data and results on stdout, talk on stderr; and the exit codes with which it ends."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

import click
from mindrun.errors import MindError
from mindrun.files.printable import visible
from mindrun.terminal import standard_streams

if TYPE_CHECKING:
    from mindrun.files.atomic_write import Data
    from mindrun.graph.graph import Graph
    from rich.console import Console, RenderableType
    from rich.text import Text

    from mindlang.compiler.compile import Compiled
    from mindlang.compiler.diagnostic import Diagnostic

OK, FINDINGS, MISUSE, INTERRUPTED = 0, 1, 2, 130  # how a program ends
PIPE_COLUMNS = 1000
LEAST_BODY_COLUMNS = 24  # for a long text beside short ones; with less it stands below them
DIFF_STYLES = {"---": "bold", "+++": "bold", "@": "cyan", "-": "red", "+": "green"}  # by how a line begins


@cache
def console(stderr: bool = False) -> Console:
    """A console that colours only a terminal, and honours NO_COLOR and CI; rich is slow to import."""
    from rich.console import Console

    plain = bool(os.environ.get("CI")) or not (sys.stderr if stderr else sys.stdout).isatty()
    width = PIPE_COLUMNS if plain else None  # a file or a pipe has no edge to cut lines at
    return Console(stderr=stderr, force_terminal=False if plain else None, highlight=False, soft_wrap=True, width=width)


def is_asked(flag: str) -> bool:
    """True if the command that runs in this thread was given --json (`as_json`) or --quiet (`quiet`)."""
    context = click.get_current_context(silent=True)
    return context is not None and bool(context.meta.get(flag))


def tell(*lines: str) -> None:
    """Print lines on stderr."""
    for line in lines:
        console(stderr=True).print(line, markup=False, emoji=False)


def complain(message: str, hint: str = "") -> None:
    """Print what is wrong and what to do about it on stderr."""
    from rich.text import Text

    console(stderr=True).print(Text(visible(message), "red"))
    if hint:
        console(stderr=True).print(Text(f"  {visible(hint)}"))


def print_report(diagnostics: Sequence[Diagnostic], on: Console | None = None) -> None:
    """Print diagnostics, on stderr unless on another console; after the first hundred only their number."""
    if not diagnostics:
        return
    from rich.text import Text

    from mindlang.cli._diagnostic_printer import segments
    from mindlang.compiler.diagnostic import MAX_DIAGNOSTICS

    on = on or console(stderr=True)
    for diagnostic in diagnostics[:MAX_DIAGNOSTICS]:
        on.print(Text.assemble(*segments(diagnostic)))
    if len(diagnostics) > MAX_DIAGNOSTICS:
        on.print(f"… and {len(diagnostics) - MAX_DIAGNOSTICS} more.")


def fail(message: str, hint: str = "", code: int = FINDINGS) -> NoReturn:
    """Print what is wrong, in one line or several, and what to do about it on stderr, and end with `code`."""
    *first, last = message.split("\n")
    for line in first:
        complain(line)
    complain(last, hint)
    sys.exit(code)


@contextmanager
def refusing(
    code: int = FINDINGS, end: str = "", of: type[MindError] | tuple[type[MindError], ...] = MindError
) -> Iterator[None]:
    """End the program with the message of an error of these classes, and `end` behind it."""
    try:
        yield
    except of as error:
        fail(f"{error}{end}", error.hint, code)


@contextmanager
def refusing_lessons(end: str = "") -> Iterator[None]:
    """End the program with the message of an error about what is taught, and `end` behind it; with 2 for a name."""
    from mindrun.train import NotFoundError

    with refusing(end=end), refusing(MISUSE, end, of=NotFoundError):
        yield


def print_result(data: object, text: Callable[[], RenderableType], end: str = "\n") -> None:
    """Print the result of a command on stdout: its data as one JSON document where that is asked for, or its text."""
    if is_asked("as_json"):
        print_json(data)
    else:
        console().print(text(), end=end)


def print_table(table: RenderableType) -> None:
    """Print a table on stdout; in a file or a pipe no line of it ends in blanks."""
    out = console()
    with out.capture() as captured:
        out.print(table)
    text = captured.get()
    print_document(text if out.is_terminal else "".join(f"{line.rstrip()}\n" for line in text.splitlines()))


def print_json(value: object) -> None:
    print_document(json.dumps(value, indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def print_diff(diff: str) -> None:
    """Print a unified diff on stdout: with colours on a terminal, else as `patch` takes it."""
    out = console()
    if not out.is_terminal:
        print_document(diff)
        return
    from rich.text import Text

    for line in diff.splitlines():
        style = next((style for start, style in DIFF_STYLES.items() if line.startswith(start)), "")
        out.print(Text(visible(line), style))


def print_document(text: str) -> None:
    """Print what programs read on stdout: in UTF-8 on any terminal."""
    standard_streams.document(text)


def text_columns(console: Console, rows: Sequence[tuple[Sequence[Text], Text]]) -> Text:
    """A line or more for each row: its short texts whole, then the long one, whose lines go on below one another."""
    from rich.text import Text

    widths = [max(text.cell_len for text in column) for column in zip(*(short for short, _ in rows), strict=True)]
    indent = sum(widths) + 2 * len(widths)
    is_beside = console.width - indent >= LEAST_BODY_COLUMNS
    indent = indent if is_beside else 2
    found = Text()
    for short, body in rows:
        line = Text()
        for text, width in zip(short, widths, strict=True):
            line.append_text(text).append(" " * (width - text.cell_len + 2))
        wrapped = [each for each in body.wrap(console, max(1, console.width - indent)) if each]
        beside = [line.append_text(wrapped.pop(0)) if is_beside and wrapped else line]
        for each in [*beside, *(Text(" " * indent).append_text(rest) for rest in wrapped)]:
            each.rstrip()
            found.append_text(each).append("\n")
    return found


@contextmanager
def procedures_talk() -> Iterator[None]:
    """Around whatever runs procedures or environments, or above it as a decorator: what they print goes to stderr."""
    with standard_streams.output_to_standard_error():
        yield


def refuse_unwritable(path: Path | None, *suffixes: str) -> None:
    """End the program where no file could be written to `path`, before any work is done."""
    from mindrun.files.atomic_write import refuse

    if path is None:
        return
    if path.suffix.lower() not in suffixes:
        fail(f"{path} must end in {' or '.join(suffixes)}", code=MISUSE)
    with writing(path):
        refuse(path)


@contextmanager
def writing(path: Path | str, code: int = MISUSE) -> Iterator[None]:
    """End the program with one message where a file cannot be written."""
    try:
        yield
    except OSError as error:
        fail(f"{path} cannot be written: {error.strerror}", code=code)


def write_file(path: Path, data: Data) -> None:
    """Write a file whose contents are done; where that fails the program ends, and the old one is still there."""
    from mindrun.files.atomic_write import write_out

    with writing(path):
        write_out(path, data)


def rewrite_source(file: str, old: str, new: str) -> None:
    """Write a new text into a source file that had the old one, or end the program."""
    from mindrun.files.atomic_write import rewrite

    from mindlang.compiler.source import encode_source

    path = Path(file)
    with writing(file, FINDINGS):
        rewrite(path, encode_source(path, new), encode_source(path, old))


def known_skills(graph: Graph, *names: str) -> None:
    """End the program where one of the names is that of no skill."""
    from mindlang.compiler.diagnostic import did_you_mean

    skills = [skill.name for skill in graph.skills]
    for name in names:
        if name not in skills:
            fail(f"There is no skill {name}.", did_you_mean(name, skills), MISUSE)


def need(package: str, what: str, extra: str) -> None:
    """End the program where a package is not installed that an extra of mindlang brings along."""
    if find_spec(package) is None:
        fail(f"{what} {package}, which is not installed.", f"pip install 'mindlang[{extra}]'", MISUSE)


def refuse_standard_input(file: str, why: str) -> None:
    """End the program where what needs a file beside it is to be standard input."""
    if file == "-":
        fail(why, "Save it as a file.", MISUSE)


def load_compiled(path: Path | str) -> Compiled:
    """The compiled file; one whose text has errors is reported to stderr, and ends the program (2 when unreadable).

    Of procedures that cannot be called nothing is said: who calls one does.
    """
    from mindlang.compiler.compile import load

    compiled = load(path)
    if compiled.graph is None:
        print_report(compiled.diagnostics)
        sys.exit(FINDINGS if compiled.readable else MISUSE)
    return compiled
