"""`mindc edit inline`."""

from mindlang.diagnostic import Label
from mindlang.editing.page import instead_of_line, line_of, newline, without_declaration
from mindlang.editing.project import Change, EditError, Project, facts
from mindlang.syntax import Drives, Influences


def inline(project: Project, skill: str) -> Change:
    """Let those that influence a complex skill influence its subskills instead, and take the skill out.

    Example: mindc edit inline Fetch collect.mind
    """
    declaration = project.find(skill, "skill")
    edges = [fact for fact in declaration.facts if isinstance(fact, Drives | Influences)]
    if not facts(declaration, Influences):
        raise EditError(
            f"{skill} is a base skill: there is nothing below it to take its place.", "", declaration.header.span
        )
    parents = [
        (parent, fact)
        for parent in project.parents(skill)
        for fact in facts(parent, Influences)
        if fact.name.text == skill
    ]
    used = [
        m.name.span for m in project.mentions("skill", skill) if m.by not in (declaration, *(p for p, _ in parents))
    ]
    if used:
        labels = [Label(span, "and here") for span in used[1:]]
        raise EditError(f"{skill} is still named elsewhere.", "Take these lines out first.", used[0], *labels)
    if not parents:
        raise EditError(f"No skill influences {skill}: nothing can take its place.", "", declaration.header.span)
    splices = [without_declaration(declaration)]
    for parent, place in parents:
        said = {fact.name.text for fact in parent.facts if isinstance(fact, Drives | Influences)}
        lines = [line_of(fact.span) for fact in edges if fact.name.text not in said]
        splices.append(instead_of_line(place.span, newline(place.span.source).join(lines)))
    return Change(tuple(splices))
