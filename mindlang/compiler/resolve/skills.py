"""Skills: what they read, what they drive and influence, and that their function fits.

Those that are like others have the same function and weights, and read, drive or influence something else.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from mindrun.graph.graph import Receiver
from mindrun.kinds.functions.function import Function
from mindrun.kinds.functions.procedure import is_inside
from mindrun.numbers.quantity import RATIO
from msgspec.structs import replace
from networkx import DiGraph

from mindlang.compiler import model, syntax
from mindlang.compiler.diagnostic import Findings, listed
from mindlang.compiler.hierarchy import refuse_circles, reverse_topological_order
from mindlang.compiler.names import DRIVABLE_NOUNS, NAMED_NOUNS, Names
from mindlang.compiler.resolve.expressions import Visible, Widths, resolve_expressions
from mindlang.compiler.resolve.kinds import Scope, make_kind
from mindlang.compiler.resolve.parts import ONE_OF_TWO, promises, refuse_facts, said_once
from mindlang.compiler.resolve.quantities import convert
from mindlang.compiler.syntax import (
    Chooses,
    Declaration,
    Drives,
    Influences,
    Promise,
    Reads,
    Sends,
    Stays,
    Term,
    Uses,
    of_form,
    rebuilt,
    verb_of,
)

STATES: Mapping[type[Stays] | type[Chooses], tuple[str, str]] = {Stays: ("stay", "frozen"), Chooses: ("choose", "one")}


def skills(names: Names, widths: Widths, findings: Findings) -> tuple[model.Skill, ...]:
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
        known[name] = alike(declared[name], known.get(like[name]), names, widths, findings)
    return tuple(known.get(name) or unsaid(each) for name, each in declared.items())


def _skill(name: str, declaration: Declaration, names: Names, widths: Widths, findings: Findings) -> model.Skill:
    refuse_facts(declaration, findings)
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
    promised = promises(declaration, names, widths, findings)
    files = _files(declaration, function, findings)
    return model.Skill(
        name, function, reads, edges, frozen, declaration, chooses=chooses, promises=promised, files=files
    )


def _reads(declaration: Declaration, names: Names, findings: Findings) -> tuple[str, ...]:
    known = []
    for fact in of_form(declaration.facts, Reads):
        _refuse_for(declaration, fact, findings)
        if names.find(fact.name, ("sensor", "memory"), findings):
            known.append(fact)
    return tuple(fact.name.text for fact in said_once(known, _repeated, findings, ONE_OF_TWO))


def _refuse_for(declaration: Declaration, fact: Reads | Sends, findings: Findings) -> None:
    """Report a `for` in a skill that is like no other."""
    if fact.stands_for:
        message = f"{declaration.header.name.text} is like no other skill, so nothing stands for something else in it."
        hint = f"Write {syntax.verb_of(fact)} {fact.name.text}."
        findings.error("for-without-like", fact.stands_for.span, message, hint)


def _repeated(fact: Reads | Drives | Influences) -> str:
    return f"The skill already {syntax.verb_of(fact)} {fact.name.text}."


def _edges(declaration: Declaration, names: Names, visible: Visible, findings: Findings) -> tuple[model.Edge, ...]:
    edges: list[model.Edge] = []
    over: tuple[str, ...]
    for fact in (fact for fact in declaration.facts if isinstance(fact, Drives | Influences)):
        cuts, over = None, ()
        _refuse_for(declaration, fact, findings)
        to: Any = names.find(fact.name, NAMED_NOUNS[type(fact)]["name"], findings)
        if isinstance(fact, Influences):
            cuts = convert(fact.cuts, RATIO, findings) if fact.cuts else None
            over = _over(fact, names, findings)
        at = resolve_expressions(fact.at, visible, findings)
        gate = resolve_expressions(fact.gate, visible, findings)
        if to:
            edges.append(model.Edge(to, fact.name.text, at, fact, gate, cuts or 0.0, over))
    first = set(said_once((edge.fact for edge in edges), _repeated, findings, _on_one_line))
    return tuple(edge for edge in edges if edge.fact in first)


def _on_one_line(facts: Sequence[Drives | Influences]) -> str:
    """What to write instead of several lines about the same: one, over all that they are over where they are alike."""
    over = [fact.over for fact in facts if isinstance(fact, Influences) and fact.over]
    if not over:
        return ONE_OF_TWO
    pairs = zip(facts, over, strict=True) if len(over) == len(facts) else ()
    rests = {fact.span.source.text[names[-1].span.end : fact.span.end].strip() for fact, names in pairs}
    skill, names = facts[0].name.text, dict.fromkeys(name.text for names in over for name in names)
    if len(rests) == 1:
        return f"Write influences {' '.join((skill, 'over', listed(names, 'and'), *filter(None, rests)))}."
    return f"One line has one value: send the other to a skill between, skill Via is rule with influences {skill} at 1."


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
    return bool(said_once(right, lambda _: f"The skill already {verb}s {word}.", findings, ONE_OF_TWO)) and not is_idle


def _files(declaration: Declaration, function: Function | None, findings: Findings) -> tuple[str, ...]:
    """The files that the procedure of a skill uses, each once; whether they are there says who reads its module."""
    said = of_form(declaration.facts, Uses)
    if said and function and function.calls is None:
        message = f"{declaration.header.name.text} is no procedure, and reads no file."
        findings.error("foreign-fact", said[0].span, message, "Leave the line out.")
        return ()
    for fact in (each for each in said if not is_inside(each.file.text)):
        hint = "A procedure uses files in the folder of the mind or below it: models/policy.pt"
        findings.error("outside-project", fact.file.span, f'"{fact.file.text}" is not inside the project.', hint)
    once = said_once(said, lambda fact: f"The skill already uses {fact.file.text}.", findings, ONE_OF_TWO)
    return tuple(fact.file.text for fact in once)


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


def unsaid(declaration: Declaration) -> model.Skill:
    """A skill that is not well said, which has no function."""
    function: Any = None
    return model.Skill(declaration.header.name.text, function, (), (), False, declaration)


def alike(own: Declaration, other: model.Skill | None, names: Names, widths: Widths, findings: Findings) -> model.Skill:
    """A skill that is like another, None where there is no such one, with something else in the place of its names."""
    name, like = own.header.name.text, own.header.like
    if other is None and like:
        names.find(like, ("skill",), findings)
    if other is None or not other.function or not like:
        return unsaid(own)
    if not other.function.learns:
        message = f"{other.name} learns nothing, so it has no weights that {name} could share."
        hint = f"Say what {name} is, and repeat the lines of {other.name}."
        findings.error("like-no-learner", like.span, message, hint)
        return unsaid(own)
    for more in (fact for fact in own.facts if not isinstance(fact, Reads | Sends | Promise) or _says_more(fact)):
        message = f"{name} is like {other.name}, so it only says what it reads, drives or influences in place of that."
        hint = f"Take this line out, or say it of {other.name}: it holds for both."
        findings.error("like-says-more", more.span, message, hint)
    read, driven, influenced = (
        _instead(own, form, other, widths, names, findings) for form in (Reads, Drives, Influences)
    )
    reads = tuple(read.get(each, (each,))[0] for each in other.reads)
    sent = driven | influenced
    edges = tuple(_edge(edge, sent.get(edge.target, (edge.target, edge.to)), read) for edge in other.edges)
    become = {Reads: reads, Sends: tuple(edge.target for edge in edges)}
    for form, names_ in become.items():
        lines: list[Any] = of_form(own.facts, form)
        if twice := next((fact for fact in lines if names_.count(fact.name.text) > 1), None):
            message = f"{name} would {verb_of(twice).removesuffix('s')} {twice.name.text} twice."
            findings.error("repeated-input", twice.span, message, "Write something else in this line.")
    promised = promises(own, names, widths, findings)
    return model.Skill(name, other.function, reads, edges, False, own, other.owner, other.chooses, promised)


def _says_more(fact: Reads | Sends | Promise) -> bool:
    """True if a line says which value it sends, when, or over what."""
    return isinstance(fact, Sends) and bool(
        fact.at or fact.gate or (isinstance(fact, Influences) and (fact.cuts or fact.over))
    )


def _edge(edge: model.Edge, sent: tuple[str, Receiver], read: Mapping[str, tuple[str, str]]) -> model.Edge:
    """An edge to where it is sent instead, with what is read instead in its expressions."""

    def reading(node: Any) -> Any:
        is_read = isinstance(node, Term) and node.word == "reading" and node.operand in read
        return replace(node, operand=read[node.operand][0]) if is_read else node

    target, to = sent
    return replace(edge, to=to, target=target, at=rebuilt(edge.at, reading), gate=rebuilt(edge.gate, reading))


def _instead(
    own: Declaration, form: type[Any], other: model.Skill, widths: Widths, names: Names, findings: Findings
) -> dict[str, tuple[str, Any]]:
    """Name and noun of what stands for something that the other skill reads or sends to, by the name of that."""
    found = ((fact, names.find(fact.name, NAMED_NOUNS[form]["name"], findings)) for fact in of_form(own.facts, form))
    nouns = {fact: noun for fact, noun in found if noun and not _says_more(fact)}
    instead = {fact: replaced for fact in nouns if (replaced := _replaced(fact, other, widths, names, findings))}
    said_once(instead, lambda fact: f"Something stands for {instead[fact]} already.", findings, ONE_OF_TWO)
    return {replaced: (fact.name.text, nouns[fact]) for fact, replaced in instead.items()}


def _replaced(fact: Reads | Sends, other: model.Skill, widths: Widths, names: Names, findings: Findings) -> str:
    """What a line replaces of the other skill, an input by one of its width; empty after reporting an error."""
    name, verb = fact.name.text, verb_of(fact)
    sent = tuple(edge.target for edge in other.edges if edge.to in NAMED_NOUNS[type(fact)]["name"])
    known = other.reads if isinstance(fact, Reads) else sent
    has = f"{other.name} {verb} {listed(known, 'and') if known else 'nothing'}."
    if fact.stands_for is None:
        message = f"It is not said what {name} stands for."
        hint = f"Write {verb} {name} for {'INPUT' if isinstance(fact, Reads) else 'NAME'}: {has}"
        findings.error("stands-for-nothing", fact.span, message, hint)
        return ""
    replaced = fact.stands_for.text
    if replaced not in known:
        if replaced not in names.unread and other.declaration.whole:
            message = f"{other.name} does not {verb.removesuffix('s')} {replaced}."
            findings.error("no-such-input", fact.stands_for.span, message, has)
        return ""
    own, width = (widths.get(each, 1) if isinstance(fact, Reads) else 1 for each in (name, replaced))
    if own != width:
        message = f"{name} has {_readings(own)}, {replaced} has {_readings(width)}."
        hint = f"The weights of {other.name} fit a sensor with {_readings(width)} in its place."
        findings.error("other-width", fact.name.span, message, hint)
    return replaced if own == width else ""


def _readings(width: int) -> str:
    return "one reading" if width == 1 else f"{width} readings"
