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
from pygls.workspace import PositionCodec

from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.source import Span
from mindlang.compiler.splice import Splice

SEVERITIES = {"error": types.DiagnosticSeverity.Error, "warning": types.DiagnosticSeverity.Warning}
CACHED_TEXTS = 16  # whose lines are remembered
_LINE_END = re.compile(r"\r\n|\n|\r")


@dataclass
class LspConverter:
    """How paths and offsets are said to one editor: its URIs, and the units that its columns count."""

    codec: PositionCodec = field(default_factory=PositionCodec)
    uris: dict[Path, str] = field(default_factory=dict)  # of the open files, as the editor says them
    versions: dict[Path, int] = field(default_factory=dict)

    def path(self, uri: str) -> Path:
        """The path that a URI stands for; one that is no file has a path where no file is."""
        name = to_fs_path(uri)
        return Path(name).resolve() if name else Path("/", ".untitled", quote(uri, safe=""))

    def uri(self, path: Path) -> str:
        """The URI of a file."""
        return self.uris.get(path) or from_fs_path(str(path)) or ""

    def offset(self, text: str, position: types.Position) -> int:
        """The offset of a position."""
        return lines_of(text).offset(position, self.codec)

    def range(self, span: Span) -> types.Range:
        """A span as a range."""
        lines = lines_of(span.source.text)
        return types.Range(lines.position(span.start, self.codec), lines.position(span.end, self.codec))

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
class TextLines:
    """The lines of a text as the protocol counts them: a lone carriage return ends one, too."""

    text: str

    @cached_property
    def starts(self) -> list[int]:
        """The offset at which each line begins."""
        return [0, *(end.end() for end in _LINE_END.finditer(self.text))]

    def offset(self, position: types.Position, codec: PositionCodec) -> int:
        """The offset of a position; one behind the end of its line, or of the text, is that end."""
        if position.line >= len(self.starts):
            return len(self.text)
        start, end = [*self.starts, len(self.text)][position.line : position.line + 2]
        line = self.text[start:end].rstrip("\r\n")
        column = min(position.character, codec.client_num_units(line))
        found = codec.position_from_client_units([line], types.Position(0, column))
        return start + found.character

    def position(self, offset: int, codec: PositionCodec) -> types.Position:
        """The position of an offset."""
        line = bisect_right(self.starts, offset) - 1
        return types.Position(line, codec.client_num_units(self.text[self.starts[line] : offset]))


@lru_cache(CACHED_TEXTS)
def lines_of(text: str) -> TextLines:
    """The lines of a text."""
    return TextLines(text)
