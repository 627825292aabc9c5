"""A skill's trained numbers: one flat float32 vector, the genome."""

from collections.abc import Iterable

import numpy as np

from mindrun.errors import WeightsError
from mindrun.files.npy import from_npy
from mindrun.graph.graph import Graph, Skill
from mindrun.graph.skill_sets import below as below
from mindrun.graph.skill_sets import genes as genes
from mindrun.graph.skill_sets import learners as learners
from mindrun.graph.skill_sets import owner_of as owner_of
from mindrun.graph.skill_sets import owners as owners
from mindrun.graph.skill_sets import reachable as reachable
from mindrun.numbers.arrays import Weights as Weights
from mindrun.numbers.arrays import WeightsBySkill

NO_WEIGHTS = np.zeros(0, np.float32)


def weights_of(skill: Skill, weights: WeightsBySkill) -> Weights:
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
