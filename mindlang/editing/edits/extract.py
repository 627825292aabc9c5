"""`mindc edit extract`."""

from typing import Annotated

from mindlang.compiler.diagnostic import did_you_mean
from mindlang.compiler.syntax import Influences, Reads, of_form
from mindlang.editing.insertion import declare_below, indentation, line_of, replace_line, without_line
from mindlang.editing.project import EditError, MindChange, Project, influence, kind_of


def extract(
    project: Project,
    parent: str,
    new: str,
    subskills: tuple[str, ...],
    *,
    reads: Annotated[tuple[str, ...], "What the new skill reads (default: what the parent does)"] = (),
    is_: Annotated[str, "Its function (default: mlp hidden 2)"] = "mlp hidden 2",
) -> MindChange:
    """Put subskills of a skill under a new one.

    The skill influences the new one in their place.

    Example: mindc edit extract collect.mind Collect Fetch GoToObject+Avoid Grab
    """
    declaration = project.own_skill(parent)
    project.refuse_new_skill(new, is_, reads)
    edges = {fact.name.text: fact for fact in of_form(declaration.facts, Influences)}
    for subskill in subskills:
        if subskill not in edges:
            message = f"{parent} does not influence {subskill}."
            raise EditError(message, did_you_mean(subskill, edges), declaration.header.span)
    first, *others = (fact for name, fact in edges.items() if name in subskills)
    inputs = reads or [fact.name.text for fact in of_form(declaration.facts, Reads)]
    indent = indentation(declaration)
    lines = [
        f"skill {new} is {is_}",
        *(f"{indent}reads {reading}" for reading in inputs),
        *(f"{indent}{line_of(fact)}" for fact in (first, *others)),
    ]
    return MindChange((
        replace_line(first, [f"{indent}{influence(kind_of(declaration), new)}"]),
        *(without_line(fact) for fact in others),
        declare_below(declaration, lines),
    ))  # fmt: skip
