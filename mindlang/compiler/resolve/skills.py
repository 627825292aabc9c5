"""Skills: what they read, what they drive and influence, that their function fits, and those that are like others."""

from collections.abc import Mapping, Sequence
from typing import Any

from mindrun.graph.graph import Receiver
from mindrun.kinds.functions.function import Function
from mindrun.numbers.quantity import RATIO
from msgspec.structs import replace
from networkx import DiGraph

from mindlang.compiler import model, syntax
from mindlang.compiler.diagnostic import Findings, listed
from mindlang.compiler.hierarchy import refuse_circles, reverse_topological_order
from mindlang.compiler.names import Names
from mindlang.compiler.references import DRIVABLE_NOUNS
from mindlang.compiler.resolve.expressions import Visible, resolve_expressions
from mindlang.compiler.resolve.kinds import Scope, make_kind
from mindlang.compiler.resolve.parts import refuse_facts, said_once
from mindlang.compiler.resolve.quantities import convert
from mindlang.compiler.syntax import (
    Chooses,
    Declaration,
    Drives,
    Influences,
    Reads,
    Sends,
    Stays,
    Term,
    of_form,
    rebuilt,
)  # fmt: skip

ONE = "Leave one of the two lines out."
STATES: Mapping[type[Stays] | type[Chooses], tuple[str, str]] = {Stays: ("stay", "frozen"), Chooses: ("choose", "one")}


def skills(names: Names, widths: Mapping[str, int], findings: Findings) -> tuple[model.Skill, ...]:
    """Every skill, without the lines that are reported; one that is not well said has no function."""
    declared = dict(names.declarations("skill"))
    known = {
        name: _skill(name, declaration, names, widths, findings)
        for name, declaration in declared.items()
        if not declaration.header.like
    }
    like = {name: each.header.like.text for name, each in declared.items() if each.header.like}
    hint = "Say of one of them what it is: skill NAME is mlp hidden 2."
    for name in (name for name, other in like.items() if name == other):
        findings.error("like-circle", declared[name].header.span, f"{name} is like itself.", hint)
    graph = DiGraph()
    graph.add_nodes_from(like)
    others = ((name, other, {"span": declared[name].header.span}) for name, other in like.items())
    graph.add_edges_from(edge for edge in others if edge[0] != edge[1])
    says = "Skills are like one another in a circle"
    refuse_circles("like-circle", graph, findings, says, hint, "and from there on")
    for name in (each for each in reverse_topological_order(graph) if each in like):
        known[name] = _alike(declared[name], known.get(like[name]), names, widths, findings)
    return tuple(known.get(name) or _unsaid(each) for name, each in declared.items())


def _unsaid(declaration: Declaration) -> model.Skill:
    function: Any = None
    return model.Skill(declaration.header.name.text, function, (), (), False, declaration)


def _skill(
    name: str, declaration: Declaration, names: Names, widths: Mapping[str, int], findings: Findings
) -> model.Skill:
    refuse_facts(declaration, ("reads", "drives", "influences", "chooses", "stays"), findings)
    phrase = declaration.header.phrase
    function: Any = make_kind("skill", phrase, Scope(names, None), findings) if phrase else None
    reads = _reads(declaration, names, findings)
    # A line that could not be read may have been an input.
    all_read = declaration.whole and len(reads) == len(of_form(declaration.facts, Reads))
    visible = Visible(
        {read: widths[read] for read in reads} if all_read else widths, elsewhere=widths, unread=names.unread
    )
    edges = _edges(declaration, names, visible, findings)
    if function and declaration.whole:
        _check_works(declaration, function, edges, findings)
    frozen, chooses = (_is_so(declaration, form, findings) for form in (Stays, Chooses))
    return model.Skill(name, function, reads, edges, frozen, declaration, chooses=chooses)


def _reads(declaration: Declaration, names: Names, findings: Findings) -> tuple[str, ...]:
    known = []
    for fact in of_form(declaration.facts, Reads):
        if fact.stands_for:
            message = f"{declaration.header.name.text} is like no other skill, so nothing stands for an input of it."
            findings.error("for-without-like", fact.stands_for.span, message, f"Write reads {fact.name.text}.")
        if names.find(fact.name, ("sensor", "memory"), findings):
            known.append(fact)
    return tuple(fact.name.text for fact in said_once(known, _repeated, findings, ONE))


def _repeated(fact: Reads | Drives | Influences) -> str:
    return f"The skill already {syntax.verb_of(fact)} {fact.name.text}."


def _edges(declaration: Declaration, names: Names, visible: Visible, findings: Findings) -> tuple[model.Edge, ...]:
    edges: list[model.Edge] = []
    to: Receiver | None
    over: tuple[str, ...]
    for fact in (fact for fact in declaration.facts if isinstance(fact, Drives | Influences)):
        cuts, over = None, ()
        if isinstance(fact, Drives):
            to = names.find(fact.name, DRIVABLE_NOUNS, findings)
        else:
            to = names.find(fact.name, ("skill",), findings)
            cuts = convert(fact.cuts, RATIO, findings) if fact.cuts else None
            over = _over(fact, names, findings)
        at = resolve_expressions(fact.at, visible, findings)
        gate = resolve_expressions(fact.gate, visible, findings)
        if to:
            edges.append(model.Edge(to, fact.name.text, at, fact, gate, cuts or 0.0, over))
    first = set(said_once((edge.fact for edge in edges), _repeated, findings, ONE))
    return tuple(edge for edge in edges if edge.fact in first)


def _over(fact: Influences, names: Names, findings: Findings) -> tuple[str, ...]:
    """The actuators and memories over which an influence counts alone, by name; none where it counts for all."""
    known = [name for name in fact.over or () if names.find(name, DRIVABLE_NOUNS, findings)]
    over = said_once(known, lambda name: f"The influence is already over {name.text}.", findings, "Leave one out.")
    return tuple(sorted(name.text for name in over))


