"""Skills that are like others: the same function and weights, which read, drive or influence something else."""

from collections.abc import Mapping
from typing import Any

from mindrun.graph.graph import Receiver
from msgspec.structs import replace

from mindlang.compiler import model
from mindlang.compiler.diagnostic import Findings, listed
from mindlang.compiler.names import Names
from mindlang.compiler.references import DRIVABLE_NOUNS, READABLE_NOUNS
from mindlang.compiler.resolve.parts import ONE_OF_TWO, promises, said_once
from mindlang.compiler.syntax import (
    Declaration,
    Drives,
    Influences,
    Promise,
    Reads,
    Sends,
    Term,
    of_form,
    rebuilt,
    verb_of,
)

# The nouns of what stands for something.
NOUNS: Mapping[type[Any], tuple[str, ...]] = {
    Reads: READABLE_NOUNS,
    Drives: DRIVABLE_NOUNS,
    Influences: ("skill",),
}


def unsaid(declaration: Declaration) -> model.Skill:
    """A skill that is not well said, which has no function."""
    function: Any = None
    return model.Skill(declaration.header.name.text, function, (), (), False, declaration)


def alike(
    own: Declaration, other: model.Skill | None, names: Names, widths: Mapping[str, int], findings: Findings
) -> model.Skill:
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
    read, driven, influenced = (_instead(own, form, other, widths, names, findings) for form in NOUNS)
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
    own: Declaration, form: type[Any], other: model.Skill, widths: Mapping[str, int], names: Names, findings: Findings
) -> dict[str, tuple[str, Any]]:
    """Name and noun of what stands for something that the other skill reads or sends to, by the name of that."""
    found = ((fact, names.find(fact.name, NOUNS[form], findings)) for fact in of_form(own.facts, form))
    nouns = {fact: noun for fact, noun in found if noun and not _says_more(fact)}
    instead = {fact: replaced for fact in nouns if (replaced := _replaced(fact, other, widths, names, findings))}
    said_once(instead, lambda fact: f"Something stands for {instead[fact]} already.", findings, ONE_OF_TWO)
    return {replaced: (fact.name.text, nouns[fact]) for fact, replaced in instead.items()}


def _replaced(
    fact: Reads | Sends, other: model.Skill, widths: Mapping[str, int], names: Names, findings: Findings
) -> str:
    """What a line replaces of the other skill, an input by one of its width; empty after reporting an error."""
    name, verb = fact.name.text, verb_of(fact)
    sent = tuple(edge.target for edge in other.edges if edge.to in NOUNS[type(fact)])
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
