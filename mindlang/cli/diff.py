"""`mindc diff`: what changed in meaning between two minds, and which weights survive it."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from mindlang.compiler.comparison import Difference
    from mindlang.lock.report import Row

EXAMPLES = """\b
Examples:
  mindc diff old/collect.mind collect.mind
  git show HEAD:collect.mind | mindc diff - collect.mind
"""


@click.command(epilog=EXAMPLES)
@click.argument("old")
@click.argument("new")
@click.option("--json", "as_json", is_flag=True, help="One JSON document instead: mindc diff a.mind b.mind --json")
def command(old: str, new: str, as_json: bool) -> None:
    """Show what changed in meaning from OLD to NEW.

    And which weights fit NEW: those of its lock, or else of OLD's. Comments, spaces, the order of lines and other
    spellings of the same do not count. Standard input uses the files of the working directory. Ends with 0 where
    nothing changed, with 1 where something did.
    """
    from mindlang.cli._terminal import FINDINGS, OK, load_compiled, print_json
    from mindlang.compiler.comparison import differences
    from mindlang.lock import lock_path, lock_sources
    from mindlang.lock.report import as_data, rows

    before, after = load_compiled(old), load_compiled(new)
    assert before.mind is not None
    assert after.mind is not None
    assert after.graph is not None
    found = differences(before.mind, after.mind)
    has_lock = lock_path(after.sources[0].path).exists()
    paths = lock_sources((after if has_lock else before).sources)
    standing = rows(after.graph, paths)
    if as_json:
        print_json(
            {
                "differences": [{"what": each.what, "gone": [*each.gone], "new": [*each.new]} for each in found],
                "skills": [as_data(row) for row in standing],
            }
        )
    else:
        _print(found, standing)
    sys.exit(FINDINGS if found else OK)


def _print(found: Sequence[Difference], standing: Sequence[Row]) -> None:
    """The differences line by line, then which weights still fit."""
    from rich.text import Text

    from mindlang.cli._terminal import console
    from mindlang.lock.report import survival

    for each in found:
        console().print(Text(each.what, "bold"))
        for line in each.gone:
            console().print(Text(f"  - {line}", "red"))
        for line in each.new:
            console().print(Text(f"  + {line}", "green"))
    for line in survival(standing):
        console().print(Text(line))