def _is_so(declaration: Declaration, form: type[Stays] | type[Chooses], findings: Findings) -> bool:
    """True if a skill says `stays frozen` or `chooses one`, by the form of the line."""
    said, (verb, word) = of_form(declaration.facts, form), STATES[form]
    for how in (fact.how for fact in said if fact.how.text != word):
        hint = f"Write {verb}s {word}, or leave the line out."
        findings.error("unknown-state", how.span, f"A skill cannot {verb} {how.text}.", hint)
    right = [fact for fact in said if fact.how.text == word]
    is_idle = form is Chooses and declaration.whole and not of_form(declaration.facts, Influences)
    for fact in right if is_idle else ():
        hint = "Add influences and a skill, twice or more, or leave the line out."
        findings.error(
            "nothing-to-choose", fact.span, f"{declaration.header.name.text} has no influence to choose.", hint
        )
    return bool(said_once(right, lambda _: f"The skill already {verb}s {word}.", findings, ONE)) and not is_idle


def _check_works(declaration: Declaration, function: Function, edges: Sequence[model.Edge], findings: Findings) -> None:
    """Report a function that has nothing to work on; lines that are missing because they are wrong count as there."""
    name = declaration.header.name
    sent = of_form(declaration.facts, Sends)
    if not sent:
        hint = "Add drives and an actuator, or influences and a skill."
        findings.error("idle-skill", name.span, f"{name.text} drives nothing and influences nothing.", hint)
    elif not function.has_outputs:
        for edge in (each for each in edges if each.at is None):
            hint = "A rule has no function of its own: write at and the value, for example at 1."
            findings.error("missing-at", edge.fact.span, "This line of a rule does not say its value.", hint)
    elif all(fact.at for fact in sent):
        hint = f"Write skill {name.text} is rule, or leave at out of a line."
        message = f"Every line of {name.text} says its value, so its function has none."
        findings.error("no-outputs", name.span, message, hint)
    if function.learns and not of_form(declaration.facts, Reads):
        hint = "Add reads and a sensor, or make it a rule with at on every line."
        findings.error("no-inputs", name.span, f"{name.text} reads nothing, so it has nothing to learn from.", hint)


def _alike(
    own: Declaration, other: model.Skill | None, names: Names, widths: Mapping[str, int], findings: Findings
) -> model.Skill:
    """A skill that is like another, None where there is no such one: the same function, which reads something else."""
    name, like = own.header.name.text, own.header.like
    if other is None and like:
        names.find(like, ("skill",), findings)
    if other is None or not other.function or not like:
        return _unsaid(own)
    if not other.function.learns:
        message = f"{other.name} learns nothing, so it has no weights that {name} could share."
        hint = f"Say what {name} is, and repeat the lines of {other.name}."
        findings.error("like-no-learner", like.span, message, hint)
        return _unsaid(own)
    for more in (fact for fact in own.facts if not isinstance(fact, Reads)):
        message = f"{name} is like {other.name}, so it only says what it reads in place of that."
        hint = f"Take this line out, or say it of {other.name}: it holds for both."
        findings.error("like-says-more", more.span, message, hint)
    lines = of_form(own.facts, Reads)
    known = [fact for fact in lines if names.find(fact.name, ("sensor", "memory"), findings)]
    replaced = ((fact, _replaced(fact, other, names, widths, findings)) for fact in known)
    instead = {fact: input_ for fact, input_ in replaced if input_}
    said_once(instead, lambda fact: f"Something stands for {instead[fact]} already.", findings, ONE)
    read = {input_: fact.name.text for fact, input_ in instead.items()}
    reads = tuple(read.get(each, each) for each in other.reads)
    if twice := next((fact for fact in lines if reads.count(fact.name.text) > 1), None):
        message = f"{name} would read {twice.name.text} twice."
        findings.error("repeated-input", twice.span, message, "Let it read something else here.")

    def reading(node: Any) -> Any:
        is_read = isinstance(node, Term) and node.word == "reading"
        return replace(node, operand=read.get(node.operand, node.operand)) if is_read else node

    edges = tuple(replace(edge, at=rebuilt(edge.at, reading), gate=rebuilt(edge.gate, reading)) for edge in other.edges)
    return model.Skill(name, other.function, reads, edges, False, own, other.owner, other.chooses)


def _replaced(fact: Reads, other: model.Skill, names: Names, widths: Mapping[str, int], findings: Findings) -> str:
    """The input of the other skill that a line replaces, with as many readings; empty after reporting an error."""
    name = fact.name.text
    reads = f"{other.name} reads {listed(other.reads, 'and') if other.reads else 'nothing'}."
    if fact.stands_for is None:
        message = f"It is not said for which input of {other.name} {name} stands."
        findings.error("stands-for-nothing", fact.span, message, f"Write reads {name} for INPUT: {reads}")
        return ""
    replaced = fact.stands_for.text
    if replaced not in other.reads:
        if replaced not in names.unread and other.declaration.whole:
            message = f"{other.name} does not read {replaced}."
            findings.error("no-such-input", fact.stands_for.span, message, reads)
        return ""
    own, width = widths.get(name, 1), widths.get(replaced, 1)
    if own != width:
        message = f"{name} has {_readings(own)}, {replaced} has {_readings(width)}."
        hint = f"The weights of {other.name} fit a sensor with {_readings(width)} in its place."
        findings.error("other-width", fact.name.span, message, hint)
    return replaced if own == width else ""


def _readings(width: int) -> str:
    return "one reading" if width == 1 else f"{width} readings"
