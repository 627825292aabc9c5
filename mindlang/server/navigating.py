"""From a name to where it is declared, to where else it stands, and what a file declares."""

import re
from collections.abc import Iterable, Iterator
from functools import lru_cache
from itertools import chain, islice, starmap
from pathlib import Path

from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.parse import parse
from mindlang.compiler.references import Mention, introductions
from mindlang.compiler.source import Source, Span
from mindlang.compiler.syntax import Argument, Declaration, File, Name, Phrase, Use, of_form
from mindlang.files import files_below, readable_text, within_read_limits
from mindlang.server.places import path_to
from mindlang.server.workspace import MindView, Workspace

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
