"""What may be written in a fact, by its verb and the words that stand behind it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from mindrun.kinds.registry import kinds

from mindlang.compiler.references import DRIVABLE_NOUNS, READABLE_NOUNS
from mindlang.compiler.syntax import Declaration, Drives, Influences, Reads
from mindlang.server.offers import (
    NUMBER,
    Offer,
    arguments_of,
    awaits_value,
    condition_offers,
    condition_words,
    inputs_of,
    keys,
    kinds_of,
    names,
    numbers,
    reward_offers,
    takes_value,
    units,
    units_of,
    values,
    varying_parts,
    words,
    written_arguments,
)
from mindlang.server.workspace import MindView, on_line

EDGE_JOINTS = ("at", "when", "otherwise", "cuts")
SIGNS = ("+", "-")


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
    waits = written_arguments(kinds("curriculum")[learner], rest[2:]).awaits_number
    return [] if waits else [*found, *switches]


def _number(*of: str) -> Answer:
    """After a number, its units."""
    return lambda line, rest: units(*of) if len(rest) == 1 and rest[0][0] in NUMBER else []


def _starts(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    match [word for word in rest if word not in SIGNS]:
        case []:
            return words("at", "facing")
        case [*_, "facing"] | ["at"] | ["at", _]:
            return numbers(line.view)
        case [*_, "facing", _]:
            return units("deg")
        case ["at", _, _]:
            return words("facing")
    return []


def _varies(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    varying = dict(varying_parts(line.view, line.above))
    match [word for word in rest if word not in SIGNS]:
        case []:
            return keys({argument.key: argument for found in varying.values() for argument in found}.values())
        case [_]:
            return [Offer("of", "word")]
        case [argument, "of"]:
            return [part for part, found in varying.items() if argument in (each.key for each in found)]
        case [argument, "of", part, *said]:
            of = [each for name, found in varying.items() if name.label == part for each in found]
            own = [units_of(each) for each in of if each.key == argument and said and said[-1][0] in NUMBER]
            found = [unit for each in own for unit in each]
            return [*found, *words("to")] if said and "to" not in said else found or numbers(line.view)
    return []


def _fails(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    match rest:
        case []:
            return names(line.view, "actuator")
        case [_]:
            return numbers(line.view)
        case [*_, "per"]:
            return [*units("s"), Offer("tick", "word")]
        case [_, *_, "%"] | [_, _] if "per" not in rest:
            return [*(units("%") if rest[-1] != "%" else []), *words("per")]
    return []


FACTS: Mapping[str, Answer] = {
    "reads": _reads,
    "drives": _drives,
    "influences": _influences,
    "stays": lambda line, rest: [] if rest else words("frozen"),
    "contains": _contains,
    "starts": _starts,
    "varies": _varies,
    "fails": _fails,
    "lasts": _number("ticks", "s"),
    "ends": _ends,
    "succeeds": _ends,
    "rewards": _rewards,
    "counts": _event,
    "teaches": _teaches,
    "master": lambda line, rest: [] if rest else names(line.view, "skill"),
    "tick": _number("s"),
}
