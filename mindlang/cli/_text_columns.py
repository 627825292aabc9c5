"""Short texts side by side and a long one behind them, for terminals of any width."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

LEAST_BODY_COLUMNS = 24  # for the long text; with less it stands below the short ones


def columns(console: Console, rows: Sequence[tuple[Sequence[Text], Text]]) -> Text:
    """A line or more for each row: its short texts whole, then the long one, whose lines go on below one another."""
    from rich.cells import cell_len
    from rich.text import Text

    widths = [
        max(cell_len(text.plain) for text in column) for column in zip(*(short for short, _ in rows), strict=True)
    ]
    indent = sum(widths) + 2 * len(widths)
    is_beside = console.width - indent >= LEAST_BODY_COLUMNS
    indent = indent if is_beside else 2
    found = Text()
    for short, body in rows:
        line = Text()
        for text, width in zip(short, widths, strict=True):
            line.append_text(text).append(" " * (width - cell_len(text.plain) + 2))
        lines = [
            each for part in body.split("\n") if part for each in part.wrap(console, max(1, console.width - indent))
        ]
        lines = [Text(" " * indent).append_text(each) for each in lines]
        if is_beside and lines:
            lines[0] = line.append_text(lines[0][indent:])
        else:
            lines.insert(0, line)
        for each in lines:
            each.rstrip()
            found.append_text(each).append("\n")
    return found
