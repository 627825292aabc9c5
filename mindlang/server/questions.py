"""Requests about a place in a file, what a file declares, and the commands of mindc that stand above lines."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import chain, islice, starmap
from pathlib import Path

from lsprotocol import types

from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.format import format_splices
from mindlang.compiler.names import Mention, introductions
from mindlang.compiler.parse import parse
from mindlang.compiler.source import Source, Span
from mindlang.compiler.syntax import Argument, Contains, Declaration, File, Master, Name, Phrase, Teaches, Use, of_form
from mindlang.files import files_below, readable_text, within_read_limits
from mindlang.server.completing import complete
from mindlang.server.hovering import hover
from mindlang.server.places import path_to
from mindlang.server.server import EditorSession, MindServer
from mindlang.server.workspace import MindView, Workspace, are_breakpoints

SYMBOL, ITEM = types.SymbolKind, types.CompletionItemKind
SORTS = {  # what is declared as an editor shows it, in an outline and among offers
    "body": (SYMBOL.Object, ITEM.Text),
    "actuator": (SYMBOL.Interface, ITEM.Interface),
    "sensor": (SYMBOL.Field, ITEM.Field),
    "memory": (SYMBOL.Variable, ITEM.Variable),
    "skill": (SYMBOL.Function, ITEM.Function),
    "scene": (SYMBOL.Namespace, ITEM.Module),
    "number": (SYMBOL.Number, ITEM.Value),
    "task": (SYMBOL.Event, ITEM.Event),
    "curriculum": (SYMBOL.Module, ITEM.Text),
    "thing": (SYMBOL.Constant, ITEM.Constant),
    "draw": (SYMBOL.Number, ITEM.Value),
}
OFFERS = {
    **{noun: item for noun, (_, item) in SORTS.items()},
    "environment": ITEM.Module,
    "kind": ITEM.Class,
    "key": ITEM.Property,
    "unit": ITEM.Unit,
    "file": ITEM.File,
    "function": ITEM.Function,
    "word": ITEM.Keyword,
}

TERMINAL = "mind.terminal"  # which is the editor's own
DUE_TITLE = "Train what is due"
LOOKING_COMMANDS = {"Run": "run", "Bench": "bench", "View": "view"}  # a word above the line, and the command of mindc


def hovered(ls: MindServer, params: types.HoverParams) -> types.Hover | None:
    found = hover(*ls.session.place(params))
    if found is None:
        return None
    content = types.MarkupContent(types.MarkupKind.Markdown, found.text)
    return types.Hover(content, ls.session.range(found.span))


def completed(ls: MindServer, params: types.CompletionParams) -> types.CompletionList:
    view, path, offset = ls.session.place(params)
    source = ls.session.source(path)
    found = complete(view, path, source.text, offset)
    where = ls.session.range(Span(source, found.start, offset))
    items = [
        types.CompletionItem(
            offer.label,
            kind=OFFERS[offer.sort],
            detail=offer.detail or None,
            documentation=types.MarkupContent(types.MarkupKind.Markdown, offer.text) if offer.text else None,
            sort_text=f"{number:05}",
            text_edit=types.TextEdit(where, offer.label),
        )
        for number, offer in enumerate(found.offers)
    ]
    return types.CompletionList(is_incomplete=False, items=items)


def asked_above(ls: MindServer, params: types.CodeLensParams) -> list[types.CodeLens]:
    """The code lenses of a file: commands of mindc above lines, which the editor runs in a terminal."""
    view, path = ls.session.asked(params)
    folder = str(view.main.parent)
    return [
        types.CodeLens(
            ls.session.range(lens.span),
            types.Command(lens.title, TERMINAL, arguments=[{"folder": folder, "words": list(lens.words)}]),
        )
        for lens in lenses(view, path)
    ]


def defined(ls: MindServer, params: types.DefinitionParams) -> list[types.Location]:
    spans = definitions(*ls.session.place(params))
    return [ls.session.location(span) for span in spans]


def referred(ls: MindServer, params: types.ReferenceParams) -> list[types.Location]:
    place = ls.session.place(params)
    spans = references(ls.session.workspace, *place, with_declaration=params.context.include_declaration)
    return [ls.session.location(span) for span in spans]


def highlighted(ls: MindServer, params: types.DocumentHighlightParams) -> list[types.DocumentHighlight]:
    spans = highlights(*ls.session.place(params))
    return [types.DocumentHighlight(ls.session.range(span)) for span in spans]


def outlined(ls: MindServer, params: types.DocumentSymbolParams) -> list[types.DocumentSymbol]:
    view, path = ls.session.asked(params)
    file = view.file(path)
    return [outline(ls.session, each) for each in file.declarations] if file else []


def outline(session: EditorSession, declaration: Declaration) -> types.DocumentSymbol:
    """A declaration from its header to the end of its last line, with the things that it contains."""
    header = declaration.header
    end = max(each.span.end for each in (header, *declaration.facts))
    things = [
        types.DocumentSymbol(
            fact.name.text,
            SORTS["thing"][0],
            session.range(fact.span),
            session.range(fact.name.span),
            detail=f"thing {fact.phrase.kind.text}",
            children=[],
        )
        for fact in of_form(declaration.facts, Contains)
    ]
    kind = header.phrase.kind.text if header.phrase else f"like {header.like.text}" if header.like else ""
    return types.DocumentSymbol(
        header.name.text,
        SORTS[header.noun.text][0],
        session.range(Span(header.span.source, header.span.start, end)),
        session.range(header.name.span),
        detail=f"{header.noun.text} {kind}".strip(),
        children=things,
    )


def searched(ls: MindServer, params: types.WorkspaceSymbolParams) -> list[types.WorkspaceSymbol]:
    roots = [*ls.workspace.folders] or [*filter(None, [ls.workspace.root_uri])]
    found = matching_declarations(ls.session.workspace, map(ls.session.path, roots), params.query)
    return [
        types.WorkspaceSymbol(
            ls.session.location(header.name.span),
            header.name.text,
            SORTS[header.noun.text][0],
            container_name=header.noun.text,
        )
        for header in (each.header for each in found)
    ]


def formatted(ls: MindServer, params: types.DocumentFormattingParams) -> list[types.TextEdit]:
    path = ls.session.path(params.text_document.uri)
    splices = format_splices(ls.session.source(path), "stop" if are_breakpoints(path) else "line")
    return [ls.session.text_edit(splice) for splice in splices]


@dataclass(frozen=True, slots=True)
class Lens:
    """A word above a line, and the arguments of mindc that it stands for."""

    span: Span
    title: str
    words: tuple[str, ...]


def lenses(view: MindView, path: Path) -> list[Lens]:
    """The words above the lines `master`, `task` and `curriculum` of a file, in the order of its text.

    All of them are about the mind to which the file belongs: there are none about one that only thinks, for it has no
    world in which it could be run. A task has the skills that are taught on it.
    """
    file = view.file(path)
    if file is None or not view.main.is_file():
        return []
    found: list[Lens] = []
    for setting in file.settings:
        if isinstance(setting, Master) and path == view.main and view.names.of("task"):
            if view.names.of("curriculum"):
                found.append(Lens(setting.span, DUE_TITLE, ("train", view.main.name)))
            found += _looks(view, setting.span)
    lessons = [each for file in view.files for of in file.declarations for each in of_form(of.facts, Teaches)]
    for header in (declaration.header for declaration in file.declarations):
        name = header.name.text
        match header.noun.text:
            case "task":
                skills = dict.fromkeys(lesson.skill.text for lesson in lessons if lesson.task.text == name)
                found += [Lens(header.span, f"Train {skill}", ("train", view.main.name, skill)) for skill in skills]
                found += _looks(view, header.span, "--task", name)
            case "curriculum":
                found.append(Lens(header.span, DUE_TITLE, ("train", view.main.name, "--curriculum", name)))
    return sorted(found, key=lambda lens: lens.span.start)


def _looks(view: MindView, span: Span, *more: str) -> Iterator[Lens]:
    return (Lens(span, title, (command, view.main.name, *more)) for title, command in LOOKING_COMMANDS.items())


QUESTIONS = (
    (types.TEXT_DOCUMENT_HOVER, hovered),
    (types.TEXT_DOCUMENT_COMPLETION, completed, types.CompletionOptions(trigger_characters=[" ", '"'])),
    (types.TEXT_DOCUMENT_DEFINITION, defined),
    (types.TEXT_DOCUMENT_REFERENCES, referred),
    (types.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT, highlighted),
    (types.TEXT_DOCUMENT_DOCUMENT_SYMBOL, outlined),
    (types.WORKSPACE_SYMBOL, searched),
    (types.TEXT_DOCUMENT_FORMATTING, formatted),
    (types.TEXT_DOCUMENT_CODE_LENS, asked_above, types.CodeLensOptions()),
)


MAX_SYMBOLS = 500  # that are found
CACHED_FILES = 1000  # files whose declarations are remembered


def definitions(view: MindView, path: Path, offset: int) -> list[Span]:
    """The places of the declaration of what stands at an offset; of a used file or a procedure, where it stands."""
    file = view.file(path)
    if file is None:
        return []
    if mention := view.mention_at(path, offset):
        return [found.name.span for found in _introduced(view, mention)]
    for use in of_form(file.settings, Use):
        if use.span.start <= offset <= use.span.end:
            return _start_of(use.span.source.folder / use.path)
    return _procedure(file, offset)


def references(workspace: Workspace, view: MindView, path: Path, offset: int, with_declaration: bool) -> list[Span]:
    """The places of a name in the files of the mind and in those of the minds that share them."""
    mention = view.mention_at(path, offset)
    if mention is None:
        return []
    views = (view, *workspace.sharing(view))
    places = {(span.source.path, span.start): span for each in reversed(views) for span in _places(each, mention)}
    if not with_declaration:
        for declared in _introduced(view, mention):
            places.pop((declared.name.span.source.path, declared.name.span.start), None)
    return sorted(places.values(), key=lambda span: (span.source.path != path, span.source.path, span.start))


def highlights(view: MindView, path: Path, offset: int) -> list[Span]:
    """The places of a name in its own file."""
    mention = view.mention_at(path, offset)
    return [span for span in _places(view, mention) if span.source.path == path] if mention else []


def _introduced(view: MindView, mention: Mention) -> Iterable[Mention]:
    """The places where a name is declared; of a thing in the task that names it, if that contains it."""
    same = [m for m in introductions(view.files) if (m.noun, m.name.text) == (mention.noun, mention.name.text)]
    return [m for m in same if m.noun == "thing" and m.by is mention.by] or same


def _places(view: MindView, mention: Mention) -> Iterator[Span]:
    return (m.name.span for m in view.mentions if (m.noun, m.name.text) == (mention.noun, mention.name.text))


def _start_of(path: Path) -> list[Span]:
    try:
        found = path.resolve()
        return [Span(Source(str(found), "", found.parent), 0, 0)] if found.is_file() else []
    except (OSError, RuntimeError, ValueError):  # a loop of links, a name too long
        return []


def _procedure(file: File, offset: int) -> list[Span]:
    """The function of a procedure in the text of its module, which is not run."""
    match path_to(file.declarations, offset):
        case [*_, Phrase(kind=Name(text="procedure")), Argument(value=Name(text=name)), Name()]:
            module, _, function = name.rpartition(".")
            path = file.source.folder.joinpath(*module.split(".")).with_suffix(".py")
            text = readable_text(path)
            found = re.search(rf"^(?:async )?def (?P<name>{re.escape(function)})\b", text, re.MULTILINE)
            source = Source(str(path), text, path.parent)
            return [Span(source, *found.span("name"))] if found else _start_of(path)
    return []


def matching_declarations(workspace: Workspace, folders: Iterable[Path], query: str) -> list[Declaration]:
    """Those whose names hold the letters of a query in their order, by file."""
    paths = dict.fromkeys(chain(workspace.texts, (path for folder in folders for path in files_below(folder))))
    files = within_read_limits((path, workspace.text(path)) for path in paths)
    letters = re.compile(".*".join(map(re.escape, query)), re.IGNORECASE)
    declared = chain.from_iterable(starmap(_declared, files))
    return list(islice((each for each in declared if letters.search(each.header.name.text)), MAX_SYMBOLS))


@lru_cache(CACHED_FILES)
def _declared(path: Path, text: str) -> tuple[Declaration, ...]:
    return parse(Source(str(path), text, path.parent), Findings()).declarations
