"""`mindc edit replace`."""

from mindlang.compiler.diagnostic import listed
from mindlang.compiler.hierarchy import with_descendants
from mindlang.compiler.model import Node
from mindlang.editing.insertion import replace_span
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
    if differ := sorted(_drives(project, skill) ^ _drives(project, new)):
        message = f"{skill} and {new} differ in what they drive: {listed(differ, 'and')}."
        raise EditError(message, "Replace it by a skill with the same interface.", declaration.header.name.span)
    places = [place for place in project.places(skill) if place.by is not declaration]
    for place in places:
        if place.by:
            project.refuse_existing(place.by, "influences", new)
    if not places:
        message = f"{skill} has no place: it is not the master, and no skill but {new} influences it."
        raise EditError(message, "", declaration.header.name.span)
    return MindChange(tuple(replace_span(place.name.span, new) for place in places), replaced=Replaced(skill, new))


def _drives(project: Project, skill: str) -> set[str]:
    hierarchy, reached = project.mind.hierarchy, with_descendants(project.mind.influences, [skill])
    return {node.name for name in reached for node in hierarchy[Node("skill", name)] if node.noun == "actuator"}
