"""`mindc edit unfreeze`."""

from mindlang.compiler.syntax import Stays, of_form
from mindlang.editing.insertion import without_line
from mindlang.editing.project import EditError, MindChange, Project


def unfreeze(project: Project, skill: str) -> MindChange:
    """Let a frozen skill be taught again.

    Example: mindc edit unfreeze collect.mind Avoid
    """
    declaration = project.own_skill(skill)
    frozen = of_form(declaration.facts, Stays)
    if not frozen:
        raise EditError(f"{skill} is not frozen.", "", declaration.header.span)
    return MindChange(tuple(without_line(fact) for fact in frozen))
