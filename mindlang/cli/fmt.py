"""`mindc fmt`: files as they should be written."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from mindlang.compiler.diagnostic import Findings
    from mindlang.compiler.source import Source

EXAMPLES = """\b
Examples:
  mindc fmt collect.mind
  mindc fmt .
  mindc fmt collect.mind collect.break
  mindc fmt *.mind --check
  mindc fmt collect.mind --diff
  cat collect.mind | mindc fmt - > tidy.mind
"""


@click.command(epilog=EXAMPLES)
@click.argument("files", nargs=-1, required=True, metavar="FILE_OR_FOLDER…")
@click.option("--check", is_flag=True, help="Write nothing; end with 1 where a file is not as it should be.")
@click.option("--diff", is_flag=True, help="Write nothing; print what would change, and end with 1 if anything would.")
def command(files: tuple[str, ...], check: bool, diff: bool) -> None:
    """Write files in the one way of the language.

    Spaces and blank lines are set, nothing else is touched: nothing is reordered or aligned, no comment and no meaning
    changes, and there are no options of taste. A file with lines that cannot be read is reported and left as it is. A
    file of breakpoints is known by its name, NAME.break. `-` is standard input, a mind, and goes to standard output.
    A folder is the files of both sorts in it and below.
    """
    from mindlang.breakpoints import SUFFIX
    from mindlang.cli._named_files import files_of, in_files
    from mindlang.cli._terminal import OK

    named = files_of(files, ".mind", SUFFIX)
    codes = [_tidy(file, check, diff) for file in named]
    if among := in_files(files, named):
        odd = sum(code != OK for code in codes)
        click.echo(f"{f'{odd} not tidy' if odd else 'all is tidy'}{among}", err=True)
    sys.exit(max(codes))


def _tidy(file: str, check: bool, diff: bool) -> int:
    """Tidy one file, or only look; how the program would end if it were the only one."""
    from mindlang.cli._diagnostic_printer import print_report
    from mindlang.cli._terminal import FINDINGS, MISUSE, console
    from mindlang.compiler.compile import read_main
    from mindlang.compiler.diagnostic import Diagnostic, Findings

    source = read_main(file)
    if isinstance(source, Diagnostic):
        print_report([source], console(stderr=True))
        return MISUSE
    parse, formatted = _language(file)
    findings = Findings()
    parse(source, findings)
    print_report(findings.diagnostics, console(stderr=True))
    return FINDINGS if findings.diagnostics else _put(file, source, formatted(source.text), check, diff)


def _language(file: str) -> tuple[Callable[[Source, Findings], object], Callable[[str], str]]:
    """What reads a file of this name, and what writes its text as it should be."""
    from mindlang.breakpoints import SUFFIX
    from mindlang.compiler.format import formatted
    from mindlang.compiler.parse import parse, parse_stops

    if Path(file).suffix == SUFFIX:
        return parse_stops, partial(formatted, start="stop")
    return parse, formatted


def _put(file: str, source: Source, text: str, check: bool, diff: bool) -> int:
    """The tidy text put where it belongs."""
    from mindrun.files.atomic_write import rewrite

    from mindlang.cli._diff_printer import print_diff
    from mindlang.cli._terminal import FINDINGS, OK, fail, print_document
    from mindlang.compiler.source import encoded
    from mindlang.editing.unified_diff import unified

    is_tidy = text == source.text
    match (diff, check, file):
        case True, _, _:
            print_diff(unified(file.lstrip("/"), source.text, text))
        case _, True, _ if not is_tidy:
            click.echo(f"{file} is not tidy", err=True)
        case False, False, "-":
            print_document(text)
        case False, False, _ if not is_tidy:
            try:
                rewrite(Path(file), encoded(Path(file), text), encoded(Path(file), source.text))
            except OSError as error:
                fail(f"{file} cannot be written: {error.strerror}")
            click.echo(f"{file} is tidy now", err=True)
    return FINDINGS if (diff or check) and not is_tidy else OK
