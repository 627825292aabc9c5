"""From a name to where it is declared, to where else it stands, and what a file declares."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import chain, islice
from pathlib import Path

from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.parse import parse
from mindlang.compiler.references import Mention, introductions
from mindlang.compiler.source import Source, Span
from mindlang.compiler.syntax import Argument, Contains, File, Name, Phrase, Use
from mindlang.files import files_below, readable_text, within_read_limits
from mindlang.server.places import path_to
from mindlang.server.workspace import MindView, Workspace

MAX_SYMBOLS = 500  # that are found
CACHED_FILES = 1000  # files whose symbols are remembered


@dataclass(frozen=True, slots=True)
class Symbol:
    """Something declared: its noun, its kind or scene, the lines about it, the name in them, and what it contains."""

    noun: str
    name: str
    kind: str
    whole: Span
    place: Span
    inner: tuple["Symbol", ...] = ()


def definitions(view: MindView, path: Path, offset: int) -> list[Span]:
    """The places of the declaration of what stands at an offset; of a used file or a procedure, where it stands."""
    file = view.file(path)
    if file is None:
        return []
    if mention := view.mention_at(path, offset):
        return [found.name.span for found in _introduced(view, mention)]
    used = (setting for setting in file.settings if isinstance(setting, Use))
    for use in used:
        if use.span.start <= offset <= use.span.end:
            return _start_of(use.span.source.folder / use.path)
    return _procedure(file, offset)


def references(workspace: Workspace, view: MindView, path: Path, offset: int, with_declaration: bool) -> list[Span]:
    """The places of a name in the files of the mind and in those of the minds that share them."""
    mention = view.mention_at(path, offset)
    if mention is None:
        return []
    views = (view, *sharing(workspace, view))
    places = {(span.source.path, span.start): span for each in reversed(views) for span in _places(each, mention)}
    if not with_declaration:
        for declared in _introduced(view, mention):
            places.pop((declared.name.span.source.path, declared.name.span.start), None)
    return sorted(places.values(), key=lambda span: (span.source.path != path, span.source.path, span.start))


def highlights(view: MindView, path: Path, offset: int) -> list[Span]:
    """The places of a name in its own file."""
    mention = view.mention_at(path, offset)
    return [span for span in _places(view, mention) if span.source.path == path] if mention else []


def sharing(workspace: Workspace, view: MindView) -> Iterator[MindView]:
    """Other minds that have one of a mind's files among their own."""
    own = set(view.paths)
    for path, text in workspace.around(*view.paths):
        if path != view.main and (path in own or 'use "' in text):
            other = workspace.mind(path)
            if not own.isdisjoint(other.paths):
                yield other


def symbols(file: File) -> list[Symbol]:
    """The declarations of a file, in its order."""
    found = []
    for declaration in file.declarations:
        header = declaration.header
        end = max([header.span, *(fact.span for fact in declaration.facts)], key=lambda span: span.end).end
        things = (fact for fact in declaration.facts if isinstance(fact, Contains))
        inner = (Symbol("thing", f.name.text, f.phrase.kind.text, f.span, f.name.span) for f in things)
        whole = Span(file.source, header.span.start, end)
        kind = header.phrase.kind.text if header.phrase else f"like {header.like.text}" if header.like else ""
        found.append(Symbol(header.noun.text, header.name.text, kind, whole, header.name.span, tuple(inner)))
    return found


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


def matching_symbols(workspace: Workspace, folders: Iterable[Path], query: str) -> list[Symbol]:
    """The declarations whose names hold the letters of a query in their order, by file."""
    paths = dict.fromkeys(chain(workspace.texts, (path for folder in folders for path in files_below(folder))))
    files = within_read_limits((path, workspace.text(path)) for path in paths)
    letters = re.compile(".*".join(map(re.escape, query)), re.IGNORECASE)
    found = (symbol for path, text in files for symbol in _declared(path, text) if letters.search(symbol.name))
    return list(islice(found, MAX_SYMBOLS))


@lru_cache(CACHED_FILES)
def _declared(path: Path, text: str) -> tuple[Symbol, ...]:
    return tuple(symbols(parse(Source(str(path), text, path.parent), Findings())))
