"""`mindc edit connect`."""

from typing import Annotated

from mindlang.compiler.diagnostic import a
from mindlang.editing.insertion import below_siblings
from mindlang.editing.project import EditError, MindChange, Project, refuse_lines

VERBS = {"skill": "influences", "actuator": "drives", "memory": "drives", "sensor": "reads"}


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
    verb = "reads" if noun == "memory" and not is_sent else VERBS[noun]
    if verb == "reads" and is_sent:
        raise EditError(f"{target} is {a(noun)}, which is read.", "Leave --at and --drives out.")
    if drives and verb == "influences":
        raise EditError(f"{target} is a skill, which is influenced.", "Leave --drives out.")
    project.refuse_existing(declaration, verb, target)
    value = f" at {at}" if at else ""
    return MindChange((below_siblings(declaration, verb, [f"{verb} {target}{value}"]),))
