"""`mindc edit freeze`."""

from mindlang.compiler.syntax import Stays, of_form
from mindlang.editing.insertion import below_siblings
from mindlang.editing.project import EditError, MindChange, Project


def freeze(project: Project, skill: str) -> MindChange:
    """Let a skill stay as it is: it refuses training.

    Lessons with subskills leave it out.

    Example: mindc edit freeze collect.mind Avoid
    """
    declaration = project.own_skill(skill)
    if frozen := of_form(declaration.facts, Stays):
        raise EditError(f"{skill} is frozen already.", "", frozen[0].span)
    return MindChange((below_siblings(declaration, "stays", ["stays frozen"]),))
