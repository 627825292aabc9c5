"""`mindc migrate`: files of an older mindc say in the words of this one what they meant."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from mindlang.compiler.source import Source

EXAMPLES = """\b
Examples:
  mindc migrate collect.mind            the diff
  mindc migrate *.mind --write          make it
"""


@click.command(epilog=EXAMPLES)
@click.argument("files", nargs=-1, required=True, metavar="FILE…")
@click.option("--write", is_flag=True, help="Change the files: mindc migrate collect.mind --write")
def command(files: tuple[str, ...], write: bool) -> None:
    """Bring files of an older mindc along, and print the diff.

    A thing used to move elsewhere when it was reached or delivered if any line of its task rewarded, counted or ended
    on that. Now it says so itself: `reached moves`, `delivered stays`. Only for files that were written before; what
    things say already stays. `-` is standard input; with --write it goes to standard output.
    """
    sys.exit(max([_migrate(file, write) for file in files]))


def _migrate(file: str, write: bool) -> int:
    """Migrate one file; how the program would end if it were the only one."""
    from mindlang.cli._diagnostic_printer import print_report
    from mindlang.cli._diff_printer import print_diff
    from mindlang.cli._terminal import FINDINGS, MISUSE, OK, console, print_document
    from mindlang.compiler.compile import read_main
    from mindlang.compiler.diagnostic import Findings
    from mindlang.compiler.migration import migrated
    from mindlang.compiler.source import Source
    from mindlang.editing.unified_diff import unified

    source = read_main(file)
    if not isinstance(source, Source):
        print_report([source], console(stderr=True))
        return MISUSE
    findings = Findings()
    text = migrated(source, findings)
    print_report(findings.diagnostics, console(stderr=True))
    if findings.diagnostics:
        return FINDINGS
    is_piped = write and file == "-"
    if is_piped:
        print_document(text)
    else:
        print_diff(unified(file.lstrip("/"), source.text, text))
    if text == source.text:
        click.echo(f"{file} needs nothing", err=True)
    elif write and not is_piped:
        _write(file, source, text)
    return OK


def _write(file: str, source: Source, text: str) -> None:
    from mindrun.files.atomic_write import rewrite

    from mindlang.cli._terminal import fail
    from mindlang.compiler.source import encoded

    try:
        rewrite(Path(file), encoded(Path(file), text), encoded(Path(file), source.text))
    except OSError as error:
        fail(f"{file} cannot be written: {error.strerror}")
    click.echo(f"{file} is written", err=True)
