"""`mindc doctor`: what is installed here, what is missing, and what mends it.

Examples:
  mindc doctor
  mindc doctor --json
"""

import sys
from dataclasses import asdict

import click
from mindrun.files.printable import visible

from mindlang.cli._options import json_flag
from mindlang.cli._terminal import FINDINGS, OK, console, is_asked, print_json, text_columns

MARKS = {"ok": ("ok ", "green"), "absent": ("-  ", "dim"), "wrong": ("NOT", "red")}


@click.command
@json_flag("One JSON document instead: mindc doctor --json")
def command() -> None:
    """Say what is installed here, what is missing, what mends it.

    `ok` is as it should be, `-` is absent and only needed for what is said, `NOT` has to be mended. Changes nothing.
    Ends with 0, or with 1 where something has to be mended. For a robot's devices: mindrun doctor
    """
    from rich.text import Text

    from mindlang.diagnosis import findings

    found = list(findings())
    wrong = sum(each.state == "wrong" for each in found)
    if is_asked("as_json"):
        print_json({"ok": not wrong, "checks": [asdict(each) for each in found]})
    else:
        rows = [
            (
                (Text(*MARKS[each.state]), Text(each.what)),
                Text.assemble(visible(each.seen), (f"\n{visible(each.mend)}" * bool(each.mend), "cyan")),
            )
            for each in found
        ]
        console().print(text_columns(console(), rows), end="")
        click.echo(f"{wrong} to be mended" if wrong else "all that is needed is there", err=True)
    sys.exit(FINDINGS if wrong else OK)
