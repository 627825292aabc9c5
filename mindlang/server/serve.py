"""`mindc lsp`: a server with everything that it can do, what an editor tells it about files, and what changes them.

Files are opened, changed, saved, closed; each ends in what is found in them. They are changed by renames, quick fixes,
and every edit of `mindc edit`.
"""

import logging
from dataclasses import asdict
from typing import Any, BinaryIO

from lsprotocol import types
from mindrun.errors import MindError
from pygls.exceptions import JsonRpcException

from mindlang.compiler.families import is_of_family
from mindlang.compiler.names import Mention
from mindlang.compiler.source import Source, Span, Splice, spliced
from mindlang.editing.edits import edit, names
from mindlang.editing.project import EditError
from mindlang.server.changing import EditOutcome, project
from mindlang.server.proposals import Selection, all_mended, mendings, proposals
from mindlang.server.questions import QUESTIONS
from mindlang.server.server import MindServer, failed

WATCHED = ("**/*.mind", "**/*.lock")
EDIT, EDITS = "mind.edit", "mind.edits"
FIX_ALL = "source.fixAll.mind"
KINDS = ("quickfix", "refactor", "refactor.rewrite", "refactor.extract", "refactor.inline", "refactor.move", FIX_ALL)


def make() -> MindServer:
    server = MindServer()
    for feature, answer, *options in (*CHANGES, *QUESTIONS):
        server.feature(feature, *options)(answer)
    server.command(EDIT)(edited)
    server.command(EDITS)(catalog)
    return server


def serve(messages: BinaryIO, answers: BinaryIO) -> int:
    """Serve until the editor says that it is over, or is gone; the exit code."""
    logging.getLogger("pygls.protocol.json_rpc").addFilter(_is_fault)
    server = make()
    server.start_io(messages, answers)
    return 0 if server.is_shut_down else 1


def _is_fault(record: logging.LogRecord) -> bool:
    """Keep refusals, which the editor has been told, out of the editor's log."""
    error = record.exc_info[1] if record.exc_info else None
    return not isinstance(error, JsonRpcException)


def begin(ls: MindServer, params: types.InitializeParams) -> None:
    """Count columns as the editor does, and make only edits that it takes: not all can make files and name versions."""
    workspace = params.capabilities.workspace
    edits = workspace.workspace_edit if workspace else None
    operations = edits.resource_operations or () if edits and edits.document_changes else ()
    ls.session.codec = ls.workspace.position_codec
    ls.session.plain = types.ResourceOperationKind.Create not in operations


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
    for message in ls.session.saved(ls.session.path(params.text_document.uri)):
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


def prepared(ls: MindServer, params: types.PrepareRenameParams) -> types.PrepareRenamePlaceholder | None:
    """The name at a place and its range, None where none is; refused where the mind does not compile."""
    view, path, offset = ls.session.place(params)
    mention = view.mention_at(path, offset)
    if mention is None:
        return None
    try:
        project(ls.session.workspace, view)
    except EditError as error:
        raise failed(error) from error
    return types.PrepareRenamePlaceholder(ls.session.range(mention.name.span), _name_of(mention))


def _name_of(mention: Mention) -> str:
    """The name by which something is renamed: a family by that of its line."""
    return mention.name.span.text if is_of_family(mention.name) else mention.name.text


def renamed(ls: MindServer, params: types.RenameParams) -> types.WorkspaceEdit | None:
    """Rename something wherever it is named, in neighbours too."""
    view, path, offset = ls.session.place(params)
    mention = view.mention_at(path, offset)
    if mention is None or params.new_name == mention.name.text:
        return None
    arguments = {"old": _name_of(mention), "new": params.new_name, "noun": mention.noun}
    try:
        outcome, edit = ls.outcome(path, "rename", arguments)
    except MindError as error:
        raise failed(error) from error
    ls.done(outcome)
    return edit


