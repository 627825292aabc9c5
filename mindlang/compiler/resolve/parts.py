"""Sensors, memories, actuators and the body; how many readings each sensor has."""

from dataclasses import replace
from typing import Any

from mindlang.compiler.diagnostic import Findings, a, listed
from mindlang.compiler.model import Part
from mindlang.compiler.names import Names
from mindlang.compiler.resolve.kinds import Scope, make
from mindlang.compiler.syntax import Declaration, Fact

MOST_READINGS = 20_000
ONE_LINE = "All that there is to say of it stands in its one line; set the fact below the skill or task it belongs to."


def parts(noun: str, names: Names, findings: Findings) -> tuple[Part[Any], ...]:
    """The parts declared with a noun, as far as their kinds are well said."""
    things = names.things()
    found = []
    for name, declaration in names.declarations(noun):
        refuse_facts(declaration, (), findings)
        header = declaration.header
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


def measured_widths(sensors: tuple[Part[Any], ...], findings: Findings) -> tuple[Part[Any], ...]:
    """The sensors with their widths; derivatives of one another are reported."""
    found = {sensor.name: sensor.kind.width or 1 for sensor in sensors}
    derived = {sensor.name: sensor for sensor in sensors if sensor.kind.source}
    done: set[str] = set()
    for name in derived:
        chain, last = {name: None}, name
        while last in derived and last not in done:
            last = derived[last].kind.source
            if last in chain:
                _loop([*chain], last, derived, findings)
                break
            chain[last] = None
        found.update(dict.fromkeys(chain, found.get(last, 1)))
        done.update(chain)
    if (readings := sum(found.values())) > MOST_READINGS:
        widest = max(sensors, key=lambda sensor: found[sensor.name])
        message = f"With these {found[widest.name]} the mind has {readings} readings."
        findings.error("too-many-readings", widest.span, message, f"A mind takes {MOST_READINGS}: leave some out.")
    return tuple(replace(sensor, width=found[sensor.name]) for sensor in sensors)


def _loop(chain: list[str], again: str, derived: dict[str, Part[Any]], findings: Findings) -> None:
    path = [*chain[chain.index(again) :], again]
    message = f"A sensor is derived from itself: {' → '.join(path)}."
    findings.error("derivative-loop", derived[again].span, message, "Derive one of them from another sensor.")
