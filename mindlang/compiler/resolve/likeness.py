"""Skills that are like others: the same function with the same weights, which reads something else."""

from collections.abc import Mapping, Sequence
from typing import Any

from msgspec.structs import astuple, replace
from networkx import DiGraph

from mindlang.compiler import model
from mindlang.compiler.diagnostic import Findings, Label, listed
from mindlang.compiler.hierarchy import circles, ends_first
from mindlang.compiler.names import Names
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Declaration, Reads


def alike(
    own: Mapping[str, model.Skill], names: Names, widths: Mapping[str, int], findings: Findings
) -> dict[str, model.Skill]:
    """Every skill that is like another, `own` are those that are not; one that is not well said has no function."""
    found = dict(own)
    declared = {name: each for name, each in names.declarations("skill") if each.header.like}
    graph = DiGraph()
    graph.add_nodes_from(declared)
    graph.add_edges_from((name, _other(each)) for name, each in declared.items())
    for circle in circles(graph):
        _report_circle(circle, declared, findings)
    for name in (each for each in ends_first(graph) if each in declared):
        found[name] = _Likeness(declared[name], found.get(_other(declared[name])), names, widths, findings).skill()
    return {name: found.get(name) or _unknown(name, each) for name, each in declared.items()}


def _other(declaration: Declaration) -> str:
    """The skill that a skill says it is like."""
    assert declaration.header.like
    return declaration.header.like.text


def _unknown(name: str, declaration: Declaration) -> model.Skill:
    function: Any = None
    return model.Skill(name, function, (), (), False, declaration)


def _report_circle(circle: Sequence[str], declared: Mapping[str, Declaration], findings: Findings) -> None:
    first, *others = (declared[name].header.span for name in circle)
    path = " → ".join([*circle, circle[0]])
    message = f"Skills are like one another in a circle: {path}." if others else f"{circle[0]} is like itself."
    hint = "Say of one of them what it is: skill NAME is mlp hidden 2."
    findings.error("like-circle", first, message, hint, *(Label(span, "and from there on") for span in others))


class _Likeness:
    """A skill that is like `other`, None where there is no such skill."""

    def __init__(
        self,
        declaration: Declaration,
        other: model.Skill | None,
        names: Names,
        widths: Mapping[str, int],
        findings: Findings,
    ) -> None:
        self.declaration, self.other, self.names, self.widths, self.findings = (
            declaration, other, names, widths, findings,
        )  # fmt: skip
        self.name, self.like = declaration.header.name.text, declaration.header.like

    def skill(self) -> model.Skill:
        """The other skill with what it reads instead; without a function after reporting what is wrong with it."""
        assert self.like
        before = len(self.findings.diagnostics)
        other = self.other
        if other is None:
            self.names.find(self.like, ("skill",), self.findings)
        elif other.function and not other.function.learns:
            message = f"{other.name} learns nothing, so it has no weights that {self.name} could share."
            hint = f"Say what {self.name} is, and repeat the lines of {other.name}."
            self.findings.error("like-no-learner", self.like.span, message, hint)
        if other is None or not other.function or len(self.findings.diagnostics) > before:
            return _unknown(self.name, self.declaration)
        self._refuse_more(other)
        instead = self._instead(other)
        reads = tuple(instead.get(name, name) for name in other.reads)
        self._refuse_twice(reads)
        edges = _reading(other.edges, instead)
        return model.Skill(self.name, other.function, reads, edges, False, self.declaration, other.owner)

    def _refuse_more(self, other: model.Skill) -> None:
        for fact in self.declaration.facts:
            if not isinstance(fact, Reads):
                message = f"{self.name} is like {other.name}, so it only says what it reads in place of that."
                hint = f"Take this line out, or say it of {other.name}: it holds for both."
                self.findings.error("like-says-more", fact.span, message, hint)

    def _instead(self, other: model.Skill) -> dict[str, str]:
        """What is read in place of what the other one reads, by its name."""
        found: dict[str, Span] = {}
        instead: dict[str, str] = {}
        for fact in (fact for fact in self.declaration.facts if isinstance(fact, Reads)):
            known = self.names.find(fact.name, ("sensor", "memory"), self.findings)
            if known and self._stands(fact, other):
                assert fact.stands_for
                replaced = fact.stands_for.text
                if replaced in found:
                    label = Label(found[replaced], "first said here")
                    message = f"Something stands for {replaced} already."
                    self.findings.error("repeated-fact", fact.span, message, "Leave one of the two lines out.", label)
                found[replaced] = fact.span
                instead[replaced] = fact.name.text
        return instead

    def _stands(self, fact: Reads, other: model.Skill) -> bool:
        """Whether a line says for which input of the other one its own stands, and has as many readings."""
        name = fact.name.text
        reads = f"{other.name} reads {listed(other.reads, 'and') if other.reads else 'nothing'}."
        if fact.stands_for is None:
            message = f"It is not said for which input of {other.name} {name} stands."
            self.findings.error("stands-for-nothing", fact.span, message, f"Write reads {name} for INPUT: {reads}")
            return False
        replaced = fact.stands_for.text
        if replaced not in other.reads:
            if replaced not in self.names.unread and other.declaration.whole:
                message = f"{other.name} does not read {replaced}."
                self.findings.error("no-such-input", fact.stands_for.span, message, reads)
            return False
        own, width = self.widths.get(name, 1), self.widths.get(replaced, 1)
        if own != width:
            message = f"{name} has {_readings(own)}, {replaced} has {_readings(width)}."
            hint = f"The weights of {other.name} fit a sensor with {_readings(width)} in its place."
            self.findings.error("other-width", fact.name.span, message, hint)
        return own == width

    def _refuse_twice(self, reads: Sequence[str]) -> None:
        for fact in (fact for fact in self.declaration.facts if isinstance(fact, Reads)):
            if reads.count(fact.name.text) > 1:
                message = f"{self.name} would read {fact.name.text} twice."
                self.findings.error("repeated-input", fact.span, message, "Let it read something else here.")
                return


def _reading(node: Any, instead: Mapping[str, str]) -> Any:
    """An edge, or a part of one, whose values are computed of what is read instead."""
    match node:
        case model.Reading(name=name):
            return replace(node, name=instead.get(name, name))
        case tuple():
            return tuple(_reading(each, instead) for each in node)
    if type(node).__module__ != model.__name__:  # a name, a span, a fact, an operator
        return node
    return type(node)(*[_reading(part, instead) for part in astuple(node)])


def _readings(width: int) -> str:
    return "one reading" if width == 1 else f"{width} readings"
