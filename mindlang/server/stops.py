"""Files of breakpoints in an editor: what is wrong with one, and what may be written in it, by the mind beside it."""

from collections.abc import Sequence
from itertools import takewhile
from pathlib import Path

from mindlang.breakpoints.breakpoint import FAULT, OF, ROBOT_WORDS
from mindlang.breakpoints.resolve import breakpoints_of
from mindlang.breakpoints.subject import subject_of_mind
from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.references import READABLE_NOUNS
from mindlang.compiler.source import Source
from mindlang.server.offers import (
    NUMBER,
    Offer,
    arguments_of,
    condition_words,
    kinds_of,
    names,
    numbers,
    takes_value,
    units,
    values,
    words,
)
from mindlang.server.workspace import MindView

JOINTS = ("when", "and", "or")


def stop_findings(path: Path, text: str, mind: MindView) -> tuple[Diagnostic, ...]:
    """What is wrong with the text of a file of breakpoints; no names are looked for in a mind that does not compile."""
    subject = subject_of_mind(mind.compiled) if mind.compiled.graph else None
    return breakpoints_of(Source(str(path), text, path.parent), subject).diagnostics


def stop_offers(view: MindView, line: Sequence[str]) -> list[Offer]:
    """What may be written behind these words of a line."""
    match line:
        case []:
            return [Offer("stop", "word")]
        case ["stop"]:
            return words("on", "when", "in")
        case ["stop", "in"]:
            return words("tick")
        case ["stop", "when", *_]:
            return _condition(view, line[1:])
        case ["stop", "on", times, *event] if times[0] in NUMBER:
            return _event(view, event)
        case ["stop", "on", *event]:
            return _event(view, event)
    return []


def _event(view: MindView, rest: Sequence[str]) -> list[Offer]:
    match rest:
        case []:
            return [*kinds_of("event"), *words(*ROBOT_WORDS)]
        case [word] if word == FAULT:
            return words(OF)
        case [word, of] if (word, of) == (FAULT, OF):
            return names(view, "sensor")
    return arguments_of(view, "event", rest[0], rest[1:], None)


def _condition(view: MindView, rest: Sequence[str]) -> list[Offer]:
    """Behind `when`, `and` or `or`: an expression that is compared, or what a skill influences."""
    match [*takewhile(lambda word: word not in JOINTS, reversed(rest))][::-1]:
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
        case _:
            found = []
    if takes_value(rest):
        found += values(view, rest, names(view, *READABLE_NOUNS, "actuator"))
    return [*found, *condition_words(rest)]
