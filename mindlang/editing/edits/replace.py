"""`mindc edit replace`."""

from mindlang.compiler.diagnostic import listed
from mindlang.compiler.hierarchy import below
from mindlang.compiler.model import Node
from mindlang.compiler.syntax import Influences
from mindlang.editing.insertion import instead
from mindlang.editing.project import EditError, MindChange, Project, Replaced


def replace(project: Project, skill: str, new: str) -> MindChange:
    """Let another skill, or a hierarchy, take the place of a skill.

    Both stay declared. They must drive the same actuators. Skills that influenced the old one keep their
    weights and influence the new one.

    Example: mindc edit replace power.mind GoToPower+Avoid GoToPower
    """
    project.find(skill, "skill")
    declaration = project.find(new, "skill")
    if skill == new:
        raise EditError(f"{skill} takes its own place already.", "", declaration.header.name.span)
    _refuse_other_drives(project, skill, new)
    places = [place for place in project.places(skill) if place.by is not declaration]
    for place in places:
        if place.by:
            project.refuse_existing(place.by, Influences, new)
    if not places:
        message = f"{skill} has no place: it is not the master, and no skill but {new} influences it."
        raise EditError(message, "", declaration.header.name.span)
    return MindChange(tuple(instead(place.name.span, new) for place in places), replaced=Replaced(skill, new))


def _refuse_other_drives(project: Project, skill: str, new: str) -> None:
    """EditError where the two do not drive the same actuators."""
    old_drives, new_drives = _drives(project, skill), _drives(project, new)
    if old_drives != new_drives:
        differ = listed(sorted(old_drives ^ new_drives), "and")
        message = f"{skill} and {new} differ in what they drive: {differ}."
        span = project.find(new, "skill").header.name.span
        raise EditError(message, "Replace it by a skill with the same interface.", span)


def _drives(project: Project, skill: str) -> set[str]:
    hierarchy, reached = project.mind.hierarchy, below(project.mind.influences, [skill])
    return {node.name for name in reached for node in hierarchy[Node("skill", name)] if node.noun == "actuator"}
