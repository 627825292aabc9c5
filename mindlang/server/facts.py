"""What may be written in a fact, by its verb and the words that stand behind it."""

from collections.abc import Callable, Mapping, Sequence

from mindrun.registry import kinds

from mindlang.compiler.syntax import Drives, Influences, Reads
from mindlang.editing.references import DRIVABLE_NOUNS, READABLE_NOUNS
from mindlang.server import offers, rewarding
from mindlang.server.offers import NUMBER, Offer, arguments_of, kinds_of, names, units, words
from mindlang.server.sentence import Line

Answer = Callable[[Line, Sequence[str]], list[Offer]]


def _reads(line: Line, rest: Sequence[str]) -> list[Offer]:
    return [] if rest else names(line.view, *READABLE_NOUNS, but=line.said(Reads))


def _drives(line: Line, rest: Sequence[str]) -> list[Offer]:
    return _at(line, rest) if rest else names(line.view, *DRIVABLE_NOUNS, but=line.said(Drives))


def _influences(line: Line, rest: Sequence[str]) -> list[Offer]:
    own = {line.above.header.name.text} if line.above else set()
    return _at(line, rest) if rest else names(line.view, "skill", but=own | line.said(Influences))


def _at(line: Line, rest: Sequence[str]) -> list[Offer]:
    """After the name of an edge: `at`, and an expression of what the skill reads."""
    if len(rest) == 1:
        return words("at")
    if rest[-1] == "at" or rest[-1] in "+-*/(":
        read = line.said(Reads)
        return [offer for offer in names(line.view, *READABLE_NOUNS) if offer.label in read]
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
        case [*_, "using"]:
            return kinds_of("curriculum")
    phrase = line.above.header.phrase if line.above else None
    learner = rest[rest.index("using") + 1] if "using" in rest else phrase.kind.text if phrase else ""
    switches = words("from scratch", "with subskills", "using")
    switches = [offer for offer in switches if offer.label.split()[0] not in rest]
    if learner not in kinds("curriculum"):
        return switches
    found = arguments_of(line.view, "curriculum", learner, rest[2:], None)
    waits = offers.said(kinds("curriculum")[learner], rest[2:]).awaits_number
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
