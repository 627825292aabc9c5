"""`mindc gc`: remove weights that nobody has any more.

Examples:
  mindc gc                      what could be removed here and below
  mindc gc examples --write     remove it
  mindc gc --json
"""

from pathlib import Path

import click

from mindlang.cli._options import PATH, flag, json_flag
from mindlang.cli._terminal import MISUSE, console, fail, is_asked, print_json, refusing, tell


@click.command
@click.argument("folder", type=PATH, default=".", required=False)
@flag("--write", "Remove them: mindc gc --write")
@json_flag("One JSON document instead: mindc gc --json")
def command(folder: Path, write: bool) -> None:
    """List the weights in FOLDER that no lock names.

    And in the folders below; --write removes them. `mindc train` and `mindc edit` never remove weights, so those that
    were replaced lie here until then. What a lock of another branch or of a copy elsewhere names is not known here.
    """
    from mindlang.lock.blobs import remove, unnamed

    if not folder.is_dir():
        fail(f"{folder} is not a folder.", code=MISUSE)
    with refusing(end="."):
        found = unnamed(folder)
        size = sum(path.stat().st_size for path in found)
        if write:
            remove(found)
    if is_asked("as_json"):
        print_json({"removed": write, "files": [str(path) for path in found], "bytes": size})
        return
    for path in found:
        console().print(str(path), markup=False)
    weights = f"{len(found)} file{'s' * (len(found) > 1)} of weights, {size / 1024:.0f} KiB"
    if not found:
        tell("nothing to remove: a lock names every file of weights")
    else:
        tell(f"removed {weights}" if write else f"{weights}; nothing has been removed: --write removes them")
