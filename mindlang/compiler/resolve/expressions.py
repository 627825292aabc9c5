"""Expressions: their readings and measures found, their numbers converted."""

from collections.abc import Mapping, Set
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any, TypeVar

from mindrun.graph.draws import Draw
from mindrun.kinds.registry import find_kind, kinds
from mindrun.numbers.quantity import Quantity
from msgspec.structs import replace

from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.resolve.kinds import Scope, make_event, make_kind
from mindlang.compiler.resolve.quantities import convert
from mindlang.compiler.syntax import Amount, Expression, Phrase, Tally, Term, rebuilt

TALLIES = ("count", "longest", "sum")
TRUTH = {"true": 1, "yes": 1, "false": 0, "no": 0}
PLAIN = Quantity("a plain number", {"": 1.0, "%": 0.01})

T = TypeVar("T")
Widths = Mapping[str, int]  # how many readings each sensor and memory has


@dataclass(frozen=True, slots=True)
class Visible:
    """The names that an expression can use: readings with their widths, that of `for each`, in a task measures.

    `elsewhere` are the readings that exist but are no inputs of the skill, `unread` the words of lines that could not
    be read, `commands` the actuators whose commands can be seen, `draws` the numbers that a task draws.
    """

    readings: Widths
    measures: Scope | None = None
    each: str | None = None
    elsewhere: Widths | None = None
    unread: Set[str] = frozenset()
    commands: Set[str] = frozenset()
    draws: Mapping[str, Draw] = field(default_factory=dict)
    made_of: str = "numbers and the inputs of its skill"
    where: str = "An expression after at"


def resolve_expressions(node: T, visible: Visible, findings: Findings) -> T:
    """An expression, a condition or anything else with the names in its expressions resolved."""

    def resolved(node: Any) -> Any:
        return resolve_expression(node, visible, findings) if isinstance(node, Expression) else node

    found: T = rebuilt(node, resolved)
    return found


def resolve_expression(expression: Expression, visible: Visible, findings: Findings) -> Expression:
    """The expression with its names resolved; a term that cannot be is reported and left out."""
    for right, operator in pairwise(expression.terms):
        divides = isinstance(operator, Term) and operator.word == "/"
        if divides and isinstance(right, Amount) and right.number == 0:
            findings.error("division-by-zero", right.span, "This divides by zero.", "Divide by something else.")
    terms = [_term(term, visible, findings) for term in expression.terms]
    return Expression(tuple(term for term in terms if term), expression.span)


def _term(term: Amount | Phrase | Term | Tally, visible: Visible, findings: Findings) -> Term | None:
    match term:
        case Term():
            return term
        case Tally():
            return _tally(term, visible, findings)
        case Amount():
            value = convert(term, PLAIN, findings)
            return None if value is None else Term("number", value, term.span)
        case Phrase(kind, ()) if kind.text == visible.each:
            return Term("each", 0, term.span)
        case Phrase(kind, ()) if kind.text in visible.readings:
            width = visible.readings[kind.text]
            if width == 1:
                return Term("reading", kind.text, term.span)
            hint = f"Only a sensor with one reading can stand here, as sensor ahead is reading 1 of {kind.text}."
            hint = f"Write p instead and add for each p in {kind.text}." if visible.measures else hint
            message = f"{kind.text} has {width} readings; an expression takes one number."
            findings.error("wide-reading", term.span, message, hint)
        case Phrase(kind, ()) if kind.text in visible.draws:
            return Term("drawn", visible.draws[kind.text], term.span)
        case Phrase(kind, ()) if kind.text in visible.commands:
            return Term("command", kind.text, term.span)
        case Phrase(kind) if visible.measures and find_kind("measure", kind.text):
            measure = make_kind("measure", term, visible.measures, findings)
            return Term("measure", measure, term.span) if measure else None
        case Phrase(kind) if kind.text not in visible.unread:  # there it may have been declared
            _refuse_unknown(term, visible, findings)
    return None


def _tally(tally: Tally, visible: Visible, findings: Findings) -> Term | None:
    """A tally whose event and condition are resolved; None after reporting what is wrong with it."""
    if not visible.measures or visible.each:
        hint = "Write it in a line that rewards at the end, or in one that ends a run."
        message = f"What is counted in a run has no place here: {visible.where[0].lower()}{visible.where[1:]}."
        if visible.each:
            message = "What is counted in a run is no matter of each reading."
        findings.error("misplaced-tally", tally.span, message, hint)
        return None
    event = make_event(tally.event, visible.measures, findings) if tally.event else None
    if event and event.is_of_success:
        hint = "Leave it out: behind it nothing is counted any more."
        findings.error("misplaced-tally", tally.event.span, "A success ends the run, and is not counted in it.", hint)
    when, value = resolve_expressions((tally.when, tally.value), visible, findings)
    return Term("tally", replace(tally, event=event, when=when, value=value), tally.span)


def _refuse_unknown(term: Phrase, visible: Visible, findings: Findings) -> None:
    name, here = term.kind.text, term.kind.span
    if name in TRUTH:
        findings.error("truth", here, f"{name} is no reading: every value is a number.", f"Write {TRUTH[name]}.")
    elif name in visible.readings:
        over = next((each for each in term.arguments if each.key.text == "over"), None)
        hint = f"Write {over.span.text} right behind the skill: influences Seek {over.span.text}." if over else ""
        message = f"{name} is a reading and takes no arguments."
        findings.error("reading-argument", term.span, message, hint or f"Write {name}.")
    elif visible.elsewhere and name in visible.elsewhere:
        hint = f"Add the line reads {name}; an expression after at sees the inputs of its own skill."
        findings.error("not-an-input", term.span, f"The skill does not read {name}.", hint)
    elif name in findings.draws:
        message = f"{name} is drawn for each run of a task, and is nothing that is sensed."
        hint = f"Let the task contain something at +{name} 5, or when {name} > 0.5, and sense that."
        if visible.measures:
            hint = f"Write draws {name} from 0 1 below this task, too: what another task draws is not known here."
        findings.error("unknown-reading", here, message, hint)
    elif visible.measures:
        said = term.span.text
        hint = findings.suggest(name, visible.readings, kinds("measure"))
        if name in kinds("event"):
            hint = f"{name} is an event, which stands after on: rewards 1 on {said}, ends on {said}."
        if name in TALLIES:
            hint = "What is counted in a run stands in parentheses: (count of collision)."
        hint = hint or "A reward is made of sensors, memories and measures such as forward or progress toward X."
        findings.error("unknown-measure", here, f"There is no reading or measure called {name}.", hint)
    else:
        hint = findings.suggest(name, visible.readings, visible.elsewhere or ())
        if name in kinds("measure"):
            hint = f"{name} is a measure, which only tasks have; here stand {visible.made_of}."
        hint = hint or f"{visible.where} is made of {visible.made_of}."
        findings.error("unknown-reading", here, f"There is no reading called {name}.", hint)
