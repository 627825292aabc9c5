"""`mindc edit integrate`."""

from typing import Annotated

from mindlang.editing.insertion import below_siblings
from mindlang.editing.project import EditError, MindChange, Project, influence, kind_of


def integrate(
    project: Project,
    skill: str,
    *,
    with_: Annotated[tuple[str, ...], "A skill that it is to influence as well: --with GoToPower+Avoid"] = (),
    reads: Annotated[tuple[str, ...], "A sensor or memory that it is to read as well: --reads battery"] = (),
) -> MindChange:
    """Let a skill influence more skills and read more sensors.

    This is the paper's other way to extend a hierarchy. The skill is stale then. With --keep-weights it goes on
    as before until it is taught again.

    Example: mindc edit integrate collect.mind Collect \\
      --with Avoid --reads proximity --reads pulse
    """
    if not with_ and not reads:
        raise EditError("Nothing is to be integrated.", "Say what: --with SKILL, --reads SENSOR.")
    declaration = project.own_skill(skill)
    for other in with_:
        project.find(other, "skill")
        project.refuse_existing(declaration, "influences", other)
    for reading in reads:
        project.find(reading, "sensor", "memory")
        project.refuse_existing(declaration, "reads", reading)
    splices = []
    if reads:
        splices.append(below_siblings(declaration, "reads", [f"reads {reading}" for reading in reads]))
    if with_:
        lines = [influence(kind_of(declaration), other) for other in with_]
        splices.append(below_siblings(declaration, "influences", lines))
    return MindChange(tuple(splices))
