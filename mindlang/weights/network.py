"""A skill that learns as other programs know it: a network of matrices, in a file of safetensors."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from mindrun.errors import WeightsError, system_errors_as
from mindrun.files.printable import visible
from mindrun.files.regular_files import read_whole
from mindrun.graph.graph import Graph, Skill
from mindrun.graph.weights import Weights, genes
from mindrun.kinds.registry import kinds
from mindrun.numbers.arrays import Layers
from mindrun.numbers.network import matrices
from mindrun.terminal.command_line import command_line
from numpy.typing import NDArray
from safetensors import SafetensorError
from safetensors.numpy import load, save

from mindlang.lock import Signature
from mindlang.lock.blobs import MAX_WEIGHTS_BYTES
from mindlang.lock.signature import differences, places, signature
from mindlang.lock.status import trained_weights
from mindlang.training.subject import Subject

MAX_SHOWN = 400  # characters of what another program wrote
KEYS = ("mind.function", "mind.reads", "mind.sends")  # of the metadata: the signature of the weights
LENGTH_BYTES = 8  # of the length of a file's header, before it
METADATA = "__metadata__"

Matrix = NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class Tensors:
    """The tensors of a file by name, and what it says of itself."""

    by_name: Mapping[str, Matrix]
    metadata: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class SkillNetwork:
    """A skill's function as matrices [values out, values in]: its kind says how they are used, and what it remembers.

    `shapes` are (values in, values out) of each. What it reads and sends stands in the order of `signature`.
    """

    skill: Skill
    signature: Signature
    shapes: Layers

    @property
    def inputs(self) -> int:
        return len(self.skill.inputs)

    @property
    def outputs(self) -> int:
        return self.skill.outputs

    @property
    def state(self) -> int:
        return self.skill.function.state_length(self.inputs, self.outputs)


def network_of(graph: Graph, name: str) -> SkillNetwork:
    """The network of the skill of that name in an `arrange`d graph; WeightsError where it has none of its own."""
    skill = next((each for each in graph.skills if each.name == name), None)
    if skill is None:
        raise WeightsError(f"there is no skill called {name}", f"There is {', '.join(s.name for s in graph.skills)}.")
    if skill.like:
        raise WeightsError(f"{name} is like {skill.like}: it has no weights of its own", f"take {skill.like}")
    shapes = skill.function.matrix_shapes(len(skill.inputs), skill.outputs)
    if not genes(skill) or not shapes:
        learning = " or ".join(kind for kind, cls in kinds("skill").items() if cls.learns)
        raise WeightsError(f"{name} has no weights: it learns nothing", f"take a skill that is {learning}")
    return SkillNetwork(skill, signature(graph, skill), shapes)


def matrix_names(network: SkillNetwork) -> tuple[str, ...]:
    """The names of the matrices, as PyTorch gives them to the layers of `mindlang.torch.Skill`."""
    return tuple(f"layers.{number}.weight" for number in range(len(network.shapes)))


def to_tensors(network: SkillNetwork, genome: Weights) -> Tensors:
    """The matrices of a genome by name, and which skill they are for."""
    own, found = network.signature, matrices(genome, network.shapes)
    said = (own.function, " ".join(own.reads), " ".join(own.sends))
    metadata = {"format": "pt", "mind.skill": network.skill.name, **dict(zip(KEYS, said, strict=True))}
    return Tensors(dict(zip(matrix_names(network), found, strict=True)), metadata)


def to_genome(network: SkillNetwork, tensors: Tensors) -> Weights:
    """The genome in a file's tensors, in the order of the network; WeightsError where they are not its matrices.

    What a file says that its weights read and send is held against the skill, by name: another order is brought into
    that of the skill. A file that says nothing is taken as it is.
    """
    names = matrix_names(network)
    hint = f"the tensors of {network.skill.name} are {', '.join(names)}; mindlang.torch.Skill saves them"
    if missing := [name for name in names if name not in tensors.by_name]:
        raise WeightsError(f"it has no {missing[0]}", hint)
    if extra := [name for name in tensors.by_name if name not in names]:
        raise WeightsError(f"it has {visible(f'{extra[0]:.60}')}, which is no weight of {network.skill.name}", hint)
    for name, (into, out) in zip(names, network.shapes, strict=True):
        found = tensors.by_name[name]
        if found.shape != (out, into):
            turned = " (it is turned over: a row is what one neuron reads)" * (found.shape == (into, out))
            shape = "×".join(map(str, found.shape)) or "a single number"
            raise WeightsError(f"{name} is {shape}, and that of {network.skill.name} {out}×{into}{turned}")
        if not np.isfinite(found).all():
            raise WeightsError(f"{name} has numbers that are not finite")
    genome = np.concatenate([tensors.by_name[name].ravel() for name in names])
    return _in_order(network, tensors, genome)


def _in_order(network: SkillNetwork, tensors: Tensors, genome: Weights) -> Weights:
    """The genome of a file that says what it reads and sends in the order in which the skill does."""
    if not any(key in tensors.metadata for key in KEYS):
        return genome
    if not all(tensors.metadata.get(key, "").strip() for key in KEYS):
        raise WeightsError("its __metadata__ says some of mind.function, mind.reads and mind.sends, but not all")
    function, reads, sends = (tensors.metadata[key] for key in KEYS)
    its, own = Signature(function, tuple(reads.split()), tuple(sends.split())), network.signature
    if found := differences(its, own, network.skill.function.derived):
        what = "; ".join(found)
        shortened = visible(what if len(what) <= MAX_SHOWN else f"{what[:MAX_SHOWN]}…")
        raise WeightsError(f"these are weights of another declaration: {shortened}")
    if sorted(its.reads) != sorted(own.reads) or sorted(its.sends) != sorted(own.sends):
        said = f"{' '.join(own.reads)} and {' '.join(own.sends)}, in any order"
        raise WeightsError("its __metadata__ says twice or otherwise what it reads or sends", f"they are {said}")
    inputs, outputs = places(own.reads, its.reads, {}), places(own.sends, its.sends, {})
    return network.skill.function.reordered(genome, inputs, outputs)


def trained_network(subject: Subject, skill: str) -> tuple[SkillNetwork, Weights]:
    """A skill's network and the weights that it was taught; MindError where it has none that fit."""
    network = network_of(subject.graph, skill)
    weights, refusals = trained_weights(subject.graph, subject.lock, [skill])
    if refusals:
        raise WeightsError(refusals[0], command_line("mindc", "train", subject.shown, skill))
    return network, weights[skill]


