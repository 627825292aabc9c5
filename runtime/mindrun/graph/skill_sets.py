"""Which skills a master reaches, which of them learn, and under whose name."""

from collections.abc import Iterable

from mindrun.graph.graph import Graph, Lesson, Skill
from mindrun.graph.reachability import reached_from


def genes(skill: Skill) -> int:
    """How many weights a skill learns; 0 where it does not learn."""
    return skill.function.genome_length(len(skill.inputs), skill.outputs)


def reachable(graph: Graph, master: str) -> tuple[Skill, ...]:
    """The skills that can have influence when `master` is in charge, parents first."""
    return below(graph, next(index for index, skill in enumerate(graph.skills) if skill.name == master))


def below(graph: Graph, index: int) -> tuple[Skill, ...]:
    """The skill of an index and all that it can influence, parents first."""

    def influenced(index: int) -> Iterable[int]:
        return (edge.target for edge in graph.skills[index].edges if edge.to == "skill")

    return tuple(graph.skills[number] for number in sorted(reached_from([index], influenced)))


def owners(skills: Iterable[Skill]) -> tuple[str, ...]:
    """The names under which the weights of these skills stand, each once: skills that are like one another share."""
    return tuple(dict.fromkeys(skill.owner for skill in skills if genes(skill)))


def owner_of(graph: Graph, name: str) -> str:
    """The skill under whose name the weights of the skill of this name stand."""
    return next((skill.owner for skill in graph.skills if skill.name == name), name)


def learners(graph: Graph, lesson: Lesson) -> tuple[str, ...]:
    """The skills that a lesson teaches, in the order of its genome; none where all of them are frozen."""
    taught = reachable(graph, lesson.skill) if lesson.with_subskills else reachable(graph, lesson.skill)[:1]
    names = {*owners(taught)}
    return tuple(skill.name for skill in graph.skills if skill.name in names and not skill.frozen)
