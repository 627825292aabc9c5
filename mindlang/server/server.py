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
from mindlang.compiler.source import Source, Span, Splice
from mindlang.server.changing import EditOutcome, PendingRename, keep_up, perform
from mindlang.server.workspace import MindView, Workspace, are_breakpoints

Report = tuple[int | None, list[types.Diagnostic]]
MAX_PENDING_EDITS = 8  # edits whose locks are looked after
MAX_PUBLISHED_DIAGNOSTICS = 1000  # findings in a file
TYPING_PAUSE_SECONDS = 0.15  # seconds without typing, after which a text is checked
REQUEST_FAILED = -32803  # RequestFailed
SEVERITIES = {"error": types.DiagnosticSeverity.Error, "warning": types.DiagnosticSeverity.Warning}
BEGINNING = types.Range(types.Position(0, 0), types.Position(0, 0))
CACHED_TEXTS = 16  # whose lines and columns are remembered
_LINE_END = re.compile(r"\r\n|\n|\r")


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
    """The state of one editor: the units that its columns count, open files, reported findings, pending renames.

    `uris` and `versions` are of the open files, as the editor says them; where it is `plain`, it knows no more of edits
    than texts that change. The methods convert paths, offsets and spans for this editor, and back.
    """

    codec: PositionCodec = field(default_factory=PositionCodec)
    plain: bool = True
    workspace: Workspace = field(default_factory=Workspace)
    uris: dict[Path, str] = field(default_factory=dict)
    versions: dict[Path, int] = field(default_factory=dict)
    following: list[PendingRename] = field(default_factory=list)
    _told: dict[Path, Report] = field(default_factory=dict)

    def path(self, uri: str) -> Path:
        """The path that a URI stands for; one that is no file has a path where no file is."""
        name = to_fs_path(uri)
        return Path(name).resolve() if name else Path("/", ".untitled", quote(uri, safe=""))

    def uri(self, path: Path) -> str:
        return self.uris.get(path) or from_fs_path(str(path)) or ""

    def source(self, path: Path) -> Source:
        """The text of a file as it is now."""
        return Source(str(path), self.workspace.text(path), path.parent)

    def asked(self, params: Any) -> tuple[MindView, Path]:
        """The mind of the file that a request is about, and its path."""
        path = self.path(params.text_document.uri)
        return self.workspace.view(path), path

    def place(self, params: Any) -> tuple[MindView, Path, int]:
        """The mind of the file that a request is about, its path, and the offset of the position in it."""
        view, path = self.asked(params)
        return view, path, self.offset(self.workspace.text(path), params.position)

    def offset(self, text: str, position: types.Position) -> int:
        """The offset of a position; one behind the end of its line, or of the text, is that end."""
        starts = line_starts(text)
        if position.line >= len(starts):
            return len(text)
        start, end = [*starts, len(text)][position.line : position.line + 2]
        units, length = units_before(text, self.codec), len(text[start:end].rstrip("\r\n"))
        return bisect_left(units, units[start] + position.character, start, start + length)

    def position(self, text: str, offset: int) -> types.Position:
        starts, units = line_starts(text), units_before(text, self.codec)
        line = bisect_right(starts, offset) - 1
        return types.Position(line, units[offset] - units[starts[line]])

    def range(self, span: Span | Splice) -> types.Range:
        text = span.source.text
        return types.Range(self.position(text, span.start), self.position(text, span.end))

    def location(self, span: Span) -> types.Location:
        return types.Location(self.uri(span.source.path), self.range(span))

    def diagnostic(self, found: Diagnostic) -> types.Diagnostic:
        """A finding; one whose fix takes it out is of something unnecessary."""
        is_removed = found.fix is not None and found.fix.title.startswith("Remove")
        related = [types.DiagnosticRelatedInformation(self.location(each.span), each.message) for each in found.labels]
        return types.Diagnostic(
            self.range(found.span) if found.span else BEGINNING,
            f"{found.message}\n{found.hint}".strip(),
            SEVERITIES.get(found.severity, types.DiagnosticSeverity.Information),
            code=found.code or None,
            source="mindc",
            tags=[types.DiagnosticTag.Unnecessary] if is_removed else None,
            related_information=related or None,
        )

    def text_edit(self, splice: Splice) -> types.TextEdit:
        return types.TextEdit(self.range(splice), splice.text)

    def workspace_edit(self, splices: Iterable[Splice], created: Mapping[Path, str]) -> types.WorkspaceEdit:
        """Splices of several files, and new files, as the editor takes them."""
        edits = {path: [types.TextEdit(BEGINNING, text)] for path, text in created.items()}
        for splice in splices:
            edits.setdefault(splice.source.path, []).append(self.text_edit(splice))
        if self.plain:
            return types.WorkspaceEdit(changes={self.uri(path): each for path, each in edits.items()})
        changes: list[types.TextDocumentEdit | types.CreateFile | types.RenameFile | types.DeleteFile] = [
            types.CreateFile(self.uri(path)) for path in created
        ]
        for path, each in edits.items():
            document = types.OptionalVersionedTextDocumentIdentifier(self.uri(path), self.versions.get(path))
            changes.append(types.TextDocumentEdit(document, [*each]))
        return types.WorkspaceEdit(document_changes=changes)

    def set(self, uri: str, version: int, text: str) -> None:
        path = self.path(uri)
        self.uris[path], self.versions[path], self.workspace.texts[path] = uri, version, text

    def close(self, uri: str) -> None:
        path = self.path(uri)
        self.workspace.close(path)
        self.versions.pop(path, None)
        self.uris.pop(path, None)

    def news(self) -> Iterator[types.PublishDiagnosticsParams]:
        """The findings that have changed since the last report: by file, empty for files that have none now."""
        found = self._findings_by_file()
        for path in [*found, *(path for path in self._told if path not in found)]:
            now = self.versions.get(path), [self.diagnostic(each) for each in found.get(path, ())]
            if self._told.get(path) != now:
                yield types.PublishDiagnosticsParams(self.uri(path), now[1], now[0])
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
        for path in filter(are_breakpoints, self.workspace.texts):
            mind = self.workspace.view(path).compiled
            subject = subject_of_mind(mind) if mind.graph else None  # of one that does not compile no names are known
            by_file[path] = [*breakpoints_of(self.source(path), subject).diagnostics]
        return {path: _first(path, each) for path, each in by_file.items()}

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
    if (more := len(found) - MAX_PUBLISHED_DIAGNOSTICS) <= 0:
        return found
    told = Diagnostic("", f"There are {more} more findings in {path.name}.", severity="warning")
    return [*found[:MAX_PUBLISHED_DIAGNOSTICS], told]


