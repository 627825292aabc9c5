"""The server of one editor: what it remembers, what it may ask for, and how it talks."""

import asyncio
from collections.abc import Iterator
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path
from typing import Any

from lsprotocol import types
from mindrun.errors import MindError
from pygls.exceptions import JsonRpcException
from pygls.lsp.server import LanguageServer

from mindlang.breakpoints.resolve import breakpoints_of
from mindlang.breakpoints.subject import subject_of_mind
from mindlang.compiler.diagnostic import Diagnostic, listed
from mindlang.compiler.source import Source
from mindlang.server.changing import EditOutcome, PendingRename, keep_up, perform
from mindlang.server.lsp_types import LspConverter
from mindlang.server.workspace import MindView, Workspace, are_breakpoints

Report = tuple[int | None, list[types.Diagnostic]]
MAX_PENDING_EDITS = 8  # edits whose locks are looked after
MAX_PUBLISHED_DIAGNOSTICS = 1000  # findings in a file


@dataclass
class Session:
    """The state of one editor: open files, reported findings, and pending renames of locks."""

    workspace: Workspace = field(default_factory=Workspace)
    lsp: LspConverter = field(default_factory=LspConverter)
    following: list[PendingRename] = field(default_factory=list)
    _told: dict[Path, Report] = field(default_factory=dict)

    def set(self, uri: str, version: int, text: str) -> None:
        """A file has this text now."""
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
        mistakes = {path: self._stop_findings(path) for path in self.workspace.texts if are_breakpoints(path)}
        return {path: _first(path, mistakes.get(path, [*each.values()])) for path, each in found.items()}

    def _stop_findings(self, path: Path) -> list[Diagnostic]:
        """What is wrong with a file of breakpoints; no names are looked for in a mind that does not compile."""
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


TYPING_PAUSE_SECONDS = 0.15  # seconds without typing, after which a text is checked
REQUEST_FAILED = -32803  # RequestFailed


class MindServer(LanguageServer):
    """The language server of one editor: its session, its requests and its messages."""

    def __init__(self) -> None:
        sync = types.TextDocumentSyncKind.Full
        super().__init__("mindc", version("mindlang"), text_document_sync_kind=sync)
        self.session = Session()
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
        """Whether the editor takes edits that make files and name versions of texts."""
        workspace = self.client_capabilities.workspace
        edits = workspace.workspace_edit if workspace else None
        made = types.ResourceOperationKind.Create in (edits.resource_operations or ()) if edits else False
        return bool(edits and edits.document_changes and made)

    def outcome(self, path: Path, name: str, arguments: dict[str, Any]) -> tuple[EditOutcome, types.WorkspaceEdit]:
        """An edit made in memory, and as the editor takes it; MindError where it is impossible."""
        outcome = perform(self.session.workspace, path, name, arguments)
        plain = not self.knows_documents
        if outcome.change.created and plain:
            raise MindError("This editor cannot make files.", f"On the command line: mindc edit {name}")
        edit = self.session.lsp.workspace_edit(outcome.change.splices, outcome.change.created, plain)
        return outcome, edit

    def done(self, outcome: EditOutcome) -> None:
        """Say what an edit does to weights, and let the locks follow it."""
        self.session.follow(outcome.following)
        if outcome.sentences:
            self.say(". ".join(outcome.sentences) + ".")


def failed(error: MindError) -> JsonRpcException:
    """A request that cannot be answered, with the reason in the user's words."""
    return JsonRpcException(f"{error} {error.hint}".strip(), REQUEST_FAILED)
