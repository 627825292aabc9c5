"""`mindc fmt`: files as they should be written."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from mindlang.compiler.source import Source

EXAMPLES = """\b
Examples:
  mindc fmt collect.mind
  mindc fmt *.mind --check
  mindc fmt collect.mind --diff
  cat collect.mind | mindc fmt - > tidy.mind
"""


@click.command(epilog=EXAMPLES)
@click.argument("files", nargs=-1, required=True, metavar="FILE…")
@click.option("--check", is_flag=True, help="Write nothing; end with 1 where a file is not as it should be.")
@click.option("--diff", is_flag=True, help="Write nothing; print what would change, and end with 1 if anything would.")
def command(files: tuple[str, ...], check: bool, diff: bool) -> None:
    """Write files in the one way of the language.

    Spaces and blank lines are set, nothing else is touched: nothing is reordered or aligned, no comment and no meaning
    changes, and there are no options of taste. A file with lines that cannot be read is reported and left as it is. `-`
    is standard input, and goes to standard output.
    """
    sys.exit(max(_tidy(file, check, diff) for file in files))


def _tidy(file: str, check: bool, diff: bool) -> int:
    """Tidy one file, or only look; how the program would end if it were the only one."""
    from mindlang.cli._diagnostic_printer import print_report
    from mindlang.cli._terminal import FINDINGS, MISUSE, console, take_back
    from mindlang.compiler.compile import read_main
    from mindlang.compiler.diagnostic import Findings
    from mindlang.compiler.parse import parse
    from mindlang.compiler.source import Source

    take_back(file)
    source = read_main(file)
    findings = Findings()
    if isinstance(source, Source):
        parse(source, findings)
    else:
        findings.diagnostics.append(source)
    print_report(findings.diagnostics, console(stderr=True))
    if not isinstance(source, Source):
        return MISUSE
    return FINDINGS if findings.diagnostics else _put(file, source, check, diff)


def _put(file: str, source: Source, check: bool, diff: bool) -> int:
    """The tidy text put where it belongs."""
    from mindrun.atomic_write import rewrite

    from mindlang.cli._terminal import FINDINGS, OK, fail, print_document
    from mindlang.compiler.format import formatted
    from mindlang.compiler.source import encoded
    from mindlang.unified_diff import unified

    text = formatted(source.text)
    is_tidy = text == source.text
    match (diff, check, file):
        case True, _, _:
            print_document(unified(file.lstrip("/"), source.text, text))
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
