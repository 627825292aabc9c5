"""`mindc gc`: remove weights that nobody has any more."""

import sys
from pathlib import Path

import click

EXAMPLES = """\b
Examples:
  mindc gc                      what could be removed here and below
  mindc gc examples --write     remove it
  mindc gc --json
"""


@click.command(epilog=EXAMPLES)
@click.argument("folder", type=click.Path(path_type=Path), default=".", required=False)
@click.option("--write", is_flag=True, help="Remove them: mindc gc --write")
@click.option("--json", "as_json", is_flag=True, help="One JSON document instead: mindc gc --json")
def command(folder: Path, write: bool, as_json: bool) -> None:
    """List the weights in FOLDER that no lock names.

    And in the folders below; --write removes them. `mindc train` and `mindc edit` never remove weights, so those that
    were replaced lie here until then. What a lock of another branch or of a copy elsewhere names is not known here.
    """
    from mindlang.cli._terminal import MISUSE, OK, console, fail, print_json
    from mindlang.lock import LockError
    from mindlang.lock.blobs import remove, unnamed

    if not folder.is_dir():
        fail(f"{folder} is not a folder.", code=MISUSE)
    try:
        found = unnamed(folder)
        size = sum(path.stat().st_size for path in found)
        if write:
            remove(found)
    except LockError as error:
        fail(f"{error}.", error.hint)
    if as_json:
        print_json({"removed": write, "files": [str(path) for path in found], "bytes": size})
        sys.exit(OK)
    for path in found:
        console().print(str(path), markup=False)
    console(stderr=True).print(_summary(len(found), size, write), markup=False)


def _summary(files: int, size: int, write: bool) -> str:
    if not files:
        return "nothing to remove: a lock names every file of weights"
    weights = f"{files} file{'s' * (files > 1)} of weights, {size / 1024:.0f} KiB"
    return f"removed {weights}" if write else f"{weights}; nothing has been removed: --write removes them"
