"""`mindc edit inline`."""

from mindlang.compiler.source import Splice
from mindlang.compiler.syntax import (
    Chooses,
    Declaration,
    Drives,
    Fact,
    Influences,
    Phrase,
    Reads,
    expressions_in,
    of_form,
)
from mindlang.editing import insertion
from mindlang.editing.project import EditError, MindChange, Project

Edge = Drives | Influences


def inline(project: Project, skill: str) -> MindChange:
    """Let the subskills of a skill take its place.

    Whoever influenced it influences them, and the skill is taken out. What these lines need after `at` is read
    there as well.

    It is the reverse of extract.

    Example: mindc edit inline collect.mind Fetch
    """
    declaration = project.own_skill(skill)
    if not of_form(declaration.facts, Influences):
        message = f"{skill} is a base skill: there is nothing below it to take its place."
        raise EditError(message, "", declaration.header.span)
    parents = [parent for parent in project.parents(skill) if not parent.header.like]
    project.refuse_used("skill", skill, [declaration, *parents])
    if not parents:
        message = f"No skill influences {skill}: nothing can take its place."
        raise EditError(message, "", declaration.header.span)
    edges = [fact for parent in parents for fact in of_form(parent.facts, Influences) if fact.name.text == skill]
    lines: list[Fact] = [*of_form(declaration.facts, Chooses), *(edge for edge in edges if edge.over)]
    for line in lines:
        message = f"{skill} says more of its influence than lines of others could."
        raise EditError(message, "Take this out first.", line.span)
    splices = (splice for parent in parents for splice in _taken_over(parent, declaration))
    return MindChange((*insertion.without_declarations([declaration]), *splices))


def _taken_over(parent: Declaration, child: Declaration) -> list[Splice]:
    """The lines of a child in the place of that with which its parent influences it, but for what the parent says."""
    said = {fact.name.text for fact in parent.facts if isinstance(fact, Edge)}
    edges = [fact for fact in child.facts if isinstance(fact, Edge) and fact.name.text not in said]
    place = next(fact for fact in of_form(parent.facts, Influences) if fact.name.text == child.header.name.text)
    indent = insertion.indentation(parent)
    lines = [f"{indent}{insertion.line_of(fact)}" for fact in edges]
    splices = [insertion.replace_line(place, lines) if lines else insertion.without_line(place)]
    read = {fact.name.text for fact in of_form(parent.facts, Reads)}
    terms = (term for expression in expressions_in(*edges) for term in expression.terms)
    needed = dict.fromkeys(term.kind.text for term in terms if isinstance(term, Phrase))
    if reads := [f"reads {name}" for name in needed if name not in read]:
        splices.append(insertion.below_siblings(parent, "reads", reads))
    return splices
