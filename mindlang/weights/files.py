"""Files of a skill's weights for other programs, written and read."""

from pathlib import Path

from mindrun.errors import WeightsError
from mindrun.files.atomic_write import write
from mindrun.files.regular_files import read_whole
from mindrun.graph.weights import Weights

from mindlang.lock.blobs import MAX_WEIGHTS_BYTES
from mindlang.weights.network import Network, matrices_of, to_genome, to_tensors
from mindlang.weights.safetensors import from_safetensors, to_safetensors


def save(path: Path, network: Network, genome: Weights) -> None:
    """Write a genome as the matrices of its network; WeightsError where that fails."""
    try:
        write(path, bytes_of(network, genome))
    except OSError as error:
        raise WeightsError(f"{path} cannot be written: {error.strerror}") from error


def bytes_of(network: Network, genome: Weights) -> bytes:
    """A genome as a file of safetensors."""
    return to_safetensors(to_tensors(network, matrices_of(network, genome)))


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
        return to_genome(network, from_safetensors(data))
    except WeightsError as error:
        raise WeightsError(f"{path}: {error}", error.hint) from error
