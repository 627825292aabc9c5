"""The documentation of a line: the comments right above it, and the one behind it."""

from collections.abc import Iterator

from mindlang.compiler.source import Span


def comment_of(span: Span) -> str:
    """What the comments of a line say, as one paragraph; a blank line sets a comment apart."""
    text = span.source.text
    end = text.find("\n", span.end)
    behind = text[span.end : end if end >= 0 else len(text)].strip()
    said = [*reversed([*_above(text, span.start)]), behind if behind.startswith("#") else ""]
    return " ".join(filter(None, (each.lstrip("# ").strip() for each in said)))


def _above(text: str, start: int) -> Iterator[str]:
    """The comments above the line of an offset, from the lowest up."""
    end = text.rfind("\n", 0, start)
    while end >= 0:
        first = text.rfind("\n", 0, end) + 1
        line = text[first:end].strip()
        if not line.startswith("#"):
            return
        yield line
        end = first - 1
