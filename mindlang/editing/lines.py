"""The lines of a source, and splices that put whole ones in or take them out."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from mindlang.compiler.source import Source, Span
from mindlang.compiler.splice import Splice


@dataclass(frozen=True, slots=True)
class SourceLine:
    """A line of a source, from offset `start` up to `end`, without its line end."""

    source: Source
    start: int
    end: int

    @property
    def text(self) -> str:
        """What stands on it, comment and indentation included."""
        return self.source.text[self.start : self.end]

    @property
    def indent(self) -> str:
        """The blanks with which it begins."""
        return self.text[: len(self.text) - len(self.text.lstrip())]

    @property
    def is_blank(self) -> bool:
        """Whether nothing stands on it."""
        return not self.text.strip()

    @property
    def is_comment(self) -> bool:
        """Whether only a comment stands on it."""
        return self.text.lstrip().startswith("#")

    def above(self) -> Iterator["SourceLine"]:
        """The lines above, from this one up."""
        line = self
        while line.start:
            line = _line_at(self.source, line.start - 1)
            yield line

    def below(self) -> Iterator["SourceLine"]:
        """The lines below, from this one down."""
        line = self
        while (start := self.source.text.find("\n", line.end) + 1) and start < len(self.source.text):
            line = _line_at(self.source, start)
            yield line


def first_line(span: Span) -> SourceLine:
    """The line in which a span begins."""
    return _line_at(span.source, span.start)


def newline(source: Source) -> str:
    """How lines end in a source."""
    return "\r\n" if "\r\n" in source.text else "\n"


def insert_below(line: SourceLine, texts: Iterable[str]) -> Splice:
    """Lines below a line; where that is the last one and has no line end, the new last one has none."""
    return Splice(line.source, line.end, line.end, newline(line.source).join(["", *texts]))


def insert_above(line: SourceLine, text: str) -> Splice:
    """A line above a line."""
    return Splice(line.source, line.start, line.start, text + newline(line.source))


def replace_line(line: SourceLine, texts: Iterable[str]) -> Splice:
    """Other lines in the place of one."""
    return Splice(line.source, line.start, line.end, newline(line.source).join(texts))


def remove_lines(first: SourceLine, last: SourceLine) -> Splice:
    """Lines taken out with the line end before them; the first of a source with what is blank below them."""
    if above := next(first.above(), None):
        return Splice(first.source, above.end, last.end, "")
    below = next((line for line in last.below() if not line.is_blank), None)
    return Splice(first.source, 0, below.start if below else len(first.source.text), "")


def _line_at(source: Source, offset: int) -> SourceLine:
    text = source.text
    start, end = text.rfind("\n", 0, offset) + 1, text.find("\n", offset)
    end = len(text) if end < 0 else end
    return SourceLine(source, start, end - text[start:end].endswith("\r"))
