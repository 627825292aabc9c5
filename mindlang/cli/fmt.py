"""`mindc fmt`: files as they should be written.

Examples:
  mindc fmt collect.mind
  mindc fmt .
  mindc fmt collect.mind collect.break
  mindc fmt *.mind --check
  mindc fmt collect.mind --diff
  cat collect.mind | mindc fmt - > tidy.mind
"""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mindlang.breakpoints import SUFFIX
from mindlang.cli._options import files_of, flag, in_files
from mindlang.cli._terminal import FINDINGS, MISUSE, OK, print_diff, print_document, print_report, rewrite_source
from mindlang.compiler.diagnostic import Diagnostic, Findings

if TYPE_CHECKING:
    from mindlang.compiler.source import Source


@click.command
@click.argument("files", nargs=-1, required=True, metavar="FILE_OR_FOLDER…")
@flag("--check", "Write nothing; end with 1 where a file is not as it should be.")
@flag("--diff", "Write nothing; print what would change, and end with 1 if anything would.")
def command(files: tuple[str, ...], check: bool, diff: bool) -> None:
    """Write files in the one way of the language.

    Spaces and blank lines are set, nothing else is touched: nothing is reordered or aligned, no comment and no meaning
    changes, and there are no options of taste. A file with lines that cannot be read is reported and left as it is. A
    file of breakpoints is known by its name, NAME.break. `-` is standard input, a mind, and goes to standard output.
    A folder is the files of both sorts in it and below.
    """
    named = files_of(files, ".mind", SUFFIX)
    codes = [_tidy(file, check, diff) for file in named]
    if among := in_files(files, named):
        odd = sum(code != OK for code in codes)
        click.echo(f"{f'{odd} not tidy' if odd else 'all is tidy'}{among}", err=True)
    sys.exit(max(codes))


def _tidy(file: str, check: bool, diff: bool) -> int:
    """Tidy one file, or only look; the exit code if it were the only one."""
    from mindlang.editing.unified_diff import unified

    found = revised(file, _tidied)
    if isinstance(found, int):
        return found
    old, text = found
    is_tidy = text == old
    if diff:
        print_diff(unified(file.lstrip("/"), old, text))
    elif check and not is_tidy:
        click.echo(f"{file} is not tidy", err=True)
    elif not check and file == "-":
        print_document(text)
    elif not check and not is_tidy:
        rewrite_source(file, old, text)
        click.echo(f"{file} is tidy now", err=True)
    return FINDINGS if (diff or check) and not is_tidy else OK


def _tidied(source: "Source", findings: Findings) -> str:
    from mindlang.compiler.format import formatted
    from mindlang.compiler.parse import parse, parse_stops

    if Path(source.name).suffix == SUFFIX:
        parse_stops(source, findings)
        return formatted(source.text, start="stop")
    parse(source, findings)
    return formatted(source.text)


def revised(file: str, revise: "Callable[[Source, Findings], str]") -> tuple[str, str] | int:
    """The text of a file as it is and as it becomes; the exit code where it has mistakes, which are reported."""
    from mindlang.compiler.compile import read_main

    source, findings = read_main(file), Findings()
    if isinstance(source, Diagnostic):
        print_report([source])
        return MISUSE
    text = revise(source, findings)
    print_report(findings.diagnostics)
    return FINDINGS if findings.diagnostics else (source.text, text)
