"""Text with places in it: a source, spans that know their line and column, and splices, which edit it."""

import re
from bisect import bisect_right
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

from mindrun.files.regular_files import read_regular
from mindrun.numbers.short_repr import ShortRepr
from mindrun.terminal.command_line import command_line

MAX_SOURCE_BYTES = 1 << 20
TOO_LARGE = f"is larger than {MAX_SOURCE_BYTES >> 20} MiB"
BOM = b"\xef\xbb\xbf"
CACHED_SOURCES = 64  # whose line starts are remembered


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class Source(ShortRepr):
    """The text of one file. `name` is what the user called it, `folder` where its relative paths begin.

    `alias` is what stands before the names that it declares, for other files.
    """

    name: str
    text: str = field(repr=False)
    folder: Path = Path()
    alias: str = ""

    @property
    def path(self) -> Path:
        """Where the file stands."""
        return self.folder / Path(self.name).name

    def edit(self, edit: str, *arguments: str) -> str:
        """The command of an edit of this file."""
        return command_line("mindc", "edit", edit, Path(self.name), *arguments)

    def line(self, number: int) -> str:
        """The text of a line, counted from 1, without its end."""
        start = _line_starts(self)[number - 1]
        end = self.text.find("\n", start)
        return self.text[start : end if end >= 0 else len(self.text)].rstrip("\r")


@dataclass(frozen=True, slots=True, repr=False)
class Span(ShortRepr):
    """The part of a source from offset `start` up to `end`, in characters."""

    source: Source = field(repr=False)
    start: int
    end: int

    @property
    def text(self) -> str:
        """The characters in it."""
        return self.source.text[self.start : self.end]

    @property
    def line(self) -> int:
        """The line on which it starts, counted from 1."""
        return bisect_right(_line_starts(self.source), self.start)

    @property
    def column(self) -> int:
        """The column at which it starts, counted from 1."""
        return self.start - _line_starts(self.source)[self.line - 1] + 1


@lru_cache(CACHED_SOURCES)
def _line_starts(source: Source) -> list[int]:
    return [0, *(found.end() for found in re.finditer("\n", source.text))]


def comment_of(span: Span) -> str:
    """The comments of a line, those right above it and the one behind, as one paragraph."""
    text = span.source.text
    end = text.find("\n", span.end)
    behind = text[span.end : end if end >= 0 else len(text)].strip()
    said = [behind] if behind.startswith("#") else []
    end = text.rfind("\n", 0, span.start)
    while end >= 0 and (line := text[(first := text.rfind("\n", 0, end) + 1) : end].strip()).startswith("#"):
        said.insert(0, line)
        end = first - 1
    return " ".join(filter(None, (each.lstrip("# ").strip() for each in said)))


def encode_source(path: Path, text: str) -> bytes:
    """The bytes of a text that is to be written to `path`; with a byte order mark if the file begins with one now."""
    try:
        marked = read_regular(path, len(BOM)) == BOM
    except FileNotFoundError:
        marked = False
    return (BOM if marked else b"") + text.encode()


def checked_text(text: str) -> str:
    """The text itself; ValueError, as `decode_source` raises it, where it is too large or its lines do not end."""
    if len(text) > MAX_SOURCE_BYTES or (
        not text.isascii() and len(text.encode("utf-8", "surrogatepass")) > MAX_SOURCE_BYTES
    ):
        raise ValueError(TOO_LARGE)
    return checked_line_ends(text)


def checked_line_ends(text: str) -> str:
    """The text itself; ValueError where its lines end in CR alone, which would make it one line."""
    if "\r" in text.rstrip("\r") and "\n" not in text:
        raise ValueError(r"ends its lines in CR alone, as a classic Mac did: tr '\r' '\n' makes them ends of lines")
    return text


def decode_source(data: bytes) -> str:
    """The text of a source file; ValueError says in the user's words why the bytes are none."""
    if len(data) > MAX_SOURCE_BYTES:
        raise ValueError(TOO_LARGE)
    if b"\0" in data:
        raise ValueError("is a binary file")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise ValueError(f"is not UTF-8 text (line {line})") from error
    return checked_line_ends(text)


@dataclass(frozen=True, slots=True)
class Splice:
    """Replaces the characters of a source from offset `start` up to `end` by `text`."""

    source: Source
    start: int
    end: int
    text: str


def spliced(source: Source, splices: Iterable[Splice]) -> str:
    """The text of a source with its own of the splices made; ValueError where two overlap.

    Those that insert at one place stand in their order.
    """
    own = [splice for splice in splices if splice.source is source]
    parts, end = [], 0
    for splice in sorted(own, key=lambda splice: (splice.start, splice.end)):
        if splice.start < end:
            raise ValueError(f"two splices overlap at offset {splice.start} of {source.name}")
        parts += [source.text[end : splice.start], splice.text]
        end = splice.end
    return "".join([*parts, source.text[end:]])
