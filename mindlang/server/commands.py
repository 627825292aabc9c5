"""What changes files: renames, quick fixes, and every edit of `mindc edit`."""

from dataclasses import asdict
from pathlib import Path
from typing import Any

from lsprotocol import types
from mindrun.errors import MindError

from mindlang.compiler.source import Source, Span
from mindlang.compiler.splice import Splice, spliced
from mindlang.editing.edits import edit, names
from mindlang.editing.project import EditError
from mindlang.server.changing import EditOutcome, project
from mindlang.server.proposals import Mending, Proposal, Selection, all_mended, mendings, proposals
from mindlang.server.server import MindServer, failed

EDIT, EDITS = "mind.edit", "mind.edits"
FIX_ALL = "source.fixAll.mind"
KINDS = ("quickfix", "refactor", "refactor.rewrite", "refactor.extract", "refactor.inline", "refactor.move", FIX_ALL)


def register(server: MindServer) -> None:
    """Let a server answer these requests."""
    server.feature(types.TEXT_DOCUMENT_PREPARE_RENAME)(prepared)
    server.feature(types.TEXT_DOCUMENT_RENAME, types.RenameOptions(prepare_provider=True))(renamed)
    server.feature(types.TEXT_DOCUMENT_CODE_ACTION, types.CodeActionOptions(code_action_kinds=list(KINDS)))(acted)
    server.command(EDIT)(edited)
    server.command(EDITS)(catalog)


def prepared(ls: MindServer, params: types.PrepareRenameParams) -> types.PrepareRenamePlaceholder | None:
    """What would be renamed; MindError where the mind has to compile first."""
    view, path, offset = ls.session.place(params.text_document.uri, params.position)
    mention = view.mention_at(path, offset)
    if mention is None:
        return None
    try:
        project(ls.session.workspace, view)
    except EditError as error:
        raise failed(error) from error
    return types.PrepareRenamePlaceholder(ls.session.lsp.range(mention.name.span), mention.name.text)


def renamed(ls: MindServer, params: types.RenameParams) -> types.WorkspaceEdit | None:
    """Rename something wherever it is named, in neighbours too."""
    view, path, offset = ls.session.place(params.text_document.uri, params.position)
    mention = view.mention_at(path, offset)
    if mention is None or params.new_name == mention.name.text:
        return None
    arguments = {"old": mention.name.text, "new": params.new_name, "noun": mention.noun}
    try:
        outcome, edit = ls.outcome(path, "rename", arguments)
    except MindError as error:
        raise failed(error) from error
    ls.done(outcome)
    return edit


def acted(ls: MindServer, params: types.CodeActionParams) -> list[types.CodeAction]:
    """The quick fixes and the edits at a selection."""
    view, path, start = ls.session.place(params.text_document.uri, params.range.start)
    end = ls.session.lsp.offset(ls.session.workspace.text(path), params.range.end)
    wanted = params.context.only
    actions: list[types.CodeAction] = []
    if _wants(wanted, "quickfix"):
        actions += [_mending(ls, each) for each in mendings(view, path, start, end)]
    if _wants(wanted, FIX_ALL) and (text := all_mended(view, path, ls.session.workspace.texts)) is not None:
        actions.append(_fix_all(ls, path, text))
    if _wants(wanted, "refactor") and view.compiled.graph:
        selection = Selection(project(ls.session.workspace, view), path, start, end)
        actions += [_proposal(params.text_document.uri, each) for each in proposals(selection)]
    return [action for action in actions if _wants(wanted, str(action.kind))]


def _wants(only: Any, kind: str) -> bool:
    """Whether actions of a kind, or below it, were asked for."""
    asked = [str(getattr(each, "value", each)) for each in only or ()]
    return not asked or any(f"{kind}.".startswith(f"{each}.") or f"{each}.".startswith(f"{kind}.") for each in asked)


def _mending(ls: MindServer, mending: Mending) -> types.CodeAction:
    return types.CodeAction(
        mending.title,
        kind="quickfix",
        diagnostics=[ls.session.lsp.diagnostic(mending.of)],
        is_preferred=mending.is_safe,
        edit=ls.session.lsp.workspace_edit(mending.splices, {}, not ls.knows_documents),
    )


def _fix_all(ls: MindServer, path: Path, text: str) -> types.CodeAction:
    source = Source(str(path), ls.session.workspace.text(path), path.parent)
    splices = (Splice(source, 0, len(source.text), text),)
    edit = ls.session.lsp.workspace_edit(splices, {}, not ls.knows_documents)
    return types.CodeAction("Make all safe fixes", kind=FIX_ALL, edit=edit)


def _proposal(uri: str, proposal: Proposal) -> types.CodeAction:
    arguments = [uri, proposal.edit, proposal.arguments, proposal.fresh]
    command = types.Command(proposal.title, EDIT, arguments=arguments)
    return types.CodeAction(proposal.title, kind=proposal.kind, command=command)


async def edited(ls: MindServer, *arguments: Any) -> types.Location | None:
    """Make an edit: the URI of a file, the name of the edit, its arguments, and a name in them to be chosen anew.

    The answer is where that name stands, so that the editor can let the user rename it.
    """
    uri, name, said, fresh = (*arguments, "", "", {}, "")[: max(4, len(arguments))][:4]
    path = ls.session.lsp.path(str(uri))
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
    """Where a new name will stand first once an edit is made."""
    for source in {id(splice.source): splice.source for splice in outcome.change.splices}.values():
        text = spliced(source, outcome.change.splices)
        at = text.find(f" {fresh} ") + 1 if fresh else 0
        if at:
            return ls.session.lsp.location(Span(Source(source.name, text, source.folder), at, at + len(fresh)))
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
