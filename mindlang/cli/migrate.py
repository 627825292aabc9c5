"""`mindc migrate`: files of an older mindc say in the words of this one what they meant."""

import sys

import click

from mindlang.cli._diagnostic_printer import print_report
from mindlang.cli._terminal import FINDINGS, MISUSE, OK, console, print_diff, print_document, rewrite_source
from mindlang.compiler.diagnostic import Diagnostic, Findings

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
    """Migrate one file; the exit code if it were the only one."""
    from mindlang.compiler.compile import read_main
    from mindlang.compiler.migration import migrated_text
    from mindlang.editing.unified_diff import unified

    source, findings = read_main(file), Findings()
    if isinstance(source, Diagnostic):
        print_report([source], console(stderr=True))
        return MISUSE
    text = migrated_text(source, findings)
    if findings.diagnostics:
        print_report(findings.diagnostics, console(stderr=True))
        return FINDINGS
    if write and file == "-":
        print_document(text)
    else:
        print_diff(unified(file.lstrip("/"), source.text, text))
    if text == source.text:
        click.echo(f"{file} needs nothing", err=True)
    elif write and file != "-":
        rewrite_source(file, source.text, text)
        click.echo(f"{file} is written", err=True)
    return OK
