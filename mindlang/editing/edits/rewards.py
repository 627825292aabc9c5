"""`mindc edit rewards`."""

from msgspec.structs import replace

from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.resolve.goals import INSTEAD, goal_lines
from mindlang.compiler.syntax import Goal, Prefers
from mindlang.editing import insertion
from mindlang.editing.project import EditError, MindChange, Project


def rewards(project: Project, task: str) -> MindChange:
    """Write out what the goals of a task reward, line by line.

    The mind stays the same, and every line can be changed.

    Example: mindc edit rewards goals.mind Fetch
    """
    declaration = project.find(task, "task")
    resolved = next(each for each in project.mind.tasks if each.name == task)
    own, goals = ([fact for fact in of.facts if isinstance(fact, Goal | Prefers)] for of in (declaration, resolved))
    if not goals:
        raise EditError(f"{task} has no goals.", "A goal says what it wants, avoids or keeps.", declaration.header.span)
    if len(own) < len(goals):
        message = f"{task} has goals of the task that it is like."
        raise EditError(message, "Write out those of the other task, or say all of them here.", declaration.header.span)
    whole = replace(declaration, facts=tuple(fact for fact in resolved.facts if not isinstance(fact, INSTEAD)))
    lines = goal_lines(whole, project.names, project.mind.tick, Findings())
    first, *others = own
    indent = insertion.indentation(declaration)
    written = insertion.replace_line(first, [f"{indent}{line}" for line, _ in lines])
    return MindChange((written, *map(insertion.without_line, others)))
