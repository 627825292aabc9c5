"""Sensors, memories, actuators and the body: how many readings each sensor has, whether the actuators can move it."""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import replace as replace_fields
from math import prod
from typing import Any, TypeVar

from mindrun.kinds.actuators.actuator import ActuatorKind
from mindrun.kinds.bodies.body import BodyKind
from mindrun.kinds.registry import kinds
from mindrun.kinds.registry import names as kind_names
from mindrun.kinds.sensors.computed import Computed
from mindrun.kinds.sensors.sensor import Flaw, directions
from mindrun.numbers.quantity import SKILL
from msgspec.structs import replace

from mindlang.compiler import syntax
from mindlang.compiler.diagnostic import Findings, Label, a, listed
from mindlang.compiler.families import said
from mindlang.compiler.format import spaced
from mindlang.compiler.hierarchy import circles, reverse_topological_order
from mindlang.compiler.model import Part, Promise, source_graph
from mindlang.compiler.names import Names
from mindlang.compiler.resolve.expressions import Visible, Widths, resolve_expressions
from mindlang.compiler.resolve.kinds import Scope, make_kind
from mindlang.compiler.syntax import VERBS_OF, Declaration, Fact, Header, Maintains, Name, of_form, verb_of

MOST_READINGS = 20_000
ONE_OF_TWO = "Leave one of the two lines out."
ONE_LINE = "All that there is to say of it stands in its one line; set the fact below the skill or task it belongs to."

Parts = tuple[Part[Any], ...]
F = TypeVar("F", bound=Fact | Name)


def resolve_parts(noun: str, names: Names, findings: Findings) -> Parts:
    """The parts declared with a noun, as far as their kinds are well said; not those that are computed."""
    things = names.things()
    found = []
    for name, declaration in names.declarations(noun):
        refuse_facts(declaration, findings)
        phrase = None if declaration.header.at else declaration.header.phrase
        if phrase and (kind := make_kind(noun, phrase, Scope(names, things, whole=declaration.whole), findings)):
            found.append(Part(name, kind, declaration.header.name.span))
    return tuple(found)


def refuse_facts(declaration: Declaration, findings: Findings) -> None:
    """Report the facts of a declaration that do not stand below its noun.

    A line above them that could not be read may have been the header to which they belong.
    """
    noun = declaration.header.noun.text
    verbs = VERBS_OF.get(noun, ())
    for fact in declaration.facts if declaration.whole else ():
        if (verb := verb_of(fact)) not in verbs:
            hint = f"Below {noun} {declaration.header.name.text} can stand {listed(verbs)}." if verbs else ONE_LINE
            findings.error("foreign-fact", fact.span, f"{verb} does not belong to {a(noun)}.", hint)


def said_once(
    facts: Iterable[F],
    says: Callable[[F], str],
    findings: Findings,
    hint: str | Callable[[Sequence[F]], str] = "Leave one out.",
) -> list[F]:
    """The first of the facts of which the same is to be said where they are repeated; the others are reported so."""
    by_message: dict[str, list[F]] = {}
    for fact in facts:
        by_message.setdefault(says(fact), []).append(fact)
    for message, same in by_message.items():
        remedy = hint if isinstance(hint, str) else hint(same)
        findings.refuse_again("repeated-fact", [fact.span for fact in same], message, remedy)
    return [same[0] for same in by_message.values()]


def promises(declaration: Declaration, names: Names, widths: Widths, findings: Findings) -> tuple[Promise, ...]:
    """The promises of a skill in the order of their lines; they need not be of what it reads itself."""
    made_of, where = "numbers, sensors and memories", "What a skill promises"
    visible = Visible(widths, unread=names.unread, made_of=made_of, where=where)
    facts = of_form(declaration.facts, syntax.Promise)
    lines = said_once(facts, lambda fact: f"The skill already {spaced(said(fact))}.", findings, ONE_OF_TWO)
    return tuple(Promise(resolve_expressions(fact, visible, findings), fact) for fact in lines)


def memory_widths(names: Names, memories: Parts) -> dict[str, int]:
    """How many readings each memory has; one that could not be made is taken to have one."""
    return dict.fromkeys(names.of("memory"), 1) | {memory.name: memory.kind.width for memory in memories}


