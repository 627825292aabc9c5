"""`mindc lock`: what git does with locks."""

from pathlib import Path

import click
from mindrun.errors import reason

from mindlang.cli import Suggesting
from mindlang.cli._options import PATH
from mindlang.cli._terminal import MISUSE, fail, write_file
from mindlang.compiler.diagnostic import listed


@click.group(cls=Suggesting)
def command() -> None:
    """Bring together what two branches have taught."""


@command.command
@click.argument("base", type=PATH)
@click.argument("ours", type=PATH)
@click.argument("theirs", type=PATH)
@click.option("--name", default="", metavar="PATH", help="What the lock is called. Default: as OURS.")
def merge(base: Path, ours: Path, theirs: Path, name: str) -> None:
    """Merge the locks OURS and THEIRS, which both were BASE once, into OURS.

    Each branch may have taught skills of its own: all lines and worlds are kept. Git does it by itself once
    `.gitattributes` says `collect.lock merge=mind` and `git config merge.mind.driver` says the line below.

    Ends with 1 where both have changed the line of a skill: then what each says stands between marks, and one of these
    is to be deleted; where one branch has taken the line out, it says nothing there.

    Examples:
      mindc lock merge %O %A %B --name %P     as git calls it
    """
    from mindlang.lock import LockError, merge, read_lock

    try:
        # git has an empty file where the branches have no lock in common
        merged = merge(*({} if path.stat().st_size == 0 else read_lock(path) for path in (base, ours, theirs)))
    except OSError as error:
        fail(f"{error.filename} cannot be read: {reason(error)}", code=MISUSE)
    except LockError as error:
        fail(f"{name or ours} cannot be merged: {error}", code=MISUSE)
    write_file(ours, merged.text().encode())
    if merged.conflicts:
        skills = listed(merged.conflicts, "and")
        taken_out = any(None in sides for sides in merged.conflicts.values())
        hint = f"In {name or ours} keep what one of them says between the marks, and delete the other and the marks."
        fail(f"Both branches have {'taught or taken out' if taken_out else 'taught'} {skills}.", hint)
