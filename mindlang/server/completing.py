"""Completions at a place, found by the words of its line before it and by the declaration above."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import islice, takewhile
from pathlib import Path

from mindrun.kinds.registry import kinds
from mindrun.sim.outside import making

from mindlang.breakpoints.breakpoint import FAULT, OF, ROBOT_WORDS
from mindlang.compiler.references import DRIVABLE_NOUNS, READABLE_NOUNS
from mindlang.compiler.syntax import NOUNS, SETTINGS, Declaration, Drives, Influences, Reads
from mindlang.editing.insertion import OWNERS
from mindlang.explaining.words import language_words
from mindlang.files import files_below
from mindlang.server.offers import (
    NUMBER,
    Offer,
    arguments_of,
    awaits_value,
    condition_words,
    functions,
    inputs_of,
    is_term_over,
    keys,
    kinds_of,
    names,
    numbers,
    takes_value,
    term_offers,
    units,
    units_of,
    values,
    varying_parts,
    words,
    written_arguments,
)
from mindlang.server.workspace import MindView, are_breakpoints, declaration_at, on_line

MAX_OFFERED_FILES = 200  # that are offered
EDGE_JOINTS = ("at", "when", "otherwise", "cuts")
STOP_JOINTS = ("when", "and", "or")
SIGNS = ("+", "-")

_PARTIAL = re.compile(r"(?:[A-Z]\w*(?:\+(?:[A-Z]\w*)?)*|[a-z_]\w*(?:\.\w*)*)?\Z")
_PIECE = re.compile(r'"[^"]*"|[A-Za-z_][\w.]*(?:\+[A-Z]\w*)*|[0-9./]+|%|[<>]=?|\S')
_PATH = re.compile(r'\s*use\s+"(?P<path>[^"]*)\Z')

# The words of a line, and what may follow where these alone decide it. Of the words `_` is any, `#` a number, and `…`
# any number of them; what follows is said as it is, with `_` for a blank, or by its sort.
PLACES = {
    "master": "names:skill",
    "tick #": "unit:s",
    "stays": "frozen",
    "contains _": "is",
    "contains _ is": "kinds:content",
    "lasts #": "unit:ticks unit:s",
    "(ends|succeeds)": "on when",
    "(ends on|succeeds on|counts|ends on #|succeeds on #)": "kinds:event",
    "(ends on|succeeds on|counts|ends on #|succeeds on #) its": "end",
    "rewards … on its": "end",
    "rewards … its": "reward",
    "rewards … per": "bare:tick",
    "rewards … for": "each",
    "rewards … each": "",
    "rewards … each _": "in",
    "rewards … each _ in": "names:sensor names:memory",
    "rewards … each _ in _": "when",
    "rewards … per tick": "for_each when",
    "rewards … on": "kinds:event",
    "teaches": "names:skill",
    "teaches _": "on",
    "teaches _ on": "names:task",
    "teaches _ on _": "for under",
    "teaches _ on _ under": "names:skill",
    "teaches _ on _ under _": "for",
    "LESSON": "",
    "LESSON _": "unit:generations",
    "LESSON … from": "scratch names:skill",
    "LESSON … with": "subskills",
    "LESSON … needs": "score success",
    "LESSON … using": "kinds:curriculum",
    "starts": "at facing",
    "starts … facing": "names:number",
    "starts at": "names:number",
    "starts at _": "names:number",
    "starts … facing _": "unit:deg",
    "starts at _ _": "facing",
    "varies _": "of",
    "fails": "names:actuator",
    "fails _": "names:number",
    "fails … per": "unit:s bare:tick",
    "fails _ … %": "per",
    "fails _ _": "unit:% per",
}
PATTERNS = {"LESSON": "teaches _ on _( under _)? for", "… ": r"(\S.* )?", "_": r"\S+", "#": r"[0-9]\S*"}


@dataclass(frozen=True, slots=True)
class CursorLine:
    """The words before a place in its line, and the declaration to which the line belongs."""

    view: MindView
    folder: Path
    words: Sequence[str]
    above: Declaration | None
    offset: int

    @property
    def noun(self) -> str:
        """The noun of the declaration above."""
        return self.above.header.noun.text if self.above else ""

    def names_after(self, *forms: type[Reads | Drives | Influences]) -> set[str]:
        """The names behind these verbs on the other lines of the declaration above."""
        facts = [fact for fact in (self.above.facts if self.above else ()) if isinstance(fact, forms)]
        return {fact.name.text for fact in facts if not on_line(fact.span, self.offset)}


@dataclass(frozen=True, slots=True)
class Completion:
    """The texts that may replace the one from offset `start` up to the cursor."""

    start: int
    offers: tuple[Offer, ...]


def complete(view: MindView, path: Path, text: str, offset: int) -> Completion:
    """The completions at an offset of a file; `text` is what the file says now."""
    before = text[text.rfind("\n", 0, offset) + 1 : offset]
    if begun := _PATH.match(before):
        beside = (other.relative_to(path.parent) for other in files_below(path.parent) if other != path)
        files = (Offer(other.as_posix(), "file") for other in islice(beside, MAX_OFFERED_FILES))
        return Completion(offset - len(begun["path"]), tuple(files))
    file = view.file(path)
    if not (file or are_breakpoints(path)) or "#" in re.sub(r'"[^"]*"', "", before):
        return Completion(offset, ())
    partial = _PARTIAL.search(before)
    length = len(partial[0]) if partial else 0
    code = before[: len(before) - length]
    if code and code[-1].isalnum():  # inside a number: nothing can be added to it
        return Completion(offset, ())
    pieces = _PIECE.findall(code)
    if file is None:
        return Completion(offset - length, tuple(_stop(view, pieces)))
    line = CursorLine(view, path.parent, pieces, declaration_at(file, offset - len(before) - 1), offset)
    return Completion(offset - length, tuple(_offers(line)))


def _offers(line: CursorLine) -> list[Offer]:
    match line.words:
        case []:  # the verbs that fit the declaration above, then what else begins a line
            return [*words(*OWNERS.get(line.noun, ())), *words(*NOUNS, *SETTINGS)]
        case [noun, *rest] if noun in NOUNS:
            return _header(line, noun, rest)
        case ["rewards" | "ends" | "succeeds", *rest] if "when" in rest:
            said = rest[rest.index("when") :]
            return [*term_offers(line.view, line.above, said), *condition_words(said)]
        case [verb, *rest]:
            unsigned = [word for word in line.words if word not in SIGNS or verb not in ("starts", "varies")]
            told = next((said for pattern, said in _places() if pattern.fullmatch(" ".join(unsigned))), None)
            return _fact(line, verb, rest) if told is None else _told(line.view, told)
    return []


@cache
def _places() -> list[tuple[re.Pattern[str], str]]:
    found = []
    for pattern, said in PLACES.items():
        for sign, meaning in PATTERNS.items():
            pattern = pattern.replace(sign, meaning)
        found.append((re.compile(pattern), said))
    return found


def _told(view: MindView, said: str) -> list[Offer]:
    """The offers that a place of the table has."""
    found: list[Offer] = []
    for each in said.split():
        match each.split(":"):
            case ["names", "number"]:
                found += numbers(view)
            case ["names", noun]:
                found += names(view, noun)
            case ["kinds", noun]:
                found += kinds_of(noun)
            case ["unit", unit]:
                found += units(unit)
            case ["bare", word]:
                found.append(Offer(word, "word"))
            case [word]:
                found += words(word.replace("_", " "))
    return found


def _header(line: CursorLine, noun: str, rest: Sequence[str]) -> list[Offer]:
    like = Offer("like", "word", text=language_words()["is like"].summary)
    match rest:
        case []:
            return []
        case [_]:
            return words("in", "is") if noun == "task" else words("is")
        case [own, "is", "like"]:
            return names(line.view, noun, but=[own])
        case [_, "in"]:
            return [*names(line.view, "scene"), *kinds_of(noun)]
        case [_, "is"]:
            kinds_known = kinds_of(noun) if noun != "task" else []
            return [*kinds_known, *([like] if noun in ("task", "skill", "scene") else [])]
        case [_, "in", "gymnasium", *more] | [_, "is", "gymnasium", *more]:
            return [] if more else [Offer(name, "environment") for name in making.registered()]
        case [_, "is" | "in", "procedure", "from"] if noun == "skill":
            return [Offer(name, "function") for name in functions(line.folder)]
        case [_, "is" | "in", kind, *said]:
            return arguments_of(line.view, noun, kind, said, None)
    return []


def _fact(line: CursorLine, verb: str, rest: Sequence[str]) -> list[Offer]:
    """Offers where more than the words decides: what is declared, what a kind takes, where a value ends."""
    match verb:
        case "reads":
            return _reads(line, rest)
        case "drives" | "influences":
            return _edge(line, rest, *(["cuts below"] if verb == "influences" else []))
        case "contains" if len(rest) > 2 and rest[1] == "is":
            return arguments_of(line.view, "content", rest[2], rest[3:], line.above)
        case "ends" | "succeeds" if rest[0] == "on":
            kind, *said = rest[2:] if len(rest) > 1 and rest[1][0] in NUMBER else rest[1:]
            return arguments_of(line.view, "event", kind, said, line.above)
        case "counts":
            return arguments_of(line.view, "event", rest[0], rest[1:], line.above)
        case "rewards":
            return _reward(line, rest)
        case "teaches" if "for" in rest[3:6]:
            return _lesson(line, rest[rest.index("for", 3) + 1 :])
        case "varies":
            return _varies(line, [word for word in rest if word not in SIGNS])
    return []


def _reads(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    like = line.above.header.like if line.above else None
    match rest:
        case []:
            return names(line.view, *READABLE_NOUNS, but=line.names_after(Reads))
        case [_] if like:
            return words("for")
        case [_, "for"] if like:
            inputs = inputs_of(line.view, like.text)
            return [offer for offer in names(line.view, *READABLE_NOUNS) if offer.label in inputs]
    return []


def _edge(line: CursorLine, rest: Sequence[str], *last: str) -> list[Offer]:
    """Behind `drives` or `influences`: a name, its value, its condition, what is sent otherwise, what comes `last`."""
    if not rest and last:
        own = {line.above.header.name.text} if line.above else set()
        return names(line.view, "skill", but=own | line.names_after(Influences))
    if not rest:
        return names(line.view, *DRIVABLE_NOUNS, but=line.names_after(Drives))
    joint = max((place for place, word in enumerate(rest) if word in EDGE_JOINTS), default=0)
    word, said, found = rest[joint], rest[joint + 1 :], list[Offer]()
    if word == "cuts":
        is_number = said[-1:] and said[-1][0] in NUMBER
        return units("%") if is_number else numbers(line.view) if said else [Offer("below", "word")]
    if word in EDGE_JOINTS and takes_value(rest[joint:]):
        read = line.names_after(Reads)
        found = values(line.view, rest, [each for each in names(line.view, *READABLE_NOUNS) if each.label in read])
    if awaits_value(rest):
        return found
    match word:
        case "at":
            return [*found, *words("when", *last)]
        case "when":
            joints = condition_words(rest[joint:])
            return [*found, *joints, *(words("otherwise", *last) if joints else [])]
        case "otherwise":
            return [*found, *words(*last)]
    return words("at", "when", *last)


def _reward(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    if "on" in rest:
        kind, *said = rest[rest.index("on") + 1 :]
        return [*arguments_of(line.view, "event", kind, said, line.above), *words("when")]
    joints = words("per tick", "on") if rest and is_term_over(rest) else []
    return [*term_offers(line.view, line.above, rest), *joints]


def _lesson(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    """After the number of generations of a lesson: what it may say beside."""
    phrase = line.above.header.phrase if line.above else None
    learner = rest[rest.index("using") + 1] if "using" in rest else phrase.kind.text if phrase else ""
    switches = words("from scratch", "with subskills", "using", "needs")
    switches = [offer for offer in switches if offer.label.split()[0] not in rest]
    if learner not in kinds("curriculum"):
        return switches
    if written_arguments(kinds("curriculum")[learner], rest[2:]).awaits_number:
        return []
    return [*arguments_of(line.view, "curriculum", learner, rest[2:], None), *switches]


def _varies(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    varying = dict(varying_parts(line.view, line.above))
    match rest:
        case []:
            return keys({argument.key: argument for found in varying.values() for argument in found}.values())
        case [argument, "of"]:
            return [part for part, found in varying.items() if argument in (each.key for each in found)]
        case [argument, "of", part, *said]:
            of = [each for name, found in varying.items() if name.label == part for each in found]
            is_number = said and said[-1][0] in NUMBER
            own = [unit for each in of if each.key == argument and is_number for unit in units_of(each)]
            return [*own, *words("to")] if said and "to" not in said else own or numbers(line.view)
    return []


def _stop(view: MindView, line: Sequence[str]) -> list[Offer]:
    """Offers behind these words of a line of a .break file."""
    match line:
        case []:
            return words("stop")
        case ["stop"]:
            return words("on", "when", "in")
        case ["stop", "in"]:
            return words("tick")
        case ["stop", "when", *_]:
            return _stop_condition(view, line[1:])
        case ["stop", "on"] | ["stop", "on", _] if len(line) == 2 or line[2][0] in NUMBER:
            return [*kinds_of("event"), *words(*ROBOT_WORDS)]
        case ["stop", "on", *event]:
            event = event[1:] if event[0][0] in NUMBER else event
            if event == [FAULT]:
                return words(OF)
            return (
                names(view, "sensor")
                if event == [FAULT, OF]
                else arguments_of(view, "event", event[0], event[1:], None)
            )
    return []


def _stop_condition(view: MindView, rest: Sequence[str]) -> list[Offer]:
    """Behind `when`, `and` or `or`: an expression that is compared, or what a skill influences."""
    found: list[Offer] = []
    match [*takewhile(lambda word: word not in STOP_JOINTS, reversed(rest))][::-1]:
        case [skill] if skill[:1].isupper():
            return words("influences")
        case [_, "influences"]:
            return names(view, "skill", "actuator", "memory")
        case [_, "influences", _]:
            return words("above", "below")
        case [_, "influences", _, _]:
            return numbers(view)
        case [_, "influences", *said]:
            return [*([] if said[-1] == "%" else units("%")), *words("and", "or")]
        case []:
            found = names(view, "skill")
    if takes_value(rest):
        found += values(view, rest, names(view, *READABLE_NOUNS, "actuator"))
    return [*found, *condition_words(rest)]