def sensors(names: Names, memories: Parts, findings: Findings) -> Parts:
    """The sensors with their widths, as they are declared; those that are computed from themselves are reported."""
    places = {memory.name for memory in memories if memory.kind.is_place}
    plain = {sensor.name: _of_place(sensor, places) for sensor in resolve_parts("sensor", names, findings)}
    formulas = {name: header for name, each in names.declarations("sensor") if (header := each.header).at}
    widths = _widths(plain, dict.fromkeys(formulas, 1) | memory_widths(names, memories))
    visible = Visible(widths, unread=names.unread, made_of="numbers, sensors and memories")
    for name, header in formulas.items():
        plain[name] = _computed(header, visible, findings)
    for name, sensor in plain.items():
        if sensor.kind.named(SKILL):
            plain[name] = replace(sensor, kind=_broken(sensor, names, visible, findings))
    found = tuple(replace(plain[name], width=widths[name]) for name in names.of("sensor") if name in plain)
    for circle in circles(source_graph(found)):
        message = f"A sensor is derived from itself: {' → '.join([*circle, circle[0]])}."
        findings.error("derivative-loop", plain[circle[0]].span, message, "Derive one of them from another sensor.")
    if (readings := sum(sensor.width for sensor in found)) > MOST_READINGS:
        widest = max(found, key=lambda sensor: sensor.width)
        message = f"With these {widest.width} the mind has {readings} readings."
        findings.error("too-many-readings", widest.span, message, f"A mind takes {MOST_READINGS}: leave some out.")
    kinds = {sensor.name: sensor.kind for sensor in found}
    around = directions(kinds)
    for sensor in (each for each in found if each.name not in formulas and not each.kind.named(SKILL)):
        if flaw := sensor.kind.flaw(widths, around) or sensor.kind.misfit(kinds):
            _report(flaw, names.table["sensor"][sensor.name].header, findings)
    for memory in memories:
        if flaw := memory.kind.flaw(kinds):
            _report(flaw, names.table["memory"][memory.name].header, findings)
    return found


def _report(flaw: Flaw, header: Header, findings: Findings) -> None:
    """Report a flaw where its argument stands."""
    arguments = header.phrase.arguments if header.phrase else ()
    places = (each.value.span for each in arguments if each.key.text == flaw.field)
    findings.error(flaw.code, next(places, header.span), flaw.message, flaw.hint)


def _of_place(sensor: Part[Any], places: Collection[str]) -> Part[Any]:
    """A sensor, reckoned where it is about a memory that is one of these places."""
    if not (sensor.kind.can_be_reckoned and sensor.kind.of in places):
        return sensor
    return replace(sensor, kind=replace_fields(sensor.kind, is_reckoned=True))


def _computed(header: Header, visible: Visible, findings: Findings) -> Part[Any]:
    """The sensor that is computed at an expression, or at one of two."""
    at, gate = resolve_expressions((header.at, header.gate), visible, findings)
    formula = at.formula if at else ()
    if gate and gate.otherwise:
        formula = (*formula, *gate.when.formula, ("when", 0), *gate.otherwise.formula, ("otherwise", 0))
    elif gate:
        hint = "Add what it reads where the condition does not hold: otherwise 0."
        findings.error("no-otherwise", gate.span, f"{header.name.text} reads nothing in other ticks.", hint)
    return Part(header.name.text, Computed(formula), header.name.span, at=at, gate=gate)


def _broken(sensor: Part[Any], names: Names, visible: Visible, findings: Findings) -> Any:
    """The kind of a sensor that says when a skill breaks what it maintains, with that: all of its lines at once."""
    skill = names.table.get("skill", {}).get(sensor.kind.broken)
    lines = of_form(skill.facts, Maintains) if skill else ()
    if skill and skill.whole and not lines:
        message = f"{sensor.kind.broken} maintains nothing that could be broken."
        hint = f"Say below skill {sensor.kind.broken} what it does: maintains battery > 5%."
        findings.error("nothing-to-break", names.table["sensor"][sensor.name].header.span, message, hint)
    formula: tuple[Any, ...] = ()
    for line in resolve_expressions(tuple(lines), visible, Findings()):  # mistakes are reported of the skill
        formula += (*line.formula, *[("and", 0)] * bool(formula))
    return type(sensor.kind)(sensor.kind.broken, formula)


def _widths(sensors: Mapping[str, Part[Any]], others: Mapping[str, int]) -> dict[str, int]:
    """How many readings each sensor and memory has, given those of `others`; as many as its source where none says."""
    shapes = {name: each.kind.shape for name, each in sensors.items()}
    widths = {**others} | {name: prod(shape) for name, shape in shapes.items() if shape is not None}
    sources_first = (name for name in reverse_topological_order(source_graph(sensors.values())) if name in sensors)
    for name in (*sources_first, *sensors):
        widths.setdefault(name, widths.get(sensors[name].kind.source, 1))
    return widths


def check_drives(body: Part[BodyKind], actuators: Sequence[Part[ActuatorKind]], findings: Findings) -> None:
    """Report actuators that would do nothing on a body, and a second steering."""
    is_ = kind_names()[type(body.kind)]
    for actuator in actuators:
        drive = actuator.kind.drive
        if drive is not None and drive not in body.kind.drives:
            bodies = listed(a(kind) for kind, cls in kinds("body").items() if drive in cls.drives)
            hint = f"{a(is_).capitalize()} takes {listed(body.kind.drives)}; {drive} belongs to {bodies}."
            message = f"{a(drive).capitalize()} does nothing on {a(is_)}."
            findings.error("foreign-drive", actuator.span, message, hint, Label(body.span, "the body"))
    if "steering" in body.kind.drives:
        steering = [each.span for each in actuators if each.kind.drive == "steering"]
        hint = "Leave one of the two out, or let one be a servo."
        findings.refuse_again("second-steering", steering, "A car has one steering.", hint, "the first one")
