"""`mindc status`: which skills are trained, and with what their weights were made."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mindlang.cli._declared_names import SKILLS

if TYPE_CHECKING:
    from mindrun.graph.graph import Graph
    from rich.console import Console
    from rich.text import Text

    from mindlang.lock.report import Row

COLOURS = {
    "trained": "green",
    "taught elsewhere": "magenta",
    "damaged": "red",
    "stale": "red",
    "untaught": "yellow",
    "does not learn": "dim",
}

EXAMPLES = """\b
Examples:
  mindc status collect.mind
  mindc status collect.mind --json
  mindc status collect.mind Avoid Collect
  mindc status collect.mind --accept Avoid Collect
"""


@click.command(epilog=EXAMPLES)
@click.argument("file")
@click.argument("skills", nargs=-1, metavar="[SKILL]...", shell_complete=SKILLS)
@click.option("--accept", is_flag=True, help="Their weights will do in the mind as it is now: --accept Avoid Collect")
@click.option("--json", "as_json", is_flag=True, help="One JSON document instead: mindc status collect.mind --json")
def command(file: str, skills: tuple[str, ...], accept: bool, as_json: bool) -> None:
    """Show how every skill of FILE stands to its weights.

    Or each SKILL alone; and how these were made. A skill is trained, stale and why, untaught, or taught elsewhere: with
    another body, sensor, task or subskill than the mind has now. Such a skill acts, and `mindc train` teaches it again,
    unless it is accepted.

    Ends with 0 when every skill that is shown, of those below the master, can act, else with 1.
    """
    from mindlang.cli._terminal import FINDINGS, OK, console, load_compiled, print_json
    from mindlang.lock import lock_sources
    from mindlang.lock.report import as_data, rows

    compiled = load_compiled(file)
    assert compiled.graph is not None
    sources = lock_sources(compiled.sources)
    _refuse_unknown(compiled.graph, skills)
    if accept:
        _accept(compiled.graph, sources, skills)
    found = [row for row in rows(compiled.graph, sources) if not skills or row.skill in skills]
    if as_json:
        print_json({"skills": [as_data(row) for row in found]})
    else:
        console().print(report(found, console()), end="")
    sys.exit(OK if all(row.is_fine for row in found if row.is_needed) else FINDINGS)


def report(found: Sequence[Row], console: Console) -> Text:
    """The rows as lines that a console has room for."""
    from rich.text import Text

    from mindlang.cli._text_columns import columns
    from mindlang.lock.report import made

    lines = []
    for row in found:
        word = f"{row.word}, frozen" if row.is_frozen else row.word
        about = Text("\n".join(filter(None, (made(row), *row.remarks))))
        lines.append(((Text(row.skill), Text(word, COLOURS[row.word])), about))
    return columns(console, lines)


def _refuse_unknown(graph: Graph, skills: Sequence[str]) -> None:
    from mindlang.cli._terminal import MISUSE, fail
    from mindlang.compiler.diagnostic import did_you_mean

    known = [skill.name for skill in graph.skills]
    for skill in skills:
        if skill not in known:
            fail(f"There is no skill {skill}.", did_you_mean(skill, known), MISUSE)


def _accept(graph: Graph, sources: Sequence[Path], skills: Sequence[str]) -> None:
    from mindlang.cli._terminal import MISUSE, fail
    from mindlang.lock import LockError
    from mindlang.lock.report import accept

    if not skills:
        fail("--accept needs the skills whose weights will do.", "Name them: --accept Avoid Collect", MISUSE)
    try:
        accept(graph, sources, skills)
    except LockError as error:
        fail(f"{error}.", error.hint)
