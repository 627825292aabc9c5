"""The server of one editor: what it remembers, what it may ask for, and how it talks."""

import asyncio
from importlib.metadata import version
from pathlib import Path
from typing import Any

from lsprotocol import types
from mindrun.errors import MindError
from pygls.exceptions import FeatureRequestError, JsonRpcException
from pygls.lsp.server import LanguageServer

from mindlang.server.changing import EditOutcome, perform
from mindlang.server.protocol import NO_JSON, MindProtocol
from mindlang.server.session import Session

TYPING_PAUSE_SECONDS = 0.15  # seconds without typing, after which a text is checked
REQUEST_FAILED = -32803  # RequestFailed


class MindServer(LanguageServer):
    """The language server of one editor: its session, its requests and its messages."""

    def __init__(self) -> None:
        sync = types.TextDocumentSyncKind.Full
        super().__init__("mindc", version("mindlang"), text_document_sync_kind=sync, protocol_cls=MindProtocol)
        self.session = Session()
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

    def report_server_error(self, error: Exception, source: Any) -> None:
        """Tell the editor of what is no answer to a request: a message that is no JSON, or a fault of ours."""
        match error:
            case ValueError() | RecursionError() if source is JsonRpcException:
                self._protocol.refuse(None, NO_JSON, "A message is one JSON object.")
            case _ if source is not FeatureRequestError:
                self.say(f"mindc failed: {error}. Please report it.", types.MessageType.Error)

    @property
    def _protocol(self) -> MindProtocol:
        assert isinstance(self.protocol, MindProtocol)
        return self.protocol

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
