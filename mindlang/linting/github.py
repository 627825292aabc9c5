"""Diagnostics as GitHub's workflow commands, which put them beside the lines of a pull request."""

from collections.abc import Iterable, Iterator

from mindrun.printable import visible

from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.source import Span


def annotations(found: Iterable[Diagnostic]) -> Iterator[str]:
    """A line for each."""
    for each in found:
        place = f"{_place(each.span)}," if each.span else ""
        text = _data(f"{each.message} {each.hint}".strip())
        yield f"::{each.severity} {place}title={_property(each.code)}::{text}\n"


def _place(span: Span) -> str:
    end = Span(span.source, span.end, span.end)
    return (
        f"file={_property(span.source.name)},line={span.line},col={span.column},"
        f"endLine={end.line},endColumn={end.column}"
    )


def _data(text: str) -> str:
    return visible(text).replace("%", "%25")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
