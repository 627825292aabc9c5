"""What may be written in a reward: an expression, when it is given, and on which condition."""

from collections.abc import Sequence

from mindrun.registry import kinds

from mindlang.compiler.syntax import Declaration
from mindlang.editing.references import READABLE_NOUNS
from mindlang.server.offers import Offer, arguments_of, kinds_of, names, said, words
from mindlang.server.view import View

UNFINISHED_WORDS = ("+", "-", "*", "/", "(", "<", ">", "<=", ">=", "when")


def offered(view: View, task: Declaration | None, rest: Sequence[str]) -> list[Offer]:
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


def _term(view: View, task: Declaration | None, rest: Sequence[str]) -> list[Offer]:
    """A reading or a measure, or what the measure that was begun still needs."""
    if not rest or rest[-1] in UNFINISHED_WORDS:
        return [*names(view, *READABLE_NOUNS), *kinds_of("measure")]
    begun = _begun(rest)
    return arguments_of(view, "measure", begun[0], begun[1:], task) if begun else []


def _begun(rest: Sequence[str]) -> Sequence[str]:
    """The measure that was begun last, with its arguments; nothing where it is over."""
    begun = max((place for place, word in enumerate(rest) if word in kinds("measure")), default=len(rest))
    return () if any(word in UNFINISHED_WORDS for word in rest[begun:]) else rest[begun:]


def _waits(rest: Sequence[str]) -> bool:
    """Whether an argument of a measure waits for its value."""
    begun = _begun(rest)
    state = said(kinds("measure")[begun[0]], begun[1:]) if begun else None
    return state is not None and (state.awaits_name or state.awaits_number)
