"""What a skill could be connected to, replaced by, or taught on."""

from collections.abc import Iterator
from itertools import islice
from typing import Any

from mindrun.weights import genes

from mindlang.compiler.hierarchy import above, reached
from mindlang.compiler.syntax import Declaration, Drives, Influences, Reads
from mindlang.editing.project import Project

MAX_TARGETS = 6  # of each sort; the command line and the editor's own dialogue know them all


def connectable(project: Project, declaration: Declaration) -> Iterator[tuple[str, str]]:
    """What a skill could read, drive or influence besides, with the verb."""
    said = {fact.name.text for fact in declaration.facts if isinstance(fact, Reads | Drives | Influences)}
    names = project.names
    free = [name for name in names.of("sensor", "memory") if name not in said][:MAX_TARGETS]
    yield from (("read", name) for name in free)
    free = [name for name in names.of("actuator", "memory") if name not in said][:MAX_TARGETS]
    yield from (("drive", name) for name in free)
    yield from (("influence", name) for name in _below(project, declaration.header.name.text)[:MAX_TARGETS])


def not_yet_below(project: Project, skill: str) -> Iterator[tuple[str, list[str]]]:
    """Skills that another could influence besides, with what they read and it does not."""
    reads = {known.name: known.reads for known in project.mind.skills}
    for other in _below(project, skill)[:MAX_TARGETS]:
        yield other, [reading for reading in reads[other] if reading not in reads[skill]]


def replacements(project: Project, skill: str) -> list[str]:
    """Skills that are not above it; those that drive other actuators are refused by the edit itself."""
    skills = {known.name: known for known in project.mind.skills}
    parents = {name for name, known in skills.items() if skill in known.subskills}
    higher = above(skills.values(), parents)
    others = (
        name
        for name in skills
        if name != skill
        and (name not in higher or (name in parents and not (parents - {name}) & reached(skills, name)))
    )
    return [*islice(others, 8 * MAX_TARGETS)]


def lesson(project: Project, skill: str) -> dict[str, Any]:
    """The arguments with which `add` gives a skill that learns its first lesson; none where it has one, or cannot."""
    learns = any(known.name == skill and genes(known) for known in project.graph.skills)
    taught = any(known.skill == skill for known in project.mind.lessons)
    curricula, tasks = project.names.of("curriculum"), project.names.of("task")
    if not learns or taught or not curricula or not tasks:
        return {}
    task = skill if skill in tasks else tasks[-1]
    return {"lines": [f"teaches {skill} on {task} for 100 generations"], "to": curricula[0], "noun": "curriculum"}


def _below(project: Project, skill: str) -> list[str]:
    """The skills that a skill could influence without a circle, and does not."""
    skills = {known.name: known for known in project.mind.skills}
    not_below = {*skills[skill].subskills, *above(skills.values(), [skill])}
    return [name for name in skills if name not in not_below]
