"""`mindc migrate`: files of an older mindc say in the words of this one what they meant.

Examples:
  mindc migrate collect.mind            the diff
  mindc migrate *.mind --write          make it
"""

import sys

import click

from mindlang.cli._options import flag
from mindlang.cli._terminal import OK, print_diff, print_document, rewrite_source
from mindlang.cli.fmt import revised


@click.command
@click.argument("files", nargs=-1, required=True, metavar="FILE…")
@flag("--write", "Change the files: mindc migrate collect.mind --write")
def command(files: tuple[str, ...], write: bool) -> None:
    """Bring files of an older mindc along, and print the diff.

    A thing used to move elsewhere when it was reached or delivered if any line of its task rewarded, counted or ended
    on that. Now it says so itself: `reached moves`, `delivered stays`. Only for files that were written before; what
    things say already stays. `-` is standard input; with --write it goes to standard output.
    """
    sys.exit(max([_migrate(file, write) for file in files]))


def _migrate(file: str, write: bool) -> int:
    """Migrate one file; the exit code if it were the only one."""
    from mindlang.compiler.migration import migrated_text
    from mindlang.editing.unified_diff import unified

    found = revised(file, migrated_text)
    if isinstance(found, int):
        return found
    old, text = found
    if write and file == "-":
        print_document(text)
    else:
        print_diff(unified(file.lstrip("/"), old, text))
    if text == old:
        click.echo(f"{file} needs nothing", err=True)
    elif write and file != "-":
        rewrite_source(file, old, text)
        click.echo(f"{file} is written", err=True)
    return OK
