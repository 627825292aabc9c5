"""`mindc diff`: what changed in meaning between two minds, and which weights survive it.

Examples:
  mindc diff old/collect.mind collect.mind
  git show HEAD:collect.mind | mindc diff - collect.mind
"""

import sys

import click

from mindlang.cli._options import json_flag
from mindlang.cli._terminal import FINDINGS, OK, load_compiled, print_result


@click.command
@click.argument("old")
@click.argument("new")
@json_flag("One JSON document instead: mindc diff a.mind b.mind --json")
def command(old: str, new: str) -> None:
    """Show what changed in meaning from OLD to NEW.

    And which weights fit NEW: those of its lock, or else of OLD's. Comments, spaces, the order of lines and other
    spellings of the same do not count. Standard input uses the files of the working directory. Ends with 0 where
    nothing changed, with 1 where something did.
    """
    from rich.text import Text

    from mindlang.compiler.comparison import mind_differences
    from mindlang.lock import lock_path, lock_sources
    from mindlang.lock.report import as_data, rows, survival

    before, after = load_compiled(old), load_compiled(new)
    mind, graph = after.whole
    found = mind_differences(before.whole[0], mind)
    has_lock = lock_path(after.sources[0].path).exists()
    standing = rows(graph, lock_sources((after if has_lock else before).sources))

    def text() -> Text:
        lines: list[Text] = []
        for each in found:
            lines.append(Text(each.what, "bold"))
            lines += [Text(f"  - {line}", "red") for line in each.gone]
            lines += [Text(f"  + {line}", "green") for line in each.new]
        return Text("").join(line.append("\n") for line in [*lines, *map(Text, survival(standing))])

    data = {
        "differences": [{"what": each.what, "gone": [*each.gone], "new": [*each.new]} for each in found],
        "skills": [as_data(row) for row in standing],
    }
    print_result(data, text, end="")
    sys.exit(FINDINGS if found else OK)
