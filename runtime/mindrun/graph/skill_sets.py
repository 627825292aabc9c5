"""Sets of skills: those that a master reaches, those that learn and under whose name, those that move the robot."""

from collections.abc import Container, Iterable

from mindrun.graph.graph import Graph, Lesson, Skill, Task


def genes(skill: Skill) -> int:
    """The number of weights that a skill learns; 0 where it does not learn."""
    return skill.function.genome_length(len(skill.inputs), skill.outputs)


def reachable(graph: Graph, master: str) -> tuple[Skill, ...]:
    """The skills that can have influence when `master` is in charge, parents first."""
    return below(graph, next(index for index, skill in enumerate(graph.skills) if skill.name == master))


def masters_of(task: Task, master: str) -> tuple[str, ...]:
    """The skills that are in charge of robots of a task, where `master` is of the first."""
    return tuple(dict.fromkeys((master, *filter(None, (thing.master for thing in task.things)))))


def acting(graph: Graph, task: Task, master: str) -> tuple[Skill, ...]:
    """The skills that can have influence on any robot of a task, parents first, where `master` is of the first."""
    found = {skill.name for each in masters_of(task, master) for skill in reachable(graph, each)}
    return tuple(skill for skill in graph.skills if skill.name in found)


def below(graph: Graph, index: int) -> tuple[Skill, ...]:
    """The skill of an index and all that it can influence, parents first."""
    found = {index}
    for number in range(index, len(graph.skills)):
        if number in found:
            found |= {edge.target for edge in graph.skills[number].edges if edge.to == "skill"}
    return tuple(graph.skills[number] for number in sorted(found))


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


def movers(graph: Graph, master: str) -> dict[str, int]:
    """The skills below a master that drive something that moves the robot, by name, with their places in the graph."""
    return driving(graph, master, {i for i, actuator in enumerate(graph.actuators) if actuator.kind.moves_body})


def driving(graph: Graph, master: str, actuators: Container[int]) -> dict[str, int]:
    """The skills below a master that drive one of these actuators."""
    numbers = graph.skill_numbers
    return {
        skill.name: numbers[skill.name]
        for skill in reachable(graph, master)
        if any(edge.to == "actuator" and edge.target in actuators for edge in skill.edges)
    }
