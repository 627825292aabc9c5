"""The deviation of the engine from PyTorch, or from float64, with the same weights on the same readings."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from mindrun.graph.weights import Weights
from mindrun.numbers.network import Terms, matrices
from numpy.typing import NDArray

from mindlang.weights.network import Network

Rows = NDArray[np.float32]  # [ticks, values]
Compute = Callable[[Rows], Rows]  # inputs [ticks, inputs] of a run to outputs [ticks, outputs], in 0..1


@dataclass(frozen=True, slots=True)
class Deviation:
    """The largest `difference` of an output from that of the `reference`, in the `ticks` that were compared.

    `faults` are the outputs that were finite in one of both alone, or in none: the engine sends nothing there.
    """

    reference: str
    ticks: int
    difference: float
    faults: int


def compare(network: Network, genome: Weights, inputs: Rows) -> Deviation:
    """The function in PyTorch, or where that is not installed in float64 as it stands in a book, and in the engine."""
    sound = inputs[np.isfinite(inputs).all(axis=1)]
    name, compute = _reference(network, genome)
    with np.errstate(all="ignore"):
        theirs, ours = compute(sound), _engine(network, genome, sound)
    finite = np.isfinite(theirs) & np.isfinite(ours)
    difference = np.abs(theirs.astype(np.float64) - ours, where=finite, out=np.zeros(ours.shape))
    return Deviation(name, len(sound), float(difference.max(initial=0.0)), int((~finite).sum()))


def _engine(network: Network, genome: Weights, inputs: Rows) -> Rows:
    """Tick by tick, as on a robot."""
    compute = network.skill.function.ready(network.inputs, network.outputs, genome, {})
    values = np.array([compute(row) for row in inputs], np.float32).reshape(len(inputs), network.outputs)
    return _clamped(values)


def _clamped(values: NDArray[np.floating]) -> Rows:
    return np.where(np.isfinite(values), np.clip(values, 0, 1), np.nan).astype(values.dtype)


def _reference(network: Network, genome: Weights) -> tuple[str, Compute]:
    try:
        import torch
    except ImportError:
        return "float64", partial(_in_float64, network, genome)
    return f"PyTorch {torch.__version__}", partial(_in_torch, network, genome)


def _in_torch(network: Network, genome: Weights, inputs: Rows) -> Rows:
    """Outputs of `mindlang.torch.Skill`."""
    import torch

    from mindlang.weights.torch_skill import NetworkModule

    module, rows = NetworkModule(network, genome), torch.from_numpy(inputs)
    with torch.no_grad():
        if not network.state:
            return np.asarray(module(rows).numpy())
        found, state = [], None
        for row in rows:
            outputs, state = module(row, state)
            found.append(outputs.numpy())
    return np.array(found, np.float32).reshape(len(inputs), network.outputs)


def _in_float64(network: Network, genome: Weights, inputs: Rows) -> Rows:
    """Products of matrices and 1/(1 + e^−x), in float64."""
    found = [matrix.astype(np.float64) for matrix in matrices(genome, network.shapes)]
    state, rows = np.zeros(network.state), []
    for row in inputs.astype(np.float64):
        outputs, state = network.skill.function.forward(FLOAT64, found, row, state)
        rows.append(outputs)
    return _clamped(np.array(rows, np.float64).reshape(len(inputs), network.outputs))


FLOAT64 = Terms(
    product=lambda values, matrix: matrix @ values,
    sigmoid=lambda values: 1 / (1 + np.exp(-values)),
    joined=lambda one, other: np.concatenate([one, other]),
)
