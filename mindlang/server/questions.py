"""Requests about a place in a file, and the commands of mindc that an editor shows above lines."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from lsprotocol import types

from mindlang.compiler.format import format_splices
from mindlang.compiler.source import Source, Span
from mindlang.compiler.splice import Splice
from mindlang.compiler.syntax import Declaration, Master, Teaches
from mindlang.server.completing import complete
from mindlang.server.hovering import hover
from mindlang.server.lsp_types import LspConverter
from mindlang.server.navigating import Symbol, definitions, everything, highlights, references, symbols
from mindlang.server.offers import Offer
from mindlang.server.server import MindServer
from mindlang.server.workspace import MindView, are_breakpoints

SYMBOLS = {
    "body": types.SymbolKind.Object,
    "actuator": types.SymbolKind.Interface,
    "sensor": types.SymbolKind.Field,
    "memory": types.SymbolKind.Variable,
    "skill": types.SymbolKind.Function,
    "scene": types.SymbolKind.Namespace,
    "number": types.SymbolKind.Number,
    "task": types.SymbolKind.Event,
    "curriculum": types.SymbolKind.Module,
    "thing": types.SymbolKind.Constant,
}
OFFERS = {
    "actuator": types.CompletionItemKind.Interface,
    "sensor": types.CompletionItemKind.Field,
    "memory": types.CompletionItemKind.Variable,
    "skill": types.CompletionItemKind.Function,
    "scene": types.CompletionItemKind.Module,
    "number": types.CompletionItemKind.Value,
    "task": types.CompletionItemKind.Event,
    "environment": types.CompletionItemKind.Module,
    "thing": types.CompletionItemKind.Constant,
    "kind": types.CompletionItemKind.Class,
    "key": types.CompletionItemKind.Property,
    "unit": types.CompletionItemKind.Unit,
    "file": types.CompletionItemKind.File,
    "function": types.CompletionItemKind.Function,
    "word": types.CompletionItemKind.Keyword,
}

TERMINAL = "mind.terminal"  # which is the editor's own
DUE_TITLE = "Train what is due"
LOOKING_COMMANDS = {"Run": "run", "Bench": "bench", "View": "view"}  # a word above the line, and the command of mindc


def register(server: MindServer) -> None:
    """Let a server answer these requests."""
    server.feature(types.TEXT_DOCUMENT_HOVER)(hovered)
    server.feature(types.TEXT_DOCUMENT_COMPLETION, types.CompletionOptions(trigger_characters=[" ", '"']))(completed)
    server.feature(types.TEXT_DOCUMENT_DEFINITION)(defined)
    server.feature(types.TEXT_DOCUMENT_REFERENCES)(referred)
    server.feature(types.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT)(highlighted)
    server.feature(types.TEXT_DOCUMENT_DOCUMENT_SYMBOL)(outlined)
    server.feature(types.WORKSPACE_SYMBOL)(searched)
    server.feature(types.TEXT_DOCUMENT_FORMATTING)(formatted)
    server.feature(types.TEXT_DOCUMENT_CODE_LENS, types.CodeLensOptions())(asked_above)


def hovered(ls: MindServer, params: types.HoverParams) -> types.Hover | None:
    """The explanation of what is under the mouse."""
    found = hover(*ls.session.place(params.text_document.uri, params.position))
    if found is None:
        return None
    content = types.MarkupContent(types.MarkupKind.Markdown, found.text)
    return types.Hover(content, ls.session.lsp.range(found.span))


def completed(ls: MindServer, params: types.CompletionParams) -> types.CompletionList:
    """The completions at the cursor."""
    view, path, offset = ls.session.place(params.text_document.uri, params.position)
    text = ls.session.workspace.text(path)
    found = complete(view, path, text, offset)
    source = Source(str(path), text, path.parent)
    edits = (ls.session.lsp.text_edit(Splice(source, found.start, offset, offer.label)) for offer in found.offers)
    items = [_item(*each) for each in enumerate(zip(found.offers, edits, strict=True))]
    return types.CompletionList(is_incomplete=False, items=items)


def asked_above(ls: MindServer, params: types.CodeLensParams) -> list[types.CodeLens]:
    """What stands above lines: commands of mindc, which the editor runs in a terminal."""
    path = ls.session.lsp.path(params.text_document.uri)
    view = ls.session.workspace.view(path)
    folder = str(view.main.parent)
    return [
        types.CodeLens(
            ls.session.lsp.range(lens.span),
            types.Command(lens.title, TERMINAL, arguments=[{"folder": folder, "words": list(lens.words)}]),
        )
        for lens in lenses(view, path)
    ]


def _item(place: int, of: tuple[Offer, types.TextEdit]) -> types.CompletionItem:
    offer, edit = of
    return types.CompletionItem(
        offer.label,
        kind=OFFERS.get(offer.sort, types.CompletionItemKind.Text),
        detail=offer.detail or None,
        documentation=types.MarkupContent(types.MarkupKind.Markdown, offer.text) if offer.text else None,
        sort_text=f"{place:05}",
        text_edit=edit,
    )


def defined(ls: MindServer, params: types.DefinitionParams) -> list[types.Location]:
    """The declaration of the name under the cursor."""
    spans = definitions(*ls.session.place(params.text_document.uri, params.position))
    return [ls.session.lsp.location(span) for span in spans]


def referred(ls: MindServer, params: types.ReferenceParams) -> list[types.Location]:
    """Every place where the name under the cursor stands."""
    place = ls.session.place(params.text_document.uri, params.position)
    spans = references(ls.session.workspace, *place, with_declaration=params.context.include_declaration)
    return [ls.session.lsp.location(span) for span in spans]


def highlighted(ls: MindServer, params: types.DocumentHighlightParams) -> list[types.DocumentHighlight]:
    """Every place in this file where the name under the cursor stands."""
    spans = highlights(*ls.session.place(params.text_document.uri, params.position))
    return [types.DocumentHighlight(ls.session.lsp.range(span)) for span in spans]


def outlined(ls: MindServer, params: types.DocumentSymbolParams) -> list[types.DocumentSymbol]:
    """The outline of a file."""
    path = ls.session.lsp.path(params.text_document.uri)
    file = ls.session.workspace.view(path).file(path)
    return [_symbol(ls.session.lsp, symbol) for symbol in symbols(file)] if file else []


def _symbol(lsp: LspConverter, symbol: Symbol) -> types.DocumentSymbol:
    return types.DocumentSymbol(
        symbol.name,
        SYMBOLS[symbol.noun],
        lsp.range(symbol.whole),
        lsp.range(symbol.place),
        detail=f"{symbol.noun} {symbol.kind}".strip(),
        children=[_symbol(lsp, inner) for inner in symbol.inner],
    )


def searched(ls: MindServer, params: types.WorkspaceSymbolParams) -> list[types.WorkspaceSymbol]:
    """The declarations of all files whose names match a query."""
    folders = [ls.session.lsp.path(uri) for uri in ls.workspace.folders]
    if not folders and ls.workspace.root_uri:
        folders = [ls.session.lsp.path(ls.workspace.root_uri)]
    return [
        types.WorkspaceSymbol(
            ls.session.lsp.location(symbol.place), symbol.name, SYMBOLS[symbol.noun], container_name=symbol.noun
        )
        for symbol in everything(ls.session.workspace, folders, params.query)
    ]


def formatted(ls: MindServer, params: types.DocumentFormattingParams) -> list[types.TextEdit]:
    """The file as it should be written."""
    path = ls.session.lsp.path(params.text_document.uri)
    source = Source(str(path), ls.session.workspace.text(path), path.parent)
    splices = format_splices(source, "stop" if are_breakpoints(path) else "line")
    return [ls.session.lsp.text_edit(splice) for splice in splices]


@dataclass(frozen=True, slots=True)
class Lens:
    """A word above a line, and the arguments of mindc that it stands for."""

    span: Span
    title: str
    words: tuple[str, ...]


def lenses(view: MindView, path: Path) -> list[Lens]:
    """The words above the lines `master`, `task` and `curriculum` of a file, in the order of its text.

    All of them are about the mind to which the file belongs. A task has the skills that are taught on it.
    """
    file = view.file(path)
    if file is None or not view.main.is_file():
        return []
    found = [lens for setting in file.settings if isinstance(setting, Master) for lens in _of_master(view, setting)]
    for declaration in file.declarations:
        match declaration.header.noun.text:
            case "task":
                found += _of_task(view, declaration)
            case "curriculum":
                found.append(_of_curriculum(view, declaration))
    return sorted(found, key=lambda lens: lens.span.start)


def _of_master(view: MindView, master: Master) -> Iterator[Lens]:
    """Nothing in a mind that only thinks, for there is no world in which it could be run."""
    if master.span.source.path == view.main and view.names.of("task"):
        if view.names.of("curriculum"):
            yield Lens(master.span, DUE_TITLE, ("train", view.main.name))
        yield from _looks(view, master.span)


def _of_task(view: MindView, task: Declaration) -> Iterator[Lens]:
    header, name = task.header, task.header.name.text
    lessons = (fact for file in view.files for each in file.declarations for fact in each.facts)
    skills = dict.fromkeys(fact.skill.text for fact in lessons if isinstance(fact, Teaches) and fact.task.text == name)
    for skill in skills:
        yield Lens(header.span, f"Train {skill}", ("train", view.main.name, skill))
    yield from _looks(view, header.span, "--task", name)


def _of_curriculum(view: MindView, curriculum: Declaration) -> Lens:
    header = curriculum.header
    return Lens(header.span, DUE_TITLE, ("train", view.main.name, "--curriculum", header.name.text))


def _looks(view: MindView, span: Span, *more: str) -> Iterator[Lens]:
    return (Lens(span, title, (command, view.main.name, *more)) for title, command in LOOKING_COMMANDS.items())
