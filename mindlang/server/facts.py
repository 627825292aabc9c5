"""What may be written in a fact, by its verb and the words that stand behind it."""

from collections.abc import Callable, Mapping, Sequence

from mindrun.kinds.registry import kinds

from mindlang.compiler.references import DRIVABLE_NOUNS, READABLE_NOUNS
from mindlang.compiler.syntax import Drives, Influences, Reads
from mindlang.server import offers
from mindlang.server.cursor_line import CursorLine
from mindlang.server.expressions import (
    awaits_value,
    condition_offers,
    condition_words,
    reward_offers,
    takes_value,
    values,
)
from mindlang.server.offers import (
    NUMBER,
    Offer,
    arguments_of,
    inputs_of,
    kinds_of,
    names,
    numbers,
    units,
    words,
)
from mindlang.server.run_facts import fails, starts, varies

EDGE_JOINTS = ("at", "when", "otherwise", "cuts")


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
    return _edge(line, rest) if rest else names(line.view, *DRIVABLE_NOUNS, but=line.names_after(Drives))


def _influences(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    own = {line.above.header.name.text} if line.above else set()
    others = names(line.view, "skill", but=own | line.names_after(Influences))
    return _edge(line, rest, "cuts below") if rest else others


def _edge(line: CursorLine, rest: Sequence[str], *last: str) -> list[Offer]:
    """After the name of an edge: its value, its condition, what is sent otherwise, and what comes `last`."""
    joint = max((place for place, word in enumerate(rest) if word in EDGE_JOINTS), default=0)
    said = rest[joint + 1 :]
    match rest[joint]:
        case "cuts":
            is_number = said[-1:] and said[-1][0] in NUMBER
            return units("%") if is_number else numbers(line.view) if said else [Offer("below", "word")]
        case "at" | "when" | "otherwise" if takes_value(rest[joint:]):
            read = line.names_after(Reads)
            found = values(line.view, rest, [each for each in names(line.view, *READABLE_NOUNS) if each.label in read])
        case _:
            found = []
    if awaits_value(rest):
        return found
    match rest[joint]:
        case "at":
            return [*found, *words("when", *last)]
        case "when":
            joints = condition_words(rest[joint:])
            return [*found, *joints, *(words("otherwise", *last) if joints else [])]
        case "otherwise":
            return [*found, *words(*last)]
    return words("at", "when", *last)


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
    if rest == ["its"]:
        return [Offer("end", "word")]
    return arguments_of(line.view, "event", rest[0], rest[1:], line.above) if rest else kinds_of("event")


def _ends(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    match rest:
        case []:
            return words("on", "when")
        case ["when", *_]:
            return condition_offers(line.view, line.above, rest)
        case [_, times, *event] if times[0] in NUMBER:
            return _event(line, event)
    return _event(line, rest[1:])


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
        case [*_, "needs"]:
            return words("score", "success")
        case [*_, "using"]:
            return kinds_of("curriculum")
    phrase = line.above.header.phrase if line.above else None
    learner = rest[rest.index("using") + 1] if "using" in rest else phrase.kind.text if phrase else ""
    switches = words("from scratch", "with subskills", "using", "needs")
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
    "starts": starts,
    "varies": varies,
    "fails": fails,
    "lasts": _number("ticks", "s"),
    "ends": _ends,
    "succeeds": _ends,
    "rewards": _rewards,
    "counts": _event,
    "teaches": _teaches,
    "master": lambda line, rest: [] if rest else names(line.view, "skill"),
    "tick": _number("s"),
}
