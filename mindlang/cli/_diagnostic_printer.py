"""Diagnostics for people and for programs: an excerpt with a caret on a terminal, plain data for JSON."""

from collections.abc import Iterator
from typing import Any

from mindrun.files.printable import visible

from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.source import Span

EXCERPT_COLUMNS = 100

Segment = tuple[str, str]  # text and style


def plain(diagnostic: Diagnostic) -> str:
    """A diagnostic as text without colours."""
    return "".join(text for text, _ in segments(diagnostic))


def as_data(diagnostic: Diagnostic) -> dict[str, Any]:
    """A diagnostic as plain data; columns are counted in characters from 1."""
    return {
        "code": diagnostic.code,
        "severity": diagnostic.severity,
        "message": diagnostic.message,
        "hint": diagnostic.hint,
        **(_place(diagnostic.span) if diagnostic.span else {}),
        "labels": [{"message": label.message, **_place(label.span)} for label in diagnostic.labels],
    }


def _place(span: Span) -> dict[str, Any]:
    end = Span(span.source, span.end, span.end)
    return {
        "file": span.source.name,
        "line": span.line,
        "column": span.column,
        "end_line": end.line,
        "end_column": end.column,
    }


def segments(diagnostic: Diagnostic) -> Iterator[Segment]:
    if diagnostic.span:
        yield f"{_where(diagnostic.span)}: ", "bold"
    yield f"{diagnostic.severity}: ", "red" if diagnostic.severity == "error" else "yellow"
    yield f"{visible(diagnostic.message)} [{diagnostic.code}]\n", ""
    if diagnostic.span:
        yield from _excerpt(diagnostic.span, "^", "red")
    for label in diagnostic.labels:
        yield f"  {_where(label.span)}: {visible(label.message)}\n", "dim"
        yield from _excerpt(label.span, "-", "blue")
    if diagnostic.hint:
        yield f"  {visible(diagnostic.hint)}\n", "cyan"


def _where(span: Span) -> str:
    return f"{visible(span.source.name)}:{span.line}:{span.column}"


def _excerpt(span: Span, mark: str, style: str) -> Iterator[Segment]:
    """The line of a span, as much of it as fits, and marks below the span."""
    from rich.cells import cell_len

    line = span.source.line(span.line)
    column = span.column - 1
    first = max(0, column - EXCERPT_COLUMNS // 2) if len(line) > EXCERPT_COLUMNS else 0
    shown = line[first : first + EXCERPT_COLUMNS]
    indent = visible(line[first:column])
    marked = visible(shown[column - first : column - first + span.end - span.start])
    number = str(span.line)
    yield f"  {number} | ", "dim"
    yield f"{'…' if first else ''}{visible(shown)}{'…' if first + EXCERPT_COLUMNS < len(line) else ''}\n", ""
    yield f"  {' ' * len(number)} | {' ' * (cell_len(indent) + bool(first))}", "dim"
    yield f"{mark * max(1, cell_len(marked))}\n", style
