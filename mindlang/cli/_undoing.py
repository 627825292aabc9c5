"""`mindc edit undo`: the last edit that was written, taken back."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from mindlang.editing.transaction import Files

EXAMPLES = """\b
Examples:
  mindc edit undo
  mindc edit undo examples/collect
  mindc edit undo examples/collect/collect.mind
"""


@click.command(epilog=EXAMPLES)
@click.argument("place", default=".", metavar="[FILE_OR_FOLDER]")
@click.option("--json", "as_json", is_flag=True, help="One JSON document instead: mindc edit undo --json")
def command(place: str, as_json: bool) -> None:
    """Take back the edit that was last written in a folder.

    Sources, locks and weights become what they were before it, together or not at all. Without FILE_OR_FOLDER it is the
    working directory. Where one of the files has been changed since, nothing is. Edits before the last are not kept.
    """
    from mindlang.cli._diff_printer import print_diff
    from mindlang.cli._terminal import FINDINGS, MISUSE, fail, print_json, talk
    from mindlang.compiler.diagnostic import listed
    from mindlang.editing.transaction import TransactionError, noted_in, undo

    here = Path(place).absolute()
    if not here.exists():
        fail(f"{place} is not there.", "Name a file or a folder in which an edit was written.", MISUSE)
    folder = noted_in(here)
    if folder is None:
        fail(
            f"In {place} no edit has been written that could be taken back.",
            "Name the file that was edited: mindc edit undo FILE",
            FINDINGS,
        )
    try:
        were, are = undo(folder)
    except TransactionError as error:
        fail(f"{error}.", error.hint, FINDINGS)
    names = [path.relative_to(folder).as_posix() for end in (".mind", ".lock") for path in are if path.suffix == end]
    if as_json:
        print_json({"diff": _diff(folder, were, are), "folder": str(folder), "written": names})
        return
    print_diff(_diff(folder, were, are))
    talk.print(f"taken back: {listed(names, 'and')}", markup=False)


def _diff(folder: Path, were: Files, are: Files) -> str:
    from mindlang.compiler.source import decode
    from mindlang.editing.unified_diff import unified

    sources = [path for path in are if path.suffix == ".mind"]
    names = {path: path.relative_to(folder).as_posix() for path in sources}
    return "".join(unified(names[path], decode(were[path] or b""), decode(are[path] or b"")) for path in sources)
