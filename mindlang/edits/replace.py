"""`mindc edit replace`."""

from mindlang.diagnostic import listed
from mindlang.editing.page import instead
from mindlang.editing.project import Change, EditError, Project, Renamed, facts
from mindlang.hierarchy import reached
from mindlang.syntax import Influences


def replace(project: Project, skill: str, new: str) -> Change:
    """Let another skill, or a hierarchy, take the place of a skill.

    Both stay declared. They must drive the same actuators. Skills that influenced the old one keep their
    weights and influence the new one.

    Example: mindc edit replace Avoid CarefulAvoid collect.mind
    """
    project.find(skill, "skill")
    declaration = project.find(new, "skill")
    if skill == new:
        raise EditError(f"{skill} takes its own place already.", "", declaration.header.name.span)
    _refuse_other_drives(project, skill, new)
    parents = [parent for parent in project.parents(skill) if parent is not declaration]
    for parent in parents:
        project.refuse_said(parent, Influences, new)
    places = [fact.name for parent in parents for fact in facts(parent, Influences) if fact.name.text == skill]
    places += [master.name for master in project.masters() if master.name.text == skill]
    if not places:
        raise EditError(
            f"{skill} has no place: it is not the master, and no skill but {new} influences it.",
            "",
            declaration.header.name.span,
        )
    return Change(tuple(instead(place.span, new) for place in places), (Renamed("influence", skill, new),))


def _refuse_other_drives(project: Project, skill: str, new: str) -> None:
    """EditError where the two do not drive the same actuators."""
    old_drives, new_drives = _drives(project, skill), _drives(project, new)
    if old_drives != new_drives:
        differ = listed(sorted(old_drives ^ new_drives), "and")
        span = project.find(new, "skill").header.name.span
        raise EditError(
            f"{skill} and {new} differ in what they drive: {differ}.",
            "Replace it by a skill with the same interface.",
            span,
        )


def _drives(project: Project, skill: str) -> set[str]:
    skills = {known.name: known for known in project.mind.skills}
    return {edge.target for name in reached(skills, skill) for edge in skills[name].edges if edge.to == "actuator"}
