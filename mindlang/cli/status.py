"""`mindc status`: which skills are trained, and with what their weights were made."""

import sys

import click

EXAMPLES = """\b
Examples:
  mindc status collect.mind
  mindc status collect.mind --json
"""


@click.command(epilog=EXAMPLES)
@click.argument("file")
@click.option("--json", "as_json", is_flag=True, help="One JSON document instead: mindc status collect.mind --json")
def command(file: str, as_json: bool) -> None:
    """Show of every skill of FILE whether it is trained, stale and why, or untaught, and how its weights were made.

    Ends with 0 when every skill that learns is trained, else with 1.
    """
    from mindlang.lock.report import as_data, report, rows
    from mindlang.terminal import FINDINGS, OK, console, load_compiled, print_json

    compiled = load_compiled(file)
    assert compiled.graph is not None
    found = rows(compiled.graph, [source.path for source in compiled.sources])
    if as_json:
        print_json({"skills": [as_data(row) for row in found]})
    else:
        console().print(report(found))
    sys.exit(OK if all(row.is_fine for row in found) else FINDINGS)
