"""What may be written at a place: told by the words of its line before it, and by the declaration above."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from mindrun.sim.outside import making

from mindlang.compiler.syntax import NOUNS, SETTINGS
from mindlang.editing.insertion import OWNERS
from mindlang.explaining.words import language_words
from mindlang.files import files_below
from mindlang.server.facts import FACTS, CursorLine
from mindlang.server.offers import Offer, arguments_of, functions, kinds_of, names, words
from mindlang.server.stops import stop_offers
from mindlang.server.workspace import MindView, are_breakpoints, declaration_at

MAX_OFFERED_FILES = 200  # that are offered

_PARTIAL = re.compile(r"(?:[A-Z]\w*(?:\+(?:[A-Z]\w*)?)*|[a-z_]\w*(?:\.\w*)*)?\Z")
_PIECE = re.compile(r'"[^"]*"|[A-Za-z_][\w.]*(?:\+[A-Z]\w*)*|[0-9./]+|%|[<>]=?|\S')
_PATH = re.compile(r'\s*use\s+"(?P<path>[^"]*)\Z')


@dataclass(frozen=True, slots=True)
class Completion:
    """What may be written instead of the text from offset `start` up to the cursor."""

    start: int
    offers: tuple[Offer, ...]


def complete(view: MindView, path: Path, text: str, offset: int) -> Completion:
    """What may be written at an offset of a file; `text` is what the file says now."""
    before = text[text.rfind("\n", 0, offset) + 1 : offset]
    if begun := _PATH.match(before):
        return Completion(offset - len(begun["path"]), tuple(_paths(path)))
    file = view.file(path)
    if not (file or are_breakpoints(path)) or "#" in re.sub(r'"[^"]*"', "", before):
        return Completion(offset, ())
    partial = _PARTIAL.search(before)
    length = len(partial[0]) if partial else 0
    code = before[: len(before) - length]
    if code and code[-1].isalnum():  # inside a number: nothing can be added to it
        return Completion(offset, ())
    if file is None:
        return Completion(offset - length, tuple(stop_offers(view, _PIECE.findall(code))))
    line = CursorLine(view, path.parent, _PIECE.findall(code), declaration_at(file, offset - len(before) - 1), offset)
    return Completion(offset - length, tuple(_offers(line)))


def _offers(line: CursorLine) -> list[Offer]:
    match line.words:
        case []:
            return _openings(line)
        case [noun, *rest] if noun in NOUNS:
            return _header(line, noun, rest)
        case [verb, *rest]:
            return FACTS[verb](line, rest) if verb in FACTS else []
    return []


def _openings(line: CursorLine) -> list[Offer]:
    """The verbs that fit the declaration above, then what else begins a line."""
    return [*words(*OWNERS.get(line.noun, ())), *words(*NOUNS, *SETTINGS)]


def _header(line: CursorLine, noun: str, rest: Sequence[str]) -> list[Offer]:
    match rest:
        case []:
            return []
        case [_]:
            return words("in", "is") if noun == "task" else words("is")
        case [own, "is", "like"]:
            return names(line.view, noun, but=[own])
        case [_, "in"]:
            return [*names(line.view, "scene"), *kinds_of(noun)]
        case [_, "is"] if noun == "task":
            return [Offer("like", "word", text=language_words()["is like"].summary)]
        case [_, "is"] if noun in ("skill", "scene"):
            return [*kinds_of(noun), Offer("like", "word", text=language_words()["is like"].summary)]
        case [_, "is" | "in"]:
            return kinds_of(noun)
        case [_, "is" | "in", "gymnasium"]:
            return [Offer(name, "environment") for name in making.registered()]
        case [_, "is" | "in", "gymnasium", *_]:
            return []
        case [_, "is" | "in", "procedure", "from"] if noun == "skill":
            return [Offer(name, "function") for name in functions(line.folder)]
        case [_, "is" | "in", kind, *said]:
            return arguments_of(line.view, noun, kind, said, None)
    return []


def _paths(path: Path) -> list[Offer]:
    """The files that a file can use: those beside it and below."""
    found = (other for other in files_below(path.parent) if other != path)
    return [Offer(other.relative_to(path.parent).as_posix(), "file") for other in islice(found, MAX_OFFERED_FILES)]
