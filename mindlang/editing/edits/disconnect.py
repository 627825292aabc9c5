"""`mindc edit disconnect`."""

from mindlang.compiler.diagnostic import Label, did_you_mean
from mindlang.compiler.syntax import Drives, Influences, Reads
from mindlang.editing.insertion import without_line
from mindlang.editing.project import EditError, MindChange, Project


def disconnect(project: Project, skill: str, target: str) -> MindChange:
    """Let a skill no longer read, drive or influence something.

    Example: mindc edit disconnect collect.mind Collect Grab
    """
    declaration = project.find(skill, "skill")
    edges = [fact for fact in declaration.facts if isinstance(fact, Reads | Drives | Influences)]
    found = [fact for fact in edges if fact.name.text == target]
    if not found:
        message = f"{skill} neither reads nor drives nor influences {target}."
        hint = did_you_mean(target, [fact.name.text for fact in edges])
        raise EditError(message, hint, declaration.header.span)
    if len(found) > 1:
        labels = [Label(fact.span, "or this") for fact in found[1:]]
        hint = f"Say which: {project.main.source.edit('remove', found[0].span.text, '--from', skill)}"
        raise EditError(f"{skill} reads {target} and drives it.", hint, found[0].span, *labels)
    return MindChange((without_line(found[0]),))
