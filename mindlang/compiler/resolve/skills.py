"""Skills: what they read, what they drive and influence, and that their function fits."""

from collections.abc import Mapping
from typing import Any

from mindrun.graph.graph import Receiver
from mindrun.kinds.functions.function import Function
from mindrun.numbers.quantity import RATIO

from mindlang.compiler import model, syntax
from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.names import Names
from mindlang.compiler.resolve.expressions import Visible, condition, resolve
from mindlang.compiler.resolve.kinds import Scope, make
from mindlang.compiler.resolve.likeness import alike
from mindlang.compiler.resolve.parts import refuse_facts
from mindlang.compiler.resolve.quantities import convert
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Declaration, Drives, Influences, Reads, Stays


def skills(names: Names, widths: Mapping[str, int], findings: Findings) -> tuple[model.Skill, ...]:
    """Every skill, without the lines that are reported."""
    declared = dict(names.declarations("skill"))
    own = {
        name: _skill(name, declaration, names, widths, findings)
        for name, declaration in declared.items()
        if not declaration.header.like
    }
    known = own | alike(own, names, widths, findings)
    return tuple(known[name] for name in declared)


def _skill(
    name: str, declaration: Declaration, names: Names, widths: Mapping[str, int], findings: Findings
) -> model.Skill:
    refuse_facts(declaration, (Reads, Drives, Influences, Stays), findings)
    phrase = declaration.header.phrase
    function: Any = make("skill", phrase, Scope(names, None), findings) if phrase else None
    reads = _reads(declaration, names, findings)
    # A line that could not be read may have been an input.
    all_read = declaration.whole and len(reads) == sum(isinstance(fact, Reads) for fact in declaration.facts)
    visible = Visible(
        {read: widths[read] for read in reads} if all_read else widths, elsewhere=widths, unread=names.unread
    )
    edges = _edges(declaration, names, visible, findings)
    if function:
        _check(declaration, function, reads, edges, findings)
    return model.Skill(name, function, reads, edges, _is_frozen(declaration, findings), declaration)


def _reads(declaration: Declaration, names: Names, findings: Findings) -> tuple[str, ...]:
    found: dict[str, Span] = {}
    for fact in declaration.facts:
        if isinstance(fact, Reads) and fact.stands_for:
            message = f"{declaration.header.name.text} is like no other skill, so nothing stands for an input of it."
            findings.error("for-without-like", fact.stands_for.span, message, f"Write reads {fact.name.text}.")
        if isinstance(fact, Reads) and names.find(fact.name, ("sensor", "memory"), findings):
            _once(found, fact.name.text, fact.span, "reads", findings)
    return tuple(found)


def _edges(declaration: Declaration, names: Names, visible: Visible, findings: Findings) -> tuple[model.Edge, ...]:
    edges = []
    seen: dict[str, Span] = {}
    to: Receiver | None
    for fact in declaration.facts:
        match fact:
            case Drives():
                to = names.find(fact.name, ("actuator", "memory"), findings)
            case Influences():
                to = names.find(fact.name, ("skill",), findings)
            case _:
                continue
        at = resolve(fact.at, visible, findings) if fact.at else None
        gate = _gate(fact.gate, visible, findings) if fact.gate else None
        cuts = convert(fact.cuts, RATIO, findings) if isinstance(fact, Influences) and fact.cuts else None
        verb = type(fact).__name__.lower()
        if to and _once(seen, fact.name.text, fact.span, verb, findings):
            edges.append(model.Edge(to, fact.name.text, at, fact, gate, cuts or 0.0))
    return tuple(edges)


def _gate(gate: syntax.Gate, visible: Visible, findings: Findings) -> model.Gate:
    otherwise = resolve(gate.otherwise, visible, findings) if gate.otherwise else None
    return model.Gate(condition(gate.when, visible, findings), otherwise)


def _is_frozen(declaration: Declaration, findings: Findings) -> bool:
    seen: dict[str, Span] = {}
    for fact in declaration.facts:
        if isinstance(fact, Stays) and fact.how.text != "frozen":
            hint = "Write stays frozen, or leave the line out."
            findings.error("unknown-state", fact.how.span, f"A skill cannot stay {fact.how.text}.", hint)
        elif isinstance(fact, Stays):
            _once(seen, "frozen", fact.span, "stays", findings)
    return bool(seen)


def _once(seen: dict[str, Span], name: str, span: Span, verb: str, findings: Findings) -> bool:
    if name in seen:
        first = Label(seen[name], "first said here")
        findings.error(
            "repeated-fact", span, f"The skill already {verb} {name}.", "Leave one of the two lines out.", first
        )
        return False
    seen[name] = span
    return True


def _check(
    declaration: Declaration,
    function: Function,
    reads: tuple[str, ...],
    edges: tuple[model.Edge, ...],
    findings: Findings,
) -> None:
    """Report a function that has nothing to work on; lines that are missing because they are wrong count as there."""
    if not declaration.whole:
        return
    name = declaration.header.name
    if not any(isinstance(fact, Drives | Influences) for fact in declaration.facts):
        hint = "Add drives and an actuator, or influences and a skill."
        findings.error("idle-skill", name.span, f"{name.text} drives nothing and influences nothing.", hint)
    elif not function.has_outputs:
        for edge in edges:
            if edge.at is None:
                hint = "A rule has no function of its own: write at and the value, for example at 1."
                findings.error("missing-at", edge.fact.span, "This line of a rule does not say its value.", hint)
    elif all(fact.at for fact in declaration.facts if isinstance(fact, Drives | Influences)):
        hint = f"Write skill {name.text} is rule, or leave at out of a line."
        findings.error(
            "no-outputs", name.span, f"Every line of {name.text} says its value, so its function has none.", hint
        )
    if function.learns and not any(isinstance(fact, Reads) for fact in declaration.facts):
        hint = "Add reads and a sensor, or make it a rule with at on every line."
        findings.error("no-inputs", name.span, f"{name.text} reads nothing, so it has nothing to learn from.", hint)
