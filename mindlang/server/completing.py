"""What may be written at a place: told by the words of its line before it, and by the declaration above."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from mindrun.registry import kinds

from mindlang.editing.project import OWNERS
from mindlang.editing.references import DRIVEN, READ
from mindlang.server import offers, rewarding
from mindlang.server.offers import NUMBER, Offer, arguments_of, kinds_of, names, units, words
from mindlang.server.procedures import functions
from mindlang.server.view import View, declaration_at, on_line
from mindlang.syntax import NOUNS, SETTINGS, Declaration, Drives, Influences, Reads

_PARTIAL = re.compile(r"(?:[A-Z]\w*(?:\+(?:[A-Z]\w*)?)*|[a-z_]\w*(?:\.\w*)*)?\Z")
_PIECE = re.compile(r'"[^"]*"|[A-Za-z_][\w.]*(?:\+[A-Z]\w*)*|[0-9./]+|%|[<>]=?|\S')
_PATH = re.compile(r'\s*use\s+"(?P<path>[^"]*)\Z')


@dataclass(frozen=True, slots=True)
class Line:
    """What stands before a place in its line, and the declaration to which the line belongs."""

    view: View
    folder: Path
    words: Sequence[str]
    above: Declaration | None
    offset: int

    @property
    def noun(self) -> str:
        """The noun of the declaration above."""
        return self.above.header.noun.text if self.above else ""

    def said(self, *forms: type[Reads | Drives | Influences]) -> set[str]:
        """What the skill above says with these verbs on its other lines."""
        facts = [fact for fact in (self.above.facts if self.above else ()) if isinstance(fact, forms)]
        return {fact.name.text for fact in facts if not on_line(fact.span, self.offset)}


@dataclass(frozen=True, slots=True)
class Completion:
    """What may be written instead of the text from offset `start` up to the cursor."""

    start: int
    offers: tuple[Offer, ...]


def complete(view: View, path: Path, text: str, offset: int) -> Completion:
    """What may be written at an offset of a file; `text` is what the file says now."""
    before = text[text.rfind("\n", 0, offset) + 1 : offset]
    if begun := _PATH.match(before):
        return Completion(offset - len(begun["path"]), tuple(_paths(path)))
    file = view.file(path)
    if file is None or "#" in re.sub(r'"[^"]*"', "", before):
        return Completion(offset, ())
    partial = _PARTIAL.search(before)
    length = len(partial[0]) if partial else 0
    code = before[: len(before) - length]
    if code and code[-1].isalnum():  # inside a number: nothing can be added to it
        return Completion(offset, ())
    line = Line(view, path.parent, _PIECE.findall(code), declaration_at(file, offset - len(before) - 1), offset)
    return Completion(offset - length, tuple(_offers(line)))


def _offers(line: Line) -> list[Offer]:
    match line.words:
        case []:
            return _openings(line)
        case [noun, *rest] if noun in NOUNS:
            return _header(line, noun, rest)
        case [verb, *rest]:
            return _FACTS[verb](line, rest) if verb in _FACTS else []
    return []


def _openings(line: Line) -> list[Offer]:
    """The verbs that fit the declaration above, then what else begins a line."""
    return [*words(*OWNERS.get(line.noun, ())), *words(*NOUNS, *SETTINGS)]


def _header(line: Line, noun: str, rest: Sequence[str]) -> list[Offer]:
    match rest:
        case []:
            return []
        case [_]:
            return words("in" if noun == "task" else "is")
        case [_, "is" | "in"]:
            return kinds_of(noun)
        case [_, "is" | "in", "procedure", "from"] if noun == "skill":
            return [Offer(name, "function") for name in functions(line.folder)]
        case [_, "is" | "in", kind, *said]:
            return arguments_of(line.view, noun, kind, said, None)
    return []


def _reads(line: Line, rest: Sequence[str]) -> list[Offer]:
    return [] if rest else names(line.view, *READ, but=line.said(Reads))


def _drives(line: Line, rest: Sequence[str]) -> list[Offer]:
    return _at(line, rest) if rest else names(line.view, *DRIVEN, but=line.said(Drives))


def _influences(line: Line, rest: Sequence[str]) -> list[Offer]:
    own = {line.above.header.name.text} if line.above else set()
    return _at(line, rest) if rest else names(line.view, "skill", but=own | line.said(Influences))


def _at(line: Line, rest: Sequence[str]) -> list[Offer]:
    """After the name of an edge: `at`, and an expression of what the skill reads."""
    if len(rest) == 1:
        return words("at")
    if rest[-1] == "at" or rest[-1] in "+-*/(":
        read = line.said(Reads)
        return [offer for offer in names(line.view, *READ) if offer.label in read]
    return []


def _contains(line: Line, rest: Sequence[str]) -> list[Offer]:
    match rest:
        case [_]:
            return words("is")
        case [_, "is"]:
            return kinds_of("content")
        case [_, "is", kind, *said]:
            return arguments_of(line.view, "content", kind, said, line.above)
    return []


def _event(line: Line, rest: Sequence[str]) -> list[Offer]:
    return arguments_of(line.view, "event", rest[0], rest[1:], line.above) if rest else kinds_of("event")


def _ends(line: Line, rest: Sequence[str]) -> list[Offer]:
    return _event(line, rest[1:]) if rest else words("on")


def _rewards(line: Line, rest: Sequence[str]) -> list[Offer]:
    return rewarding.offered(line.view, line.above, rest)


def _teaches(line: Line, rest: Sequence[str]) -> list[Offer]:
    match rest:
        case []:
            return names(line.view, "skill")
        case [_]:
            return words("on")
        case [_, "on"]:
            return names(line.view, "task")
        case [_, "on", _]:
            return words("for", "under")
        case [_, "on", _, "under"]:
            return names(line.view, "skill")
        case [_, "on", _, "under", _]:
            return words("for")
        case [_, "on", _, "for", *said] | [_, "on", _, "under", _, "for", *said]:
            return _lesson(line, said)
    return []


def _lesson(line: Line, rest: Sequence[str]) -> list[Offer]:
    """After `for`: a number of generations, and then what a lesson may say beside."""
    match rest:
        case []:
            return []
        case [_]:
            return units("generations")
        case [*_, "from"]:
            return [Offer("scratch", "word")]
        case [*_, "with"]:
            return [Offer("subskills", "word")]
    phrase = line.above.header.phrase if line.above else None
    switches = [offer for offer in words("from scratch", "with subskills") if offer.label.split()[0] not in rest]
    if phrase is None or phrase.kind.text not in kinds("curriculum"):
        return switches
    found = arguments_of(line.view, "curriculum", phrase.kind.text, rest[2:], None)
    waits = offers.said(kinds("curriculum")[phrase.kind.text], rest[2:]).awaits_number
    return [] if waits else [*found, *switches]


def _number(*of: str) -> Callable[[Line, Sequence[str]], list[Offer]]:
    """After a number, its units."""
    return lambda line, rest: units(*of) if len(rest) == 1 and rest[0][0] in NUMBER else []


def _paths(path: Path) -> list[Offer]:
    """The files that a file can use: those beside it and below."""
    found = sorted(other for other in path.parent.rglob("*.mind") if other != path) if path.parent.is_dir() else []
    return [Offer(other.relative_to(path.parent).as_posix(), "file") for other in found[:200]]


_FACTS: Mapping[str, Callable[[Line, Sequence[str]], list[Offer]]] = {
    "reads": _reads,
    "drives": _drives,
    "influences": _influences,
    "stays": lambda line, rest: [] if rest else words("frozen"),
    "contains": _contains,
    "lasts": _number("ticks", "s"),
    "ends": _ends,
    "rewards": _rewards,
    "counts": _event,
    "teaches": _teaches,
    "master": lambda line, rest: [] if rest else names(line.view, "skill"),
    "tick": _number("s"),
}
