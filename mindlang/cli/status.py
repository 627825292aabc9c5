"""`mindc status`: which skills are trained, and with what their weights were made.

Examples:
  mindc status collect.mind
  mindc status collect.mind --json
  mindc status collect.mind Avoid Collect
  mindc status collect.mind --accept Avoid Collect
"""

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from mindlang.cli import _terminal as terminal
from mindlang.cli._options import SKILLS, flag, json_flag

if TYPE_CHECKING:
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


@click.command
@click.argument("file")
@click.argument("skills", nargs=-1, metavar="[SKILL]...", shell_complete=SKILLS)
@flag("--accept", "Their weights will do in the mind as it is now: --accept Avoid Collect")
@json_flag("One JSON document instead: mindc status collect.mind --json")
def command(file: str, skills: tuple[str, ...], accept: bool) -> None:
    """Show how every skill of FILE stands to its weights.

    Or each SKILL alone; and how these were made. A skill is trained, stale and why, untaught, or taught elsewhere: with
    another body, sensor, task or subskill than the mind has now. Such a skill acts, and `mindc train` teaches it again,
    unless it is accepted.

    Ends with 0 when every skill that is shown, of those below the master, can act, else with 1.
    """
    from mindlang.lock import lock_sources
    from mindlang.lock.report import accept as accept_weights
    from mindlang.lock.report import as_data, rows

    compiled = terminal.load_compiled(file)
    _, graph = compiled.whole
    sources = lock_sources(compiled.sources)
    terminal.known_skills(graph, *skills)
    if accept and not skills:
        needed = "--accept needs the skills whose weights will do."
        terminal.fail(needed, "Name them: --accept Avoid Collect", terminal.MISUSE)
    if accept:
        with terminal.refusing(end="."):
            accept_weights(graph, sources, skills)
    found = [row for row in rows(graph, sources) if not skills or row.skill in skills]
    data = {"skills": [as_data(row) for row in found]}
    terminal.print_result(data, lambda: report(found, terminal.console()), end="")
    sys.exit(terminal.OK if all(row.is_fine for row in found if row.is_needed) else terminal.FINDINGS)


def report(found: "Sequence[Row]", console: "Console") -> "Text":
    """The rows as lines that a console has room for."""
    from rich.text import Text

    from mindlang.lock.report import weights_text

    lines = []
    for row in found:
        word = f"{row.word}, frozen" if row.is_frozen else row.word
        about = Text("\n".join(filter(None, (weights_text(row), *row.remarks))))
        lines.append(((Text(row.skill), Text(word, COLOURS[row.word])), about))
    return terminal.text_columns(console, lines)
