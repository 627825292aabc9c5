"""A skill's trained numbers: one flat float32 vector, the genome."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from mindrun.errors import WeightsError
from mindrun.functions import genome_length
from mindrun.graph import Graph, Skill

NONE = np.zeros(0, np.float32)


def genes(skill: Skill) -> int:
    """How many weights a skill learns; 0 where it does not learn."""
    return genome_length(skill.function, len(skill.inputs), skill.outputs)


def weights_of(skill: Skill, weights: Mapping[str, NDArray[np.float32]]) -> NDArray[np.float32]:
    """A skill's weights, checked: as many as its function has, float32, finite; else WeightsError."""
    expected = genes(skill)
    if expected == 0:
        return NONE
    if skill.name not in weights:
        raise WeightsError(f"skill {skill.name} has no weights")
    found = weights[skill.name]
    if found.dtype != np.float32 or found.shape != (expected,):
        shape = "×".join(map(str, found.shape))
        raise WeightsError(f"skill {skill.name} needs {expected} float32 weights, not {shape} of {found.dtype}")
    if not np.isfinite(found).all():
        raise WeightsError(f"skill {skill.name} has weights that are not finite")
    return np.ascontiguousarray(found)


def reachable(graph: Graph, master: str) -> tuple[Skill, ...]:
    """The skills that can have influence when `master` is in charge, parents first."""
    reached = {master}
    found = []
    for skill in graph.skills:
        if skill.name in reached:
            found.append(skill)
            reached |= {graph.skills[edge.target].name for edge in skill.edges if edge.to == "skill"}
    return tuple(found)