class MindServer(LanguageServer):
    """The language server of one editor: its session, and what it says without being asked."""

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
        if self._due:
            self._due.cancel()
        for news in self.session.news():
            self.text_document_publish_diagnostics(news)

    def say(self, message: str, type_: types.MessageType = types.MessageType.Info) -> None:
        self.window_show_message(types.ShowMessageParams(type_, message))

    def outcome(self, path: Path, name: str, arguments: dict[str, Any]) -> tuple[EditOutcome, types.WorkspaceEdit]:
        """An edit made in memory, and as the editor takes it; MindError where it is impossible."""
        outcome = perform(self.session.workspace, path, name, arguments)
        if outcome.change.created and self.session.plain:
            raise MindError("This editor cannot make files.", f"On the command line: mindc edit {name}")
        return outcome, self.session.workspace_edit(outcome.change.splices, outcome.change.created)

    def done(self, outcome: EditOutcome) -> None:
        """Say what an edit does to weights, and let the locks follow it once its files are saved."""
        if outcome.following:
            self.session.following = [*self.session.following, outcome.following][-MAX_PENDING_EDITS:]
        if outcome.sentences:
            self.say(". ".join(outcome.sentences) + ".")


def failed(error: MindError) -> JsonRpcException:
    """A request that cannot be answered, with the reason in the user's words."""
    return JsonRpcException(f"{error} {error.hint}".strip(), REQUEST_FAILED)
