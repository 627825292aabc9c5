"""Sensors, memories, actuators and the body; how many readings each sensor has."""

from collections.abc import Iterable, Mapping, Sequence
from math import prod
from typing import Any

from mindrun.kinds.sensors.computed import Computed
from mindrun.numbers.expression import Formula
from msgspec.structs import replace

from mindlang.compiler.diagnostic import Findings, Label, a, listed
from mindlang.compiler.hierarchy import circles
from mindlang.compiler.model import Expression, Number, Part, Reading, Term, source_graph
from mindlang.compiler.names import Names
from mindlang.compiler.resolve.expressions import Visible, resolve
from mindlang.compiler.resolve.kinds import Scope, make
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Declaration, Fact, Needs, Operator

MOST_READINGS = 20_000
ONE_LINE = "All that there is to say of it stands in its one line; set the fact below the skill or task it belongs to."


def parts(noun: str, names: Names, findings: Findings) -> tuple[Part[Any], ...]:
    """The parts declared with a noun, as far as their kinds are well said."""
    things = names.things()
    found = []
    for name, declaration in names.declarations(noun):
        refuse_facts(declaration, (), findings)
        header = declaration.header
        if header.at:
            continue  # `sensors` computes it when all others are known
        kind = header.phrase and make(noun, header.phrase, Scope(names, things, whole=declaration.whole), findings)
        if kind:
            found.append(Part(name, kind, header.name.span))
    return tuple(found)


def refuse_facts(declaration: Declaration, allowed: tuple[type[Fact], ...], findings: Findings) -> None:
    """Report the facts that a declaration of this noun cannot have.

    A line above them that could not be read may have been the header to which they belong.
    """
    if not declaration.whole:
        return
    noun = declaration.header.noun.text
    for fact in declaration.facts:
        if not isinstance(fact, allowed):
            verb = type(fact).__name__.lower()
            verbs = [form.__name__.lower() for form in allowed]
            hint = f"Below {noun} {declaration.header.name.text} can stand {listed(verbs)}." if verbs else ONE_LINE
            findings.error("foreign-fact", fact.span, f"{verb} does not belong to {a(noun)}.", hint)


def refuse_repeated(facts: Sequence[Fact | Needs], message: str, hint: str, findings: Findings) -> None:
    """Report all but the first of facts that say the same."""
    for again in facts[1:]:
        findings.error("repeated-fact", again.span, message, hint, Label(facts[0].span, "first said here"))


def sensors(names: Names, findings: Findings) -> tuple[Part[Any], ...]:
    """The sensors with their widths, as they are declared; those that are computed from themselves are reported."""
    plain = {sensor.name: sensor for sensor in parts("sensor", names, findings)}
    formulas = {name: header.at for name, each in names.declarations("sensor") if (header := each.header).at}
    widths = _widths(plain, [*formulas, *names.of("memory")])
    visible = Visible(widths, unread=names.unread, made_of="numbers, sensors and memories")
    for name, at in formulas.items():
        formula = _formula(resolve(at, visible, findings))
        plain[name] = Part(name, Computed(formula), names.table["sensor"][name].header.name.span)
    found = tuple(replace(plain[name], width=widths[name]) for name in names.of("sensor") if name in plain)
    _refuse_loops(found, findings)
    _refuse_too_many(found, findings)
    for sensor in found:
        if sensor.name not in formulas and (flaw := sensor.kind.flaw(widths)):
            span = _argument_span(names.table["sensor"][sensor.name], flaw.field)
            findings.error(flaw.code, span, flaw.message, flaw.hint)
    return found


def _formula(expression: Expression) -> Formula:
    """An expression as the kind has it: readings by their names."""

    def instruction(term: Term) -> tuple[str, float | int | str]:
        match term:
            case Number():
                return "number", term.value
            case Reading():
                return "reading", term.name
            case Operator():
                return term.symbol, 0
        raise TypeError(f"{term} stands in a task alone")

    return tuple(instruction(term) for term in expression.terms)


def _argument_span(declaration: Declaration, field: str) -> Span:
    phrase = declaration.header.phrase
    found = (argument.value.span for argument in phrase.arguments if argument.key.text == field) if phrase else ()
    return next(iter(found), declaration.header.span)


def _widths(sensors: Mapping[str, Part[Any]], of_one: Iterable[str]) -> dict[str, int]:
    """How many readings each sensor and memory has: one that does not say has as many as its source."""
    shapes = {name: each.kind.shape for name, each in sensors.items()}
    widths = dict.fromkeys(of_one, 1) | {name: prod(shape) for name, shape in shapes.items() if shape is not None}
    for name in sensors:
        chain, last = {name: None}, name
        while last in sensors and last not in widths:
            last = sensors[last].kind.source
            if last in chain:
                break
            chain[last] = None
        widths |= dict.fromkeys(chain, widths.get(last, 1))
    return widths


def _refuse_loops(sensors: Sequence[Part[Any]], findings: Findings) -> None:
    """Report sensors that are computed from themselves, each circle once."""
    for circle in circles(source_graph(sensors)):
        message = f"A sensor is derived from itself: {' → '.join([*circle, circle[0]])}."
        span = next(sensor.span for sensor in sensors if sensor.name == circle[0])
        findings.error("derivative-loop", span, message, "Derive one of them from another sensor.")


def _refuse_too_many(sensors: tuple[Part[Any], ...], findings: Findings) -> None:
    if (readings := sum(sensor.width for sensor in sensors)) > MOST_READINGS:
        widest = max(sensors, key=lambda sensor: sensor.width)
        message = f"With these {widest.width} the mind has {readings} readings."
        findings.error("too-many-readings", widest.span, message, f"A mind takes {MOST_READINGS}: leave some out.")
