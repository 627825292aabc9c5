"""`mindc lsp`: a server with everything that it can do, and what the editor tells it about files.

Files are opened, changed, saved, closed; each ends in what is found in them.
"""

import logging
from typing import BinaryIO

from lsprotocol import types
from pygls.exceptions import JsonRpcException

from mindlang.server import commands, questions
from mindlang.server.server import MindServer

WATCHED = ("**/*.mind", "**/*.lock")


def make() -> MindServer:
    """A server that answers."""
    server = MindServer()
    for register in (register_texts, questions.register, commands.register):
        register(server)
    return server


def serve(messages: BinaryIO, answers: BinaryIO) -> int:
    """Serve until the editor says that it is over, or is gone; how the program ends."""
    logging.getLogger("pygls.protocol.json_rpc").addFilter(_is_fault)
    server = make()
    server.start_io(messages, answers)
    return 0 if server.is_shut_down else 1


def _is_fault(record: logging.LogRecord) -> bool:
    """Keep refusals, which the editor has been told, out of the editor's log."""
    error = record.exc_info[1] if record.exc_info else None
    return not isinstance(error, JsonRpcException)


def register_texts(server: MindServer) -> None:
    """Let a server take note of these notifications."""
    server.feature(types.INITIALIZE)(begin)
    server.feature(types.INITIALIZED)(watch)
    server.feature(types.TEXT_DOCUMENT_DID_OPEN)(opened)
    server.feature(types.TEXT_DOCUMENT_DID_CHANGE)(changed)
    server.feature(types.TEXT_DOCUMENT_DID_SAVE)(saved)
    server.feature(types.TEXT_DOCUMENT_DID_CLOSE)(closed)
    server.feature(types.WORKSPACE_DID_CHANGE_WATCHED_FILES)(changed_outside)
    server.feature(types.SHUTDOWN)(shut_down)


def begin(ls: MindServer, params: types.InitializeParams) -> None:
    """Count columns as the editor does."""
    ls.session.lsp.codec = ls.workspace.position_codec


async def watch(ls: MindServer, params: types.InitializedParams) -> None:
    """Ask to be told of files that change outside of the editor, where it can."""
    workspace = ls.client_capabilities.workspace
    watching = workspace.did_change_watched_files if workspace else None
    if watching and watching.dynamic_registration:
        watchers = [types.FileSystemWatcher(glob_pattern=pattern) for pattern in WATCHED]
        options = types.DidChangeWatchedFilesRegistrationOptions(watchers)
        registration = types.Registration("mind-files", types.WORKSPACE_DID_CHANGE_WATCHED_FILES, options)
        await ls.client_register_capability_async(types.RegistrationParams([registration]))


def opened(ls: MindServer, params: types.DidOpenTextDocumentParams) -> None:
    """A file is open now: look at it at once."""
    document = params.text_document
    ls.session.set(document.uri, document.version, document.text)
    ls.session.workspace.forget()
    ls.check()


def changed(ls: MindServer, params: types.DidChangeTextDocumentParams) -> None:
    """A file has another text: look at it when the user pauses."""
    if params.content_changes:  # each is the whole text
        document = params.text_document
        ls.session.set(document.uri, document.version, params.content_changes[-1].text)
        ls.check_soon()


def saved(ls: MindServer, params: types.DidSaveTextDocumentParams) -> None:
    """A file has been saved: the locks of an edit may follow now."""
    for message in ls.session.saved(ls.session.lsp.path(params.text_document.uri)):
        ls.say(message)
    ls.check_soon()


def closed(ls: MindServer, params: types.DidCloseTextDocumentParams) -> None:
    """A file is no longer open: its findings go, unless an open mind has it."""
    ls.session.close(params.text_document.uri)
    ls.check()


def changed_outside(ls: MindServer, params: types.DidChangeWatchedFilesParams) -> None:
    """Files have changed on the disk: by git, by a training."""
    ls.session.workspace.forget()
    ls.check_soon()


def shut_down(ls: MindServer, params: None) -> None:
    """All is over, as the editor says; `exit` will follow."""
    ls.is_shut_down = True
