"""Files of safetensors with a skill's weights, for other programs and from them."""

import json
from pathlib import Path

import numpy as np
from mindrun.errors import WeightsError
from mindrun.files.atomic_write import write
from mindrun.files.printable import visible
from mindrun.files.regular_files import read_whole
from mindrun.graph.weights import Weights
from mindrun.terminal.command_line import command_line
from safetensors import SafetensorError
from safetensors.numpy import load, save

from mindlang.lock.blobs import MAX_WEIGHTS_BYTES
from mindlang.lock.status import trained_weights
from mindlang.training.subject import Subject
from mindlang.weights.network import Network, Tensors, network_of, to_genome, to_tensors

LENGTH_BYTES = 8  # of the header's length, before it
METADATA = "__metadata__"


def trained_network(subject: Subject, skill: str) -> tuple[Network, Weights]:
    """A skill's network and the weights that it was taught; MindError where it has none that fit."""
    network = network_of(subject.graph, skill)
    weights, refusals = trained_weights(subject.graph, subject.lock, [skill])
    if refusals:
        raise WeightsError(refusals[0], command_line("mindc", "train", subject.shown, skill))
    return network, weights[skill]


def save_genome(path: Path, network: Network, genome: Weights) -> None:
    """Write a genome as the matrices of its network; WeightsError where that fails."""
    try:
        write(path, to_bytes(network, genome))
    except OSError as error:
        raise WeightsError(f"{path} cannot be written: {error.strerror}") from error


def to_bytes(network: Network, genome: Weights) -> bytes:
    """A genome as a file of safetensors; the order in which it says of what the weights are is any."""
    tensors = to_tensors(network, genome)
    return save(dict(tensors.by_name), dict(tensors.metadata))


def load_genome(path: Path, network: Network) -> Weights:
    """The genome in a file of safetensors; WeightsError where it is not that of this network."""
    return genome_in(path, read_bytes(path), network)


def read_bytes(path: Path) -> bytes:
    """What is in a file; WeightsError where it cannot be read or is too large."""
    try:
        return read_whole(path, MAX_WEIGHTS_BYTES)
    except OSError as error:
        raise WeightsError(f"{path} cannot be read: {error.strerror}") from error


def genome_in(path: Path, data: bytes, network: Network) -> Weights:
    """The genome in these bytes of a file."""
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
