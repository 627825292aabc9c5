"""`mindc edit connect`."""

from typing import Annotated

from mindlang.compiler.diagnostic import a
from mindlang.compiler.syntax import Drives, Influences, Reads
from mindlang.editing.insertion import below_siblings
from mindlang.editing.project import EditError, MindChange, Project, refuse_lines

Verb = type[Reads] | type[Drives] | type[Influences]
VERBS: dict[str, Verb] = {"skill": Influences, "actuator": Drives, "memory": Drives, "sensor": Reads}


def connect(
    project: Project,
    skill: str,
    target: str,
    *,
    at: Annotated[str, "The value of the edge, instead of an output of the function: --at 1"] = "",
    drives: Annotated[bool, "Drive a memory, instead of reading it"] = False,
) -> MindChange:
    """Let a skill read, drive or influence something.

    It reads sensors, drives actuators and influences skills. A memory is read, unless there is a value to drive
    it with.

    Example: mindc edit connect collect.mind Collect proximity
    """
    declaration = project.own_skill(skill)
    refuse_lines(at)
    is_sent = drives or bool(at)
    noun = project.find(target, *(VERBS if is_sent else reversed(VERBS))).header.noun.text
    form: Verb = Reads if noun == "memory" and not is_sent else VERBS[noun]
    if form is Reads and is_sent:
        raise EditError(f"{target} is {a(noun)}, which is read.", "Leave --at and --drives out.")
    if drives and form is Influences:
        raise EditError(f"{target} is a skill, which is influenced.", "Leave --drives out.")
    project.refuse_existing(declaration, form, target)
    value = f" at {at}" if at else ""
    return MindChange((below_siblings(declaration, form, [f"{form.__name__.lower()} {target}{value}"]),))
