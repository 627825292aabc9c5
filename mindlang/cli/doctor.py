"""`mindc doctor`: what is installed here, what is missing, and what mends it."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from rich.text import Text

    from mindlang.diagnosis.checks import Finding

EXAMPLES = """\b
Examples:
  mindc doctor
  mindc doctor --json
"""
MARKS = {"ok": ("ok ", "green"), "absent": ("-  ", "dim"), "wrong": ("NOT", "red")}


@click.command(epilog=EXAMPLES)
@click.option("--json", "as_json", is_flag=True, help="One JSON document instead: mindc doctor --json")
def command(as_json: bool) -> None:
    """Say what is installed here, what is missing, what mends it.

    `ok` is as it should be, `-` is absent and only needed for what is said, `NOT` has to be mended. Changes nothing.
    Ends with 0, or with 1 where something has to be mended. For a robot's devices: mindrun doctor
    """
    from dataclasses import asdict

    from mindlang.cli._terminal import FINDINGS, OK, console, print_json
    from mindlang.cli._text_columns import columns
    from mindlang.diagnosis.checks import State, findings

    found = list(findings())
    is_fine = all(each.state is not State.WRONG for each in found)
    if as_json:
        print_json({"ok": is_fine, "checks": [asdict(each) | {"state": each.state.value} for each in found]})
    else:
        console().print(columns(console(), [_row(each) for each in found]), end="")
        wrong = sum(each.state is State.WRONG for each in found)
        click.echo(f"{wrong} to be mended" if wrong else "all that is needed is there", err=True)
    sys.exit(OK if is_fine else FINDINGS)


def _row(of: Finding) -> tuple[tuple[Text, Text], Text]:
    """How it is and what it is about; then what was seen, and below it what mends it."""
    from mindrun.files.printable import visible
    from rich.text import Text

    mark, style = MARKS[of.state.value]
    seen = Text.assemble(visible(of.seen), (f"\n{visible(of.mend)}" * bool(of.mend), "cyan"))
    return (Text(mark, style), Text(of.what)), seen