def acted(ls: MindServer, params: types.CodeActionParams) -> list[types.CodeAction]:
    view, path = ls.session.asked(params)
    source = ls.session.source(path)
    start, end = (ls.session.offset(source.text, place) for place in (params.range.start, params.range.end))
    wanted = params.context.only
    actions: list[types.CodeAction] = []
    if _wants(wanted, "quickfix"):
        for found, fix in mendings(view, path, start, end):
            edit, about = ls.session.workspace_edit(fix.splices, {}), [ls.session.diagnostic(found)]
            actions.append(types.CodeAction(fix.title, "quickfix", about, is_preferred=fix.is_safe, edit=edit))
    if _wants(wanted, FIX_ALL) and (text := all_mended(view, path, ls.session.workspace.texts)) is not None:
        edit = ls.session.workspace_edit((Splice(source, 0, len(source.text), text),), {})
        actions.append(types.CodeAction("Make all safe fixes", kind=FIX_ALL, edit=edit))
    if _wants(wanted, "refactor") and view.compiled.graph:
        selection = Selection(project(ls.session.workspace, view), path, start, end)
        for each in proposals(selection):
            arguments = [params.text_document.uri, each.edit, each.arguments, each.fresh]
            command = types.Command(each.title, EDIT, arguments=arguments)
            actions.append(types.CodeAction(each.title, kind=each.kind, command=command))
    return [action for action in actions if _wants(wanted, str(action.kind))]


def _wants(only: Any, kind: str) -> bool:
    """True if `only` asks for actions of a kind, of one above or of one below it; True without `only`."""
    asked = [str(getattr(each, "value", each)) for each in only or ()]
    return not asked or any(f"{kind}.".startswith(f"{each}.") or f"{each}.".startswith(f"{kind}.") for each in asked)


async def edited(ls: MindServer, *arguments: Any) -> types.Location | None:
    """Make an edit: the URI of a file, the name of the edit, its arguments, and a name in them to be chosen anew.

    The answer is where that name stands, so that the editor can let the user rename it.
    """
    uri, name, said, fresh = (*arguments, "", "", {}, "")[: max(4, len(arguments))][:4]
    path = ls.session.path(str(uri))
    try:
        outcome, edit = ls.outcome(path, str(name), said if isinstance(said, dict) else {})
    except MindError as error:
        ls.say(f"{error} {error.hint}".strip(), types.MessageType.Error)
        return None
    place = _place_of(ls, outcome, str(fresh or ""))
    answer = await ls.workspace_apply_edit_async(types.ApplyWorkspaceEditParams(edit, label=f"mindc edit {name}"))
    if not answer.applied:
        ls.say(f"The editor has not made the edit. {answer.failure_reason or ''}".strip(), types.MessageType.Warning)
        return None
    ls.done(outcome)
    return place


def _place_of(ls: MindServer, outcome: EditOutcome, fresh: str) -> types.Location | None:
    """The first place of a new name once an edit is made."""
    for source in {id(splice.source): splice.source for splice in outcome.change.splices}.values():
        text = spliced(source, outcome.change.splices)
        at = text.find(f" {fresh} ") + 1 if fresh else 0
        if at:
            return ls.session.location(Span(Source(source.name, text, source.folder), at, at + len(fresh)))
    return None


def catalog(ls: MindServer, *arguments: Any) -> list[dict[str, Any]]:
    """Every edit with its arguments and options, so that the editor can ask for them."""
    known = [edit(name) for name in names()]
    return [
        {
            "name": of.name,
            "text": of.text,
            "example": of.example,
            "arguments": [{"name": name, "many": many} for name, many in of.arguments],
            "options": [asdict(option) for option in of.options],
        }
        for of in known
    ]


CHANGES = (
    (types.INITIALIZE, begin),
    (types.INITIALIZED, watch),
    (types.TEXT_DOCUMENT_DID_OPEN, opened),
    (types.TEXT_DOCUMENT_DID_CHANGE, changed),
    (types.TEXT_DOCUMENT_DID_SAVE, saved),
    (types.TEXT_DOCUMENT_DID_CLOSE, closed),
    (types.WORKSPACE_DID_CHANGE_WATCHED_FILES, changed_outside),
    (types.SHUTDOWN, shut_down),
    (types.TEXT_DOCUMENT_PREPARE_RENAME, prepared),
    (types.TEXT_DOCUMENT_RENAME, renamed, types.RenameOptions(prepare_provider=True)),
    (types.TEXT_DOCUMENT_CODE_ACTION, acted, types.CodeActionOptions(code_action_kinds=list(KINDS))),
)
