"""A skill's trained numbers: one flat float32 vector, the genome."""

from collections.abc import Iterable, Mapping

import numpy as np

from mindrun.errors import WeightsError
from mindrun.functions.function import Weights as Weights
from mindrun.graph import Graph, Lesson, Skill
from mindrun.npy import from_npy
from mindrun.reachability import reached_from

NO_WEIGHTS = np.zeros(0, np.float32)


def genes(skill: Skill) -> int:
    """How many weights a skill learns; 0 where it does not learn."""
    return skill.function.genome_length(len(skill.inputs), skill.outputs)


def weights_of(skill: Skill, weights: Mapping[str, Weights]) -> Weights:
    """A skill's weights, checked: as many as its function has, float32, finite; else WeightsError."""
    if genes(skill) == 0:
        return NO_WEIGHTS
    if skill.owner not in weights:
        raise WeightsError(f"skill {skill.owner} has no weights")
    return checked(skill, weights[skill.owner])


def checked(skill: Skill, found: Weights) -> Weights:
    """Weights of a skill, as compiled code takes them; WeightsError unless they are [genes], float32, finite."""
    expected = genes(skill)
    if found.dtype != np.float32 or found.shape != (expected,):
        shape = "×".join(map(str, found.shape))
        raise WeightsError(f"skill {skill.name} needs {expected} float32 weights, not {shape} of {found.dtype}")
    if not np.isfinite(found).all():
        raise WeightsError(f"skill {skill.name} has weights that are not finite")
    return np.ascontiguousarray(found)


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


def parts(graph: Graph, names: Iterable[str], genome: Weights) -> dict[str, Weights]:
    """A genome cut into the weights of the skills of those names, in that order."""
    lengths = {skill.name: genes(skill) for skill in graph.skills}
    ends = np.cumsum([lengths[name] for name in names])
    return dict(zip(names, np.split(genome, ends[:-1]), strict=True))


def read_weights(data: bytes) -> Weights:
    """The genome in the bytes of a .npy file; WeightsError unless it is exactly one vector of finite float32."""
    try:
        return from_npy(data)
    except ValueError as error:
        raise WeightsError(str(error)) from error
