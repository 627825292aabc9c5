"""Completions at a place: what the grammar takes behind the words before it, as far as it means something there.

A name is put there to try it, and the line ended as soon as it may be: then the syntax tree says of what it would be
the name.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import islice
from pathlib import Path
from typing import Any

from lark import UnexpectedInput
from lark.lexer import PatternStr
from mindrun.kinds import registry
from mindrun.kinds.registry import find_kind, kinds, named_arguments
from mindrun.kinds.things.thing import ROBOT
from mindrun.numbers.quantity import FUNCTION, Reference
from mindrun.sim.outside import making

from mindlang.breakpoints.breakpoint import FAULT, OF, ROBOT_WORDS
from mindlang.compiler import syntax
from mindlang.compiler.families import letter_in
from mindlang.compiler.names import names_in
from mindlang.compiler.parse.shape import Start, grammar, parse_line
from mindlang.compiler.resolve.curricula import MEASURED, SWITCHES, USING
from mindlang.compiler.resolve.kinds import about
from mindlang.compiler.resolve.layouts import HARD
from mindlang.compiler.source import Source
from mindlang.compiler.syntax import Amount, Declaration, Header, Phrase, Teaches
from mindlang.files import files_below
from mindlang.server import offers
from mindlang.server.offers import Offer
from mindlang.server.places import declaration_at, noun_of_kind, on_line, path_to, said_argument
from mindlang.server.workspace import MindView, are_breakpoints

MAX_OFFERED_FILES = 200  # that are offered
MAX_READ_CHARACTERS = 2000  # of a line before the cursor: it is read again with each word that is tried there
MAX_ADDED = 12  # words with which a line is ended
# With what a line is ended, by the sort of the word: the first of them that the grammar takes.
ENDINGS = {
    "RPAR": ")", "COMPARE": ">", "ON": "on", "FOR": "for", "TO": "to", "PER": "per", "TICK": "tick", "LEVEL": "above",
    "BELOW": "below", "IN": "in", "IS": "is", "LIKE": "like", "OF": "of", "INFLUENCES": "influences", "NUMBER": "1",
    "NAME": "x", "TITLE": "X", "AT": "at", "MOST": "most",
}  # fmt: skip
TRIED = {"NAME": "tried", "TITLE": "Tried"}  # names that are put where the grammar takes one
# Words that the grammar takes in more lines than they mean something in: those lines, and how the word is offered.
WORDS: Mapping[str, Mapping[str, str]] = {
    "per": {"rewards": "per tick", "fails": "per"},
    "for": {"rewards": "for each", "teaches": "for", "reads": "for", "drives": "for", "influences": "for"},
    "like": {"skill": "like", "task": "like", "scene": "like"},
    "to": {"draws": "to", "varies": "to"},
    "tick": {"rewards": "tick", "fails": "tick", "stop": "tick"},
    "facing": {"starts": "facing"},
    "cuts": {"influences": "cuts below"},
    "over": {"influences": "over"},
    "by": {},
    "from": {},
    "computed": {},
}
UNITS: dict[type, tuple[str, ...]] = {
    syntax.Tick: ("s",),
    syntax.Lasts: ("ticks", "s"),
    syntax.Teaches: ("generations",),
    syntax.Fails: ("%",),
    syntax.Influences: ("%",),
    syntax.Transmits: ("%",),
    syntax.Within: ("s", "ticks"),
}  # of an amount that is said by itself


@dataclass(frozen=True, slots=True)
class CursorLine:
    """The text of a line before a place, and the declaration to which the line belongs."""

    view: MindView
    folder: Path
    code: str
    above: Declaration | None
    offset: int
    start: Start

    @property
    def first(self) -> str:
        return self.code.split()[0]

    @property
    def owner(self) -> Declaration | None:
        return None if self.first in syntax.NOUNS else self.above

    def said(self, form: type[syntax.Reads | syntax.Sends]) -> set[str]:
        facts = syntax.of_form(self.above.facts, form) if self.above else []
        return {fact.name.text for fact in facts if not on_line(fact.span, self.offset)}

    def tried(self, word: str) -> list[Any]:
        """The nodes of the line that hold a word put here, from the whole line down; none where it cannot be read."""
        line = _ended(f"{self.code}{word}", self.start)
        return path_to([line], len(self.code)) if line else []


@dataclass(frozen=True, slots=True)
class Completion:
    """The texts that may replace the one from offset `start` up to the cursor."""

    start: int
    offers: tuple[Offer, ...]


_PARTIAL = re.compile(r"(?:[A-Z]\w*(?:\+(?:[A-Z]\w*)?)*|[a-z_]\w*(?:\.\w*)*)?\Z")
_PATH = re.compile(r'\s*use\s+"(?P<path>[^"]*)\Z')


def complete(view: MindView, path: Path, text: str, offset: int) -> Completion:
    """The completions at an offset of a file; `text` is what the file says now."""
    before = text[text.rfind("\n", 0, offset) + 1 : offset]
    if begun := _PATH.match(before):
        beside = (other.relative_to(path.parent) for other in files_below(path.parent) if other != path)
        files = (Offer(other.as_posix(), "file") for other in islice(beside, MAX_OFFERED_FILES))
        return Completion(offset - len(begun["path"]), tuple(files))
    file = view.file(path)
    is_long = len(before) > MAX_READ_CHARACTERS
    if is_long or not (file or are_breakpoints(path)) or "#" in re.sub(r'"[^"]*"', "", before):
        return Completion(offset, ())
    partial = _PARTIAL.search(before)
    length = len(partial[0]) if partial else 0
    code = before[: len(before) - length]
    if code and code[-1].isalnum():  # inside a number: nothing can be added to it
        return Completion(offset, ())
    above = declaration_at(file, offset - len(before) - 1) if file else None
    line = CursorLine(view, path.parent, code, above, offset, "line" if file else "stop")
    return Completion(offset - length, tuple(dict.fromkeys(_offers(line))))


def _offers(line: CursorLine) -> Iterator[Offer]:
    match line.code.split():
        case [] if line.start == "stop":
            yield from offers.words("stop")
        case []:  # the verbs that fit the declaration above, then what else begins a line
            own = syntax.VERBS_OF.get(line.above.header.noun.text, ()) if line.above else ()
            yield from offers.words(*own, *syntax.NOUNS, *syntax.SETTINGS)
        case [*_, "least" | "greatest"]:
            yield Offer("of", "word")
        case [first, *rest, "its"]:
            yield from offers.words("reward" if first == "rewards" and "on" not in rest else "end")
        case _:
            yield from _behind_words(line, _accepted(line.code, line.start))


def _behind_words(line: CursorLine, accepted: set[str]) -> Iterator[Offer]:
    ended = line.code.rstrip()
    read = _ended(ended, line.start)
    last = path_to([read], len(ended)) if read else []
    if "UNIT" in accepted:
        yield from _units(line, last)
    yield from _range_words(line, last, len(ended))
    for word in (word for sort, word in TRIED.items() if sort in accepted):
        nodes = line.tried(word)
        yield from [*_kinds(line, nodes), *_arguments(line, nodes), *_names(line, nodes)]
    if "ENVIRONMENT" in accepted:
        yield from (Offer(name, "environment") for name in making.registered())
    yield from _words(line, accepted)


@cache
def _literals() -> dict[str, tuple[str, ...]]:
    patterns = {each.name: each.pattern for each in grammar().terminals}
    plain = {name: (each.value,) for name, each in patterns.items() if isinstance(each, PatternStr)}
    spelled = {name: said for name, said in plain.items() if said[0].isalpha()}
    return {**spelled, "LEVEL": ("above", "below"), "EXTREME": ("least of", "greatest of")}


def _accepted(code: str, start: Start) -> set[str]:
    """The sorts of word that the grammar takes behind a text; none where it cannot read that."""
    parser = grammar().parse_interactive(code, start=start)
    try:
        parser.exhaust_lexer()
    except UnexpectedInput:
        return set()
    found: set[str] = parser.accepts()  # type: ignore[no-untyped-call]
    return found


def _ended(code: str, start: Start) -> Any:
    """A line that begins with a text, and ends as soon as it may; None where that cannot be read."""
    for _ in range(MAX_ADDED):
        accepted = _accepted(code, start)
        if "$END" in accepted:
            return parse_line(code, Source("line", code), 0, start)
        following = next((word for sort, word in ENDINGS.items() if sort in accepted), None)
        if following is None:
            return None
        code = f"{code} {following}"
    return None


def _units(line: CursorLine, last: Sequence[Any]) -> Iterator[Offer]:
    """The units of the number behind which the line ends."""
    said = said_argument(last, line.above)
    if said and said.meaning:
        yield from offers.units_of(said.meaning)
    match last:
        case _ if line.code.split()[-1] == "per":
            yield from offers.units("s")
        case [syntax.Varies() as fact, Amount()]:
            argument = offers.varied(line.view, line.above, fact)
            yield from offers.units_of(argument) if argument else ()
        case [syntax.Starts(facing=facing), Amount() as amount] if amount is facing:
            yield from offers.units("deg")
        case [*_, parent, Amount()]:
            yield from offers.units(*UNITS.get(type(parent), ()))


def _range_words(line: CursorLine, last: Sequence[Any], end: int) -> Iterator[Offer]:
    """The words of a range behind a number that may be one."""
    said = said_argument(last, line.above)
    if said and said.meaning and said.meaning.shape in ("span", "list") and said.argument.span.end == end:
        match said.argument.value:
            case syntax.Numbers((_,)):
                yield Offer("to", "word")
            case syntax.Range(by=None):
                # The size of what moves when it is reached may be a schedule, `3 to 1 by 0.1`.
                keys = {each.key for each in named_arguments(kinds(said.noun)[said.kind])}
                if said.meaning.shape == "list" or (said.argument.key.text == "size" and "reached" in keys):
                    yield Offer("by", "word")
    if said and said.noun == "sensor" and said.argument.span.end == end:
        yield from offers.words("or") if said.meaning and said.meaning.type == Reference("thing") else ()


def _kinds(line: CursorLine, nodes: Sequence[Any]) -> Iterator[Offer]:
    """The kinds of which the tried word may be one; in an expression those of measures, where a task measures."""
    match nodes:
        case [*_, above, Phrase(kind=kind), name] if kind is name:
            noun = noun_of_kind(above)
            if noun != "measure" or isinstance(nodes[0], syntax.Rewards | syntax.Outcome):
                yield from offers.kinds_of(noun)
            if noun == "event" and line.start == "stop":
                yield from offers.words(*ROBOT_WORDS)


def _arguments(line: CursorLine, nodes: Sequence[Any]) -> Iterator[Offer]:
    """The arguments of which the tried word may be the key, or what it may be as the value of one."""
    said = said_argument(nodes, line.above)
    if said is None:
        return
    is_lesson = isinstance(nodes[0], Teaches) and said.noun == "curriculum"
    written = {each.key.text for each in said.beside}
    match said.argument.key.text, said.meaning:
        case key, _ if said.argument.key is nodes[-1]:
            cls = kinds(said.noun).get(said.kind)
            yield from offers.keys(each for each in named_arguments(cls) if each.key not in written) if cls else ()
            if is_lesson:
                switches = {**{key: f"{key} {word}" for key, (word, _) in SWITCHES.items()}, USING: USING, HARD: HARD}
                yield from offers.words(*(label for key, label in switches.items() if key not in written))
            if said.kind == FAULT or (is_lesson and HARD in written):
                yield from offers.words(OF)
        case key, None if is_lesson and key in SWITCHES:
            yield from offers.words(SWITCHES[key][0])
        case "using", None if is_lesson:
            yield from offers.kinds_of("curriculum")
        case "of", None if said.kind == FAULT:
            yield from offers.names(line.view, "sensor")
        case key, registry.Argument(type=Reference(noun="thing")):
            yield from offers.words(*[ROBOT] * (said.noun == "content"))
            yield from offers.things(line.view, _task(line, nodes[0]), about(said.noun, said.kind, key))
            if getattr(find_kind(said.noun, said.kind), "can_be_reckoned", False):
                yield from offers.places(line.view)
        case _, registry.Argument(type=Reference(noun="servo")):
            yield from offers.names(line.view, "actuator")
        case _, registry.Argument(type=meaning) if meaning == FUNCTION:
            yield from (Offer(name, "function") for name in offers.functions(line.folder))
        case _, registry.Argument(type=Reference(words=allowed)):
            yield from (Offer(word, "word") for word in allowed)


def _task(line: CursorLine, fact: Any) -> Declaration | None:
    if isinstance(fact, Teaches):
        return dict(line.view.whole.declarations("task")).get(fact.task.text)
    return line.owner


def _names(line: CursorLine, nodes: Sequence[Any]) -> Iterator[Offer]:
    """The declared names of which the tried word may be one, and names that the language gives."""
    nouns: Sequence[str] = ()
    match nodes:
        case [*_, Amount()]:
            nouns = ("number", *(["draw"] if isinstance(nodes[0], syntax.Contains) else []))
        case [syntax.Stays(), _]:
            yield from offers.words("frozen")
        case [syntax.Chooses(), _]:
            yield from offers.words("one")
        case [*_, syntax.Needs(), _]:
            yield from offers.words(*MEASURED)
        case [syntax.Varies() as fact, name]:
            varying = dict(offers.varying_parts(line.view, line.above))
            if name is fact.argument:
                yield from offers.keys({each.key: each for found in varying.values() for each in found}.values())
            else:
                argument = fact.argument.text
                yield from (part for part, found in varying.items() if argument in {each.key for each in found})
        case [*_, syntax.Transmits(skill), name]:
            nouns = ("skill",) if name is skill else ("skill", "actuator", "memory")
        case [read, *_, name]:
            nouns = next((nouns for found, nouns in names_in(read) if found is name), ())
    yield from _sayable(line, nodes, offers.names(line.view, *nouns))


def _sayable(line: CursorLine, nodes: Sequence[Any], known: list[Offer]) -> list[Offer]:
    """Those of the declared names that mean something in the place of the tried word."""
    own = line.above.header if line.above else None
    match nodes[0] if nodes else None:
        case Header(name=name):
            return [each for each in known if each.sort not in ("actuator", "draw") and each.label != name.text]
        case syntax.Contains():
            return [each for each in known if each.sort in ("number", "draw")]
        case syntax.Reads() | syntax.Sends() as fact if fact.stands_for is nodes[-1]:
            replaceable = offers.said_of(line.view, own.like.text, type(fact)) if own and own.like else ()
            return [each for each in known if each.label in replaceable]
        case syntax.Reads() | syntax.Sends() as fact if fact.name is nodes[-1]:
            but = line.said(type(fact)) | ({own.name.text} if own else set())
            return [each for each in known if each.label not in but]
        case syntax.Influences(over=over) if over and nodes[-1] in over:
            said = {each.text for each in over}
            return [each for each in known if each.label not in said]
        case syntax.Sends():
            read = line.said(syntax.Reads)
            return [each for each in known if each.sort == "number" or each.label in read]
        case syntax.Fails():
            return [each for each in known if each.sort != "sensor"]
    return known


def _words(line: CursorLine, accepted: set[str]) -> Iterator[Offer]:
    is_like = bool(line.above and line.above.header.like)
    keys_too = {"AT", "ALONG", "OR", "OF"} if "NAME" in accepted else set[str]()  # arguments, which their kinds offer
    keys_too |= {"WITHIN"} if "AT" in accepted else set()
    for sort, said in _literals().items():
        for word in said if sort in accepted - keys_too else ():
            label = WORDS.get(word, {line.first: word}).get(line.first, "")
            if word == "where" and not letter_in(line.code):
                continue  # no family without a letter
            if label and (is_like or word != "for" or line.first not in ("reads", "drives", "influences")):
                yield from offers.words(label)
