"""What may be written in a fact, by its verb and the words that stand behind it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from mindrun.registry import kinds

from mindlang.compiler.references import DRIVABLE_NOUNS, READABLE_NOUNS
from mindlang.compiler.syntax import Declaration, Drives, Influences, Reads
from mindlang.server import offers
from mindlang.server.offers import (
    NUMBER,
    Offer,
    arguments_of,
    inputs_of,
    kinds_of,
    names,
    units,
    words,
    written_arguments,
)
from mindlang.server.view import MindView, on_line

UNFINISHED_WORDS = ("+", "-", "*", "/", "(", "<", ">", "<=", ">=", "when")


@dataclass(frozen=True, slots=True)
class CursorLine:
    """What stands before a place in its line, and the declaration to which the line belongs."""

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
        """What the skill above says with these verbs on its other lines."""
        facts = [fact for fact in (self.above.facts if self.above else ()) if isinstance(fact, forms)]
        return {fact.name.text for fact in facts if not on_line(fact.span, self.offset)}


Answer = Callable[[CursorLine, Sequence[str]], list[Offer]]


def _reads(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    match rest:
        case []:
            return names(line.view, *READABLE_NOUNS, but=line.names_after(Reads))
        case [_] if line.above and line.above.header.like:
            return words("for")
        case [_, "for"] if line.above and line.above.header.like:
            inputs = inputs_of(line.view, line.above.header.like.text)
            return [offer for offer in names(line.view, *READABLE_NOUNS) if offer.label in inputs]
    return []


def _drives(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    return _at(line, rest) if rest else names(line.view, *DRIVABLE_NOUNS, but=line.names_after(Drives))


def _influences(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    own = {line.above.header.name.text} if line.above else set()
    return _at(line, rest) if rest else names(line.view, "skill", but=own | line.names_after(Influences))


def _at(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    """After the name of an edge: `at`, and an expression of what the skill reads."""
    if len(rest) == 1:
        return words("at")
    if rest[-1] == "at" or rest[-1] in "+-*/(":
        read = line.names_after(Reads)
        return [offer for offer in names(line.view, *READABLE_NOUNS) if offer.label in read]
    return []


def _contains(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    match rest:
        case [_]:
            return words("is")
        case [_, "is"]:
            return kinds_of("content")
        case [_, "is", kind, *written]:
            return arguments_of(line.view, "content", kind, written, line.above)
    return []


def _event(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    return arguments_of(line.view, "event", rest[0], rest[1:], line.above) if rest else kinds_of("event")


def _ends(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    return _event(line, rest[1:]) if rest else words("on")


def _rewards(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    return reward_offers(line.view, line.above, rest)


def _teaches(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
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
        case [_, "on", _, "for", *written] | [_, "on", _, "under", _, "for", *written]:
            return _lesson(line, written)
    return []


def _lesson(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    """After `for`: a number of generations, and then what a lesson may say beside."""
    match rest:
        case []:
            return []
        case [_]:
            return units("generations")
        case [*_, "from"]:
            return [Offer("scratch", "word"), *names(line.view, "skill")]
        case [*_, "with"]:
            return [Offer("subskills", "word")]
        case [*_, "using"]:
            return kinds_of("curriculum")
    phrase = line.above.header.phrase if line.above else None
    learner = rest[rest.index("using") + 1] if "using" in rest else phrase.kind.text if phrase else ""
    switches = words("from scratch", "with subskills", "using")
    switches = [offer for offer in switches if offer.label.split()[0] not in rest]
    if learner not in kinds("curriculum"):
        return switches
    found = arguments_of(line.view, "curriculum", learner, rest[2:], None)
    waits = offers.written_arguments(kinds("curriculum")[learner], rest[2:]).awaits_number
    return [] if waits else [*found, *switches]


def _number(*of: str) -> Answer:
    """After a number, its units."""
    return lambda line, rest: units(*of) if len(rest) == 1 and rest[0][0] in NUMBER else []


FACTS: Mapping[str, Answer] = {
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


def reward_offers(view: MindView, task: Declaration | None, rest: Sequence[str]) -> list[Offer]:
    """What can come after the words `rest` of a reward."""
    if "when" in rest:
        return _term(view, task, rest[rest.index("when") :])
    match rest:
        case [*_, "per"]:
            return [Offer("tick", "word")]
        case [*_, "for"]:
            return [Offer("each", "word")]
        case [*_, "each"] | [*_, "each", _]:
            return words("in") if rest[-1] != "each" else []
        case [*_, "each", _, "in"]:
            return names(view, *READABLE_NOUNS)
        case [*_, "each", _, "in", _]:
            return words("when")
        case [*_, "per", "tick"]:
            return words("for each", "when")
        case [*_, "on"]:
            return kinds_of("event")
    if "on" in rest:
        kind, *arguments = rest[rest.index("on") + 1 :]
        return [*arguments_of(view, "event", kind, arguments, task), *words("when")]
    joints = words("per tick", "on") if rest and rest[-1] not in UNFINISHED_WORDS and not _waits(rest) else []
    return [*_term(view, task, rest), *joints]


def _term(view: MindView, task: Declaration | None, rest: Sequence[str]) -> list[Offer]:
    """A reading or a measure, or what the measure that was begun still needs."""
    if not rest or rest[-1] in UNFINISHED_WORDS:
        return [*names(view, *READABLE_NOUNS), *offers.numbers(view), *kinds_of("measure")]
    begun = _begun(rest)
    return arguments_of(view, "measure", begun[0], begun[1:], task) if begun else []


def _begun(rest: Sequence[str]) -> Sequence[str]:
    """The measure that was begun last, with its arguments; nothing where it is over."""
    begun = max((place for place, word in enumerate(rest) if word in kinds("measure")), default=len(rest))
    return () if any(word in UNFINISHED_WORDS for word in rest[begun:]) else rest[begun:]


def _waits(rest: Sequence[str]) -> bool:
    """Whether an argument of a measure waits for its value."""
    begun = _begun(rest)
    state = written_arguments(kinds("measure")[begun[0]], begun[1:]) if begun else None
    return state is not None and (state.awaits_name or state.awaits_number)
