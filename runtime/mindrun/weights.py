"""A skill's trained numbers: one flat float32 vector, the genome."""

from collections.abc import Iterable, Mapping
from io import BytesIO

import numpy as np
from numpy.typing import NDArray

from mindrun.errors import WeightsError
from mindrun.functions import genome_length
from mindrun.graph import Graph, Lesson, Skill

Weights = NDArray[np.float32]  # of one skill: [genes]
NONE = np.zeros(0, np.float32)


def genes(skill: Skill) -> int:
    """How many weights a skill learns; 0 where it does not learn."""
    return genome_length(skill.function, len(skill.inputs), skill.outputs)


def weights_of(skill: Skill, weights: Mapping[str, Weights]) -> Weights:
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
    return below(graph, next(index for index, skill in enumerate(graph.skills) if skill.name == master))


def below(graph: Graph, index: int) -> tuple[Skill, ...]:
    """The skill of an index and all that it can influence, parents first."""
    found, waiting = {index}, [index]
    while waiting:
        targets = {edge.target for edge in graph.skills[waiting.pop()].edges if edge.to == "skill"} - found
        found |= targets
        waiting += targets
    return tuple(graph.skills[index] for index in sorted(found))


def learners(graph: Graph, lesson: Lesson) -> tuple[str, ...]:
    """The skills that a lesson teaches, in the order of its genome; none where all of them are frozen."""
    taught = reachable(graph, lesson.skill) if lesson.with_subskills else reachable(graph, lesson.skill)[:1]
    return tuple(skill.name for skill in taught if genes(skill) and not skill.frozen)


def parts(graph: Graph, names: Iterable[str], genome: Weights) -> dict[str, Weights]:
    """A genome cut into the weights of the skills of those names, in that order."""
    lengths = {skill.name: genes(skill) for skill in graph.skills}
    ends = np.cumsum([lengths[name] for name in names])
    return dict(zip(names, np.split(genome, ends[:-1]), strict=True))


def to_npy(weights: Weights) -> bytes:
    """A genome as the bytes of a .npy file."""
    file = BytesIO()
    np.save(file, weights.astype("<f4"), allow_pickle=False)
    return file.getvalue()


def from_npy(data: bytes) -> Weights:
    """The genome in the bytes of a .npy file; WeightsError unless it is exactly one vector of finite float32."""
    file = BytesIO(data)
    try:
        version = np.lib.format.read_magic(file)
        shape, _, dtype = np.lib.format.read_array_header_1_0(file)
    except (ValueError, EOFError) as error:
        raise WeightsError("these weights are damaged") from error
    values = data[file.tell() :]
    if version != (1, 0) or dtype != np.dtype("<f4") or len(shape) != 1 or len(values) != 4 * shape[0]:
        raise WeightsError("these weights are damaged")
    weights = np.frombuffer(values, "<f4").astype(np.float32)
    if not np.isfinite(weights).all():
        raise WeightsError("these weights are not finite")
    return weights
