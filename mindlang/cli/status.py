"""`mindc status`: which skills are trained, and with what their weights were made."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from mindrun.graph import Graph

EXAMPLES = """\b
Examples:
  mindc status collect.mind
  mindc status collect.mind --json
  mindc status collect.mind --accept Avoid --accept Collect
"""


@click.command(epilog=EXAMPLES)
@click.argument("file")
@click.option(
    "--accept",
    multiple=True,
    metavar="SKILL",
    help="Say that its weights will do in the mind as it is now: --accept Avoid",
)
@click.option("--json", "as_json", is_flag=True, help="One JSON document instead: mindc status collect.mind --json")
def command(file: str, accept: tuple[str, ...], as_json: bool) -> None:
    """Show how every skill of FILE stands to its weights.

    And how these were made. A skill is trained, stale and why, untaught, or taught elsewhere: with another body,
    sensor, task or subskill than the mind has now. Such a skill acts, and `mindc train` teaches it again, unless it is
    accepted.

    Ends with 0 when every skill below the master can act, else with 1.
    """
    from mindlang.lock.report import as_data, report, rows
    from mindlang.terminal import FINDINGS, OK, console, load_compiled, print_json

    compiled = load_compiled(file)
    assert compiled.graph is not None
    sources = [source.path for source in compiled.sources]
    if accept:
        _accept(compiled.graph, sources, accept)
    found = rows(compiled.graph, sources)
    if as_json:
        print_json({"skills": [as_data(row) for row in found]})
    else:
        console().print(report(found))
    sys.exit(OK if all(row.is_fine for row in found if row.is_needed) else FINDINGS)


def _accept(graph: Graph, sources: Sequence[Path], skills: Sequence[str]) -> None:
    from mindlang.diagnostic import did_you_mean
    from mindlang.lock import LockError
    from mindlang.lock.accept import accept
    from mindlang.terminal import MISUSE, fail

    known = [skill.name for skill in graph.skills]
    for skill in skills:
        if skill not in known:
            fail(f"There is no skill {skill}.", did_you_mean(skill, known), MISUSE)
    try:
        accept(graph, sources, skills)
    except LockError as error:
        fail(f"{error}.", error.hint)
