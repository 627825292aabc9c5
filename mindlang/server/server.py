"""The server of one editor: what it remembers, how it talks, and plain values as the types of the protocol."""

import asyncio
import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from importlib.metadata import version
from itertools import accumulate
from pathlib import Path
from typing import Any
from urllib.parse import quote

from lsprotocol import types
from mindrun.errors import MindError
from pygls.exceptions import JsonRpcException
from pygls.lsp.server import LanguageServer
from pygls.uris import from_fs_path, to_fs_path
from pygls.workspace import PositionCodec

from mindlang.breakpoints.resolve import breakpoints_of
from mindlang.breakpoints.subject import subject_of_mind
from mindlang.compiler.diagnostic import Diagnostic, listed
from mindlang.compiler.source import Source, Span
from mindlang.compiler.splice import Splice
from mindlang.server.changing import EditOutcome, PendingRename, keep_up, perform
from mindlang.server.workspace import MindView, Workspace, are_breakpoints

Report = tuple[int | None, list[types.Diagnostic]]
MAX_PENDING_EDITS = 8  # edits whose locks are looked after
MAX_PUBLISHED_DIAGNOSTICS = 1000  # findings in a file
TYPING_PAUSE_SECONDS = 0.15  # seconds without typing, after which a text is checked
REQUEST_FAILED = -32803  # RequestFailed
NOTHING_CREATED: Mapping[Path, str] = {}
SEVERITIES = {"error": types.DiagnosticSeverity.Error, "warning": types.DiagnosticSeverity.Warning}
CACHED_TEXTS = 16  # whose lines and columns are remembered
_LINE_END = re.compile(r"\r\n|\n|\r")


@dataclass
class LspConverter:
    """Converts paths and offsets for one editor: its URIs, and the units that its columns count."""

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
        """The offset of a position; one behind the end of its line, or of the text, is that end."""
        starts = line_starts(text)
        if position.line >= len(starts):
            return len(text)
        start, end = [*starts, len(text)][position.line : position.line + 2]
        units, length = units_before(text, self.codec), len(text[start:end].rstrip("\r\n"))
        return bisect_left(units, units[start] + position.character, start, start + length)

    def position(self, text: str, offset: int) -> types.Position:
        """The position of an offset."""
        starts, units = line_starts(text), units_before(text, self.codec)
        line = bisect_right(starts, offset) - 1
        return types.Position(line, units[offset] - units[starts[line]])

    def range(self, span: Span) -> types.Range:
        """A span as a range."""
        text = span.source.text
        return types.Range(self.position(text, span.start), self.position(text, span.end))

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


@lru_cache(CACHED_TEXTS)
def line_starts(text: str) -> list[int]:
    """The offset at which each line of a text begins, as the protocol counts them: a lone carriage return ends one."""
    return [0, *(end.end() for end in _LINE_END.finditer(text))]


@lru_cache(CACHED_TEXTS)
def units_before(text: str, codec: PositionCodec) -> Sequence[int]:
    """The number of units of columns before each character of a text, and in all of it."""
    if text.isascii():
        return range(len(text) + 1)
    units = {character: codec.client_num_units(character) for character in set(text)}
    return [0, *accumulate(map(units.__getitem__, text))]


