"""Plain values as the protocol's types: spans as ranges of a URI, splices as edits of a workspace."""

import re
from bisect import bisect_right
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from pathlib import Path
from urllib.parse import quote

from lsprotocol import types
from pygls.uris import from_fs_path, to_fs_path

from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.source import Source, Span
from mindlang.compiler.splice import Splice

SEVERITIES = {"error": types.DiagnosticSeverity.Error, "warning": types.DiagnosticSeverity.Warning}
CACHED_RULERS = 16  # of texts that are remembered
_LINE_END = re.compile(r"\r\n|\n|\r")


@dataclass
class LspConverter:
    """How paths and offsets are said to one editor: its URIs, and the units that its columns count."""

    encoding: str = "utf-16"
    uris: dict[Path, str] = field(default_factory=dict)  # of the open files, as the editor says them
    versions: dict[Path, int] = field(default_factory=dict)

    def path(self, uri: str) -> Path:
        """The path that a URI stands for; one that is no file has a path where no file is."""
        try:
            name = to_fs_path(uri)
            path = Path(name).resolve() if name else None
        except (OSError, RuntimeError, ValueError):  # a loop of links, a null byte, a port that is no number
            path = None
        return path or Path("/", ".untitled", quote(uri, safe="", errors="replace"))

    def uri(self, path: Path) -> str:
        """The URI of a file."""
        return self.uris.get(path) or from_fs_path(str(path)) or ""

    def offset(self, text: str, position: types.Position) -> int:
        """The offset of a position."""
        return ruler(text, self.encoding).offset(position.line, position.character)

    def range(self, span: Span) -> types.Range:
        """A span as a range."""
        of = ruler(span.source.text, self.encoding)
        start, end = of.place(span.start), of.place(span.end)
        return types.Range(types.Position(*start), types.Position(*end))

    def whole(self, text: str) -> types.Range:
        """The range of a whole text."""
        source = Source("text", text)
        return self.range(Span(source, 0, len(text)))

    def location(self, span: Span) -> types.Location:
        """A span with its file."""
        return types.Location(self.uri(span.source.path), self.range(span))

    def diagnostic(self, found: Diagnostic) -> types.Diagnostic:
        """A finding; one whose fix takes it out is of something unnecessary."""
        empty = types.Range(types.Position(0, 0), types.Position(0, 0))
        is_removed = found.fix is not None and found.fix.title.startswith("Remove")
        return types.Diagnostic(
            self.range(found.span) if found.span else empty,
            f"{found.message}\n{found.hint}".strip(),
            SEVERITIES.get(found.severity, types.DiagnosticSeverity.Information),
            code=found.code or None,
            source="mindc",
            tags=[types.DiagnosticTag.Unnecessary] if is_removed else None,
            related_information=[
                types.DiagnosticRelatedInformation(self.location(label.span), label.message) for label in found.labels
            ]
            or None,
        )

    def text_edit(self, splice: Splice) -> types.TextEdit:
        """A splice of one file."""
        return types.TextEdit(self.range(Span(splice.source, splice.start, splice.end)), splice.text)

    def workspace_edit(
        self, splices: Iterable[Splice], created: Mapping[Path, str], plain: bool
    ) -> types.WorkspaceEdit:
        """Splices of several files, and new files; `plain` where the editor knows no more than texts that change."""
        by_path: dict[Path, list[types.TextEdit]] = {}
        for splice in splices:
            by_path.setdefault(splice.source.path, []).append(self.text_edit(splice))
        if plain:
            return types.WorkspaceEdit(changes={self.uri(path): edits for path, edits in by_path.items()})
        changes: list[types.TextDocumentEdit | types.CreateFile | types.RenameFile | types.DeleteFile] = []
        for path, text in created.items():
            changes.append(types.CreateFile(self.uri(path)))
            start = types.Range(types.Position(0, 0), types.Position(0, 0))
            changes.append(self._document_edit(path, [types.TextEdit(start, text)]))
        changes += [self._document_edit(path, edits) for path, edits in by_path.items()]
        return types.WorkspaceEdit(document_changes=changes)

    def _document_edit(self, path: Path, edits: list[types.TextEdit]) -> types.TextDocumentEdit:
        document = types.OptionalVersionedTextDocumentIdentifier(self.uri(path), self.versions.get(path))
        return types.TextDocumentEdit(document, list(edits))


@dataclass(frozen=True)
class Ruler:
    """The lines of a text as the protocol counts them: a lone carriage return ends one, too."""

    text: str
    encoding: str = "utf-16"

    @cached_property
    def starts(self) -> list[int]:
        """The offset at which each line begins."""
        return [0, *(end.end() for end in _LINE_END.finditer(self.text))]

    def offset(self, line: int, column: int) -> int:
        """The offset of a place; one behind the end of its line, or of the text, is that end."""
        if line < 0 or line >= len(self.starts):
            return 0 if line < 0 else len(self.text)
        start, end = self.starts[line], self._end(line)
        if self._is_plain:
            return min(start + max(column, 0), end)
        return start + self._characters(self.text[start:end], max(column, 0))

    def place(self, offset: int) -> tuple[int, int]:
        """The line and the column of an offset."""
        offset = min(max(offset, 0), len(self.text))
        line = bisect_right(self.starts, offset) - 1
        start = self.starts[line]
        if self._is_plain:
            return line, offset - start
        return line, self._units(self.text[start:offset])

    @cached_property
    def _is_plain(self) -> bool:
        """Whether a column is a number of characters, whatever is counted."""
        return self.encoding == "utf-32" or self.text.isascii()

    def _end(self, line: int) -> int:
        """Where the characters of a line end."""
        if line + 1 == len(self.starts):
            return len(self.text)
        end = self.starts[line + 1]
        return end - (2 if self.text[end - 2 : end] == "\r\n" else 1)

    def _units(self, text: str) -> int:
        """How many columns a text takes."""
        if self.encoding == "utf-8":
            return len(text.encode("utf-8", "surrogatepass"))
        return len(text.encode("utf-16-le", "surrogatepass")) // 2

    def _characters(self, text: str, columns: int) -> int:
        """How many characters begin before a column; one that is cut by it does."""
        low, high = 0, len(text)
        while low < high:
            middle = (low + high) // 2
            low, high = (middle + 1, high) if self._units(text[:middle]) < columns else (low, middle)
        return low


@lru_cache(CACHED_RULERS)
def ruler(text: str, encoding: str) -> Ruler:
    """The ruler of a text."""
    return Ruler(text, encoding)
