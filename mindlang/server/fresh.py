"""Names that nothing has yet, for what an edit makes: whoever made it gives it a better one."""

from collections.abc import Iterator
from itertools import chain, count
from pathlib import Path

from mindlang.editing.project import Project


def fresh_title(project: Project, wish: str) -> str:
    """A name for a skill, as wished for or with a number that is free."""
    taken = project.names.of("skill")
    return next(name for name in _numbered(wish) if name not in taken)


def fresh_file(beside: Path, noun: str) -> str:
    """The name of a file beside another that is not there yet."""
    return next(f"{name}.mind" for name in _numbered(f"{noun}s") if not (beside.parent / f"{name}.mind").exists())


def new_skill(project: Project) -> tuple[str, list[str]] | None:
    """A skill that leaves every actuator at its neutral value: its name and its lines; None where there is none."""
    lines = [f"drives {actuator.name} at {actuator.kind.neutral:.15g}" for actuator in project.mind.actuators]
    name = fresh_title(project, "NewSkill")
    return (name, [f"skill {name} is rule", *lines]) if lines else None


def _numbered(wish: str) -> Iterator[str]:
    return chain([wish], (f"{wish}{number}" for number in count(2)))
