"""Migrates files that were written before things said what becomes of them (`reached moves`)."""

from collections.abc import Iterator

from mindrun.kinds.things.thing import MOVES, STAYS

from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.parse import parse
from mindlang.compiler.source import Source, Splice, spliced
from mindlang.compiler.syntax import Contains, Counts, Declaration, Name, Outcome, Phrase, Rewards, of_form

PLACED = ("item", "zone", "power")  # the kinds that had places of their own


def migrated_text(source: Source, findings: Findings) -> str:
    """The text of a file in which every thing says what becomes of it, as an older mindc understood it."""
    declarations = parse(source, findings).declarations
    return spliced(source, [splice for declaration in declarations for splice in _splices(source, declaration)])


def _splices(source: Source, declaration: Declaration) -> Iterator[Splice]:
    """The arguments `reached` and `delivered` that the things of a task still lack."""
    named = {_named(event) for event in _events(declaration)}
    things = of_form(declaration.facts, Contains)
    has_zone = any(fact.phrase.kind.text == "zone" for fact in things)
    for fact in things:
        thing, phrase = fact.name.text, fact.phrase
        said = {argument.key.text for argument in phrase.arguments}
        if phrase.kind.text not in PLACED or said & {"reached", "delivered"}:
            continue  # it says already what becomes of it
        if ("reach", thing) in named:
            yield Splice(source, phrase.span.end, phrase.span.end, f" reached {MOVES}")
        elif phrase.kind.text == "item" and has_zone and ("delivery", thing) not in named:
            yield Splice(source, phrase.span.end, phrase.span.end, f" delivered {STAYS}")


def _events(declaration: Declaration) -> Iterator[Phrase]:
    for fact in declaration.facts:
        match fact:
            case Outcome(_, Phrase() as event) | Counts(event) | Rewards(_, Phrase() as event):
                yield event


def _named(event: Phrase) -> tuple[str, str]:
    """An event's kind, and the thing that it is of."""
    of = (argument.value for argument in event.arguments if argument.key.text == "of")
    return event.kind.text, next((value.text for value in of if isinstance(value, Name)), "")