@dataclass
class EditorSession:
    """The state of one editor: open files, reported findings, and pending renames of locks."""

    workspace: Workspace = field(default_factory=Workspace)
    lsp: LspConverter = field(default_factory=LspConverter)
    following: list[PendingRename] = field(default_factory=list)
    _told: dict[Path, Report] = field(default_factory=dict)

    def set(self, uri: str, version: int, text: str) -> None:
        """Set the text that a file has now."""
        path = self.lsp.path(uri)
        self.lsp.uris[path], self.lsp.versions[path] = uri, version
        self.workspace.texts[path] = text

    def close(self, uri: str) -> None:
        """A file is no longer open."""
        path = self.lsp.path(uri)
        self.workspace.close(path)
        self.lsp.versions.pop(path, None)
        self.lsp.uris.pop(path, None)

    def place(self, uri: str, position: types.Position) -> tuple[MindView, Path, int]:
        """The mind of a file, its path, and the offset of a position in it."""
        path = self.lsp.path(uri)
        return self.workspace.view(path), path, self.lsp.offset(self.workspace.text(path), position)

    def news(self) -> Iterator[types.PublishDiagnosticsParams]:
        """The findings that have changed since the last report: by file, empty for files that have none now."""
        found = self._findings_by_file()
        for path in [*found, *(path for path in self._told if path not in found)]:
            now = self.lsp.versions.get(path), [self.lsp.diagnostic(each) for each in found.get(path, ())]
            if self._told.get(path) != now:
                yield types.PublishDiagnosticsParams(self.lsp.uri(path), now[1], now[0])
            self._told[path] = now
        self._told = {path: report for path, report in self._told.items() if report[1] or path in found}

    def _findings_by_file(self) -> dict[Path, list[Diagnostic]]:
        """The findings by file, each once, also where several minds have it."""
        found: dict[Path, dict[tuple[object, ...], Diagnostic]] = {path: {} for path in self.workspace.texts}
        for main in self.workspace.mains():
            for each in self.workspace.mind(main).findings:
                path = each.span.source.path if each.span else main
                place = (each.span.start, each.span.end) if each.span else (0, 0)
                found.setdefault(path, {}).setdefault((*place, each.code, each.message), each)
        by_file = {path: [*each.values()] for path, each in found.items()}
        by_file |= {path: self._stop_findings(path) for path in self.workspace.texts if are_breakpoints(path)}
        return {path: _first(path, each) for path, each in by_file.items()}

    def _stop_findings(self, path: Path) -> list[Diagnostic]:
        """The diagnostics of a .break file; no names are looked for in a mind that does not compile."""
        mind = self.workspace.view(path).compiled
        subject = subject_of_mind(mind) if mind.graph else None
        return [*breakpoints_of(Source(str(path), self.workspace.text(path), path.parent), subject).diagnostics]

    def follow(self, following: PendingRename | None) -> None:
        """Let locks follow an edit once its files are saved."""
        if following:
            self.following = [*self.following, following][-MAX_PENDING_EDITS:]

    def saved(self, path: Path) -> Iterator[str]:
        """A file lies on the disk as it is; what there is to say of the locks that have followed."""
        self.workspace.forget()
        for following in [each for each in self.following if path in each.files]:
            try:
                if locks := keep_up(following):
                    yield f"{listed((lock.name for lock in locks), 'and')} has followed: no weights are lost"
            except MindError as error:
                yield f"{error}. The locks have not followed; mindc status says which weights no longer fit."


def _first(path: Path, found: list[Diagnostic]) -> list[Diagnostic]:
    """The first findings of a file, and how many more there are: nobody reads them all, and editors wait for them."""
    if len(found) <= MAX_PUBLISHED_DIAGNOSTICS:
        return found
    more = Diagnostic(
        "", f"There are {len(found) - MAX_PUBLISHED_DIAGNOSTICS} more findings in {path.name}.", severity="warning"
    )
    return [*found[:MAX_PUBLISHED_DIAGNOSTICS], more]


class MindServer(LanguageServer):
    """The language server of one editor: its session, its requests and its messages."""

    def __init__(self) -> None:
        sync = types.TextDocumentSyncKind.Full
        super().__init__("mindc", version("mindlang"), text_document_sync_kind=sync)
        self.session = EditorSession()
        self.is_shut_down = False  # whether the editor has said that all is over
        self._due: asyncio.TimerHandle | None = None

    def check_soon(self) -> None:
        """Check what is open when the user pauses."""
        if self._due:
            self._due.cancel()
        self._due = asyncio.get_running_loop().call_later(TYPING_PAUSE_SECONDS, self.check)

    def check(self) -> None:
        """Say what is new about the open files."""
        if self._due:
            self._due.cancel()
        for news in self.session.news():
            self.text_document_publish_diagnostics(news)

    def say(self, message: str, type_: types.MessageType = types.MessageType.Info) -> None:
        """Show the user a message."""
        self.window_show_message(types.ShowMessageParams(type_, message))

    @property
    def knows_documents(self) -> bool:
        """True if the editor takes edits that make files and name versions of texts."""
        workspace = self.client_capabilities.workspace
        edits = workspace.workspace_edit if workspace else None
        made = types.ResourceOperationKind.Create in (edits.resource_operations or ()) if edits else False
        return bool(edits and edits.document_changes and made)

    def outcome(self, path: Path, name: str, arguments: dict[str, Any]) -> tuple[EditOutcome, types.WorkspaceEdit]:
        """An edit made in memory, and as the editor takes it; MindError where it is impossible."""
        outcome = perform(self.session.workspace, path, name, arguments)
        if outcome.change.created and not self.knows_documents:
            raise MindError("This editor cannot make files.", f"On the command line: mindc edit {name}")
        return outcome, self.workspace_edit(outcome.change.splices, outcome.change.created)

    def workspace_edit(
        self, splices: Iterable[Splice], created: Mapping[Path, str] = NOTHING_CREATED
    ) -> types.WorkspaceEdit:
        """Splices of several files, and new files, as the editor takes them."""
        return self.session.lsp.workspace_edit(splices, created, not self.knows_documents)

    def done(self, outcome: EditOutcome) -> None:
        """Say what an edit does to weights, and let the locks follow it."""
        self.session.follow(outcome.following)
        if outcome.sentences:
            self.say(". ".join(outcome.sentences) + ".")


def failed(error: MindError) -> JsonRpcException:
    """A request that cannot be answered, with the reason in the user's words."""
    return JsonRpcException(f"{error} {error.hint}".strip(), REQUEST_FAILED)
