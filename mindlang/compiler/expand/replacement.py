"""What replaces what, where a scene or task says more than the one that it is like: a line of the same thing.

A thing replaces the one of its name; an event that ends, succeeds or is counted, the same event, however many times it
was to happen; a reward, the one on the same event or of the same readings and measures under the same condition. How
long a task lasts and where the robot starts is said once; a number varies and a part fails in one way.
"""

from collections.abc import Hashable, Iterator, Sequence

from mindlang.compiler.syntax import (
    Contains,
    Counts,
    Ends,
    Expression,
    Fact,
    Fails,
    Lasts,
    Phrase,
    Rewards,
    Starts,
    Succeeds,
    Varies,
    When,
)


def with_more(first: Sequence[Fact], more: Sequence[Fact]) -> tuple[Fact, ...]:
    """The facts of one and then those of another, which stand in the place of those that they replace."""
    own: dict[Hashable, list[Fact]] = {}
    for fact in more:
        own.setdefault(_subject(fact), []).append(fact)
    found: list[Fact] = []
    for fact in first:
        found += own.get(_subject(fact), [fact])
        if _subject(fact) in own:
            own[_subject(fact)] = []
    return (*found, *(fact for fact in more if own[_subject(fact)]))


def _subject(fact: Fact) -> Hashable:
    """What a fact is about; of two lines about the same, the later one counts."""
    match fact:
        case Contains(name):
            about: tuple[Hashable, ...] = (name.text,)
        case Varies(argument, of):
            about = argument.text, of.text
        case Fails(name):
            about = (name.text,)
        case Ends(_, event, when) | Succeeds(_, event, when):
            about = _text(event), _text(when)
        case Counts(event):
            about = (_text(event),)
        case Rewards(amount, None, each, when):
            about = frozenset(_read(amount)), each and each.sensor.text, _text(when)
        case Rewards(_, on, _, when):
            about = _text(on), _text(when)
        case Lasts() | Starts():
            about = ()
        case _:  # that does not belong here: all are reported
            about = (fact,)
    return type(fact), *about


def _read(amount: Expression) -> Iterator[str]:
    """The readings and measures in an expression."""
    return (_text(term) for term in amount.terms if isinstance(term, Phrase))


def _text(node: Phrase | When | None) -> str:
    """What is written, however it is spaced."""
    return " ".join(node.span.text.split()) if node else ""
