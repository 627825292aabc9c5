"""`mindc edit encapsulate`."""

from typing import Annotated

from mindlang.editing.insertion import INDENT, declare, replace_span
from mindlang.editing.project import MindChange, Project, Replaced, influence


def encapsulate(
    project: Project,
    skill: str,
    new: str,
    *,
    with_: Annotated[tuple[str, ...], "Another skill that the new one influences: --with GoToPower+Avoid"] = (),
    reads: Annotated[tuple[str, ...], "A sensor or memory that the new one reads: --reads battery"] = (),
    is_: Annotated[str, "Its function (default: mlp hidden 2)"] = "mlp hidden 2",
) -> MindChange:
    """Put a new skill over an old one, whose place it takes.

    No line of the old one changes. Where it was master the new one is, and skills that influenced it influence
    the new one.

    Example: mindc edit encapsulate collect.mind Collect CarefulCollect \\
      --with Avoid --reads proximity
    """
    project.find(skill, "skill")
    for other in with_:
        project.find(other, "skill")
    project.refuse_new_skill(new, is_, reads)
    kind = is_.partition(" ")[0]
    lines = [
        f"skill {new} is {is_}",
        *(f"{INDENT}reads {reading}" for reading in reads),
        *(f"{INDENT}{influence(kind, below)}" for below in (skill, *with_)),
    ]
    moved = (replace_span(place.name.span, new) for place in project.places(skill))
    return MindChange((*moved, declare(project.main, "skill", lines)), replaced=Replaced(skill, new))