def to_bytes(network: SkillNetwork, genome: Weights) -> bytes:
    """A genome as a file of safetensors; the order in which it says of what the weights are is any."""
    tensors = to_tensors(network, genome)
    return save(dict(tensors.by_name), dict(tensors.metadata))


def read_bytes(path: Path) -> bytes:
    """The bytes of a file; WeightsError where it cannot be read or is too large."""
    with system_errors_as(WeightsError, f"{path} cannot be read"):
        return read_whole(path, MAX_WEIGHTS_BYTES)


def genome_in(path: Path, data: bytes, network: SkillNetwork) -> Weights:
    """The genome in these bytes of a file of safetensors; WeightsError where it is not that of this network."""
    try:
        return to_genome(network, from_bytes(data))
    except WeightsError as error:
        raise WeightsError(f"{path}: {error}", error.hint) from error


def from_bytes(data: bytes) -> Tensors:
    """The tensors of a file of safetensors; WeightsError where it is damaged, and for other numbers than float32."""
    try:
        by_name = load(data)
    except (SafetensorError, KeyError, ValueError) as error:  # KeyError: numbers that numpy does not have
        said = visible(f"{error!s:.200}".removeprefix("Error while deserializing: "))
        raise WeightsError(f"it is no file of safetensors that can be read: {said}") from error
    for name, tensor in by_name.items():
        if tensor.dtype != np.float32:
            shown = visible(f"{name:.60}")
            raise WeightsError(
                f"{shown} is {tensor.dtype}, and weights are float32", "save it as float32: skill.float()"
            )
    header = json.loads(data[LENGTH_BYTES : LENGTH_BYTES + int.from_bytes(data[:LENGTH_BYTES], "little")])
    return Tensors(by_name, header.get(METADATA) or {})
