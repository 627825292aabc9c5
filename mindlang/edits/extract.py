"""`mindc edit extract`."""

from typing import Annotated

from mindlang.editing.page import declare_below, indentation, instead_of_line, line_of, without_line
from mindlang.editing.project import Change, EditError, Project, facts, refuse_misnamed
from mindlang.syntax import Influences, Reads


def extract(
    project: Project,
    parent: str,
    new: str,
    subskills: tuple[str, ...],
    *,
    reads: Annotated[tuple[str, ...], "What the new skill reads (default: what the parent does)"] = (),
    is_: Annotated[str, "Its function (default: mlp hidden 2)"] = "mlp hidden 2",
) -> Change:
    """Put several subskills of a skill under a new one, which the skill influences in their place.

    Example: mindc edit extract Collect Fetch GoToObject+Avoid Grab collect.mind
    """
    declaration = project.find(parent, "skill")
    refuse_misnamed("skill", new)
    project.refuse_taken("skill", new)
    for reading in reads:
        project.find(reading, "sensor", "memory")
    edges = {fact.name.text: fact for fact in facts(declaration, Influences)}
    for subskill in subskills:
        if subskill not in edges:
            raise EditError(f"{parent} does not influence {subskill}.", "", declaration.header.span)
    first, *others = sorted((edges[name] for name in set(subskills)), key=lambda fact: fact.span.start)
    inputs = reads or [fact.name.text for fact in facts(declaration, Reads)]
    indent = indentation(declaration)
    lines = [
        f"skill {new} is {is_}",
        *(f"{indent}reads {reading}" for reading in inputs),
        *(line_of(fact.span) for fact in (first, *others)),
    ]
    return Change((
        instead_of_line(first.span, f"{indent}influences {new}"),
        *(without_line(fact.span) for fact in others),
        declare_below(declaration, lines),
    ))  # fmt: skip
