"""What may be written in an expression or a condition, by the words that stand before it."""

from collections.abc import Sequence

from mindrun.kinds.registry import kinds

from mindlang.compiler.references import READABLE_NOUNS
from mindlang.compiler.syntax import Declaration
from mindlang.server.offers import Offer, arguments_of, kinds_of, names, numbers, words, written_arguments
from mindlang.server.view import MindView

COMPARISONS = ("<", ">", "<=", ">=")
JOINTS = ("when", "and", "or", "at", "otherwise")  # behind which an expression begins
OPENINGS = ("+", "-", "*", "/", "(", *COMPARISONS, *JOINTS)  # behind which a value stands
SEVERAL = ("least", "greatest")  # of


def values(view: MindView, rest: Sequence[str], readings: Sequence[Offer]) -> list[Offer]:
    """What can stand for a number behind the words `rest`: these readings, the names of numbers, the least of some."""
    if rest and rest[-1] in SEVERAL:
        return [Offer("of", "word")]
    return [*readings, *numbers(view), *words("least of", "greatest of")]


def awaits_value(rest: Sequence[str]) -> bool:
    """Whether a value must come next."""
    return not rest or rest[-1] in (*OPENINGS, *SEVERAL) or _begins_several(rest)


def takes_value(rest: Sequence[str]) -> bool:
    """Whether a value may come next: one must, or it is one more of several."""
    since = _since(rest, OPENINGS)
    return awaits_value(rest) or any(word in SEVERAL for word in since)


def condition_words(rest: Sequence[str]) -> list[Offer]:
    """What may join the comparison before it with the next; nothing where it is not over."""
    is_compared = any(word in COMPARISONS for word in _since(rest, JOINTS))
    return words("and", "or") if is_compared and not awaits_value(rest) else []


def _begins_several(rest: Sequence[str]) -> bool:
    return len(rest) > 1 and rest[-1] == "of" and rest[-2] in SEVERAL


def _since(rest: Sequence[str], joints: Sequence[str]) -> Sequence[str]:
    """The words behind the last one of these."""
    last = max((place for place, word in enumerate(rest) if word in joints), default=-1)
    return rest[last + 1 :]


def condition_offers(view: MindView, task: Declaration | None, rest: Sequence[str]) -> list[Offer]:
    """What can come after `when` in a task."""
    return [*_term(view, task, rest), *condition_words(rest)]


def reward_offers(view: MindView, task: Declaration | None, rest: Sequence[str]) -> list[Offer]:
    """What can come after the words `rest` of a reward."""
    if "when" in rest:
        return condition_offers(view, task, rest[rest.index("when") :])
    match rest:
        case [*_, "on", "its"]:
            return [Offer("end", "word")]
        case [*_, "its"]:
            return [Offer("reward", "word")]
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
    joints = words("per tick", "on") if rest and not awaits_value(rest) and not _waits(rest) else []
    return [*_term(view, task, rest), *joints]


def _term(view: MindView, task: Declaration | None, rest: Sequence[str]) -> list[Offer]:
    """A reading or a measure, or what the measure that was begun still needs."""
    if takes_value(rest):
        readings = names(view, *READABLE_NOUNS, "actuator")  # the name of an actuator is its command
        return values(view, rest, [*readings, *kinds_of("measure")])
    begun = _begun(rest)
    return arguments_of(view, "measure", begun[0], begun[1:], task) if begun else []


def _begun(rest: Sequence[str]) -> Sequence[str]:
    """The measure that was begun last, with its arguments; nothing where it is over."""
    begun = max((place for place, word in enumerate(rest) if word in kinds("measure")), default=len(rest))
    return () if any(word in OPENINGS for word in rest[begun:]) else rest[begun:]


def _waits(rest: Sequence[str]) -> bool:
    """Whether an argument of a measure waits for its value."""
    begun = _begun(rest)
    state = written_arguments(kinds("measure")[begun[0]], begun[1:]) if begun else None
    return state is not None and (state.awaits_name or state.awaits_number)
