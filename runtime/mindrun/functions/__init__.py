"""Kinds of internal functions (Eq. 1): what turns a skill's inputs into its outputs."""

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np
from numpy.typing import NDArray

from mindrun.functions.mlp import Mlp, first_weights, layers, matrices, perceive, weight_count
from mindrun.functions.procedure import Procedure, call, load
from mindrun.functions.rule import Rule

Function = Mlp | Rule | Procedure
Compute = Callable[[NDArray[np.float32]], NDArray[np.float32]]


def genome_length(function: Function, inputs: int, outputs: int) -> int:
    """How many weights a function learns: 0 where it does not learn."""
    return weight_count(inputs, outputs, function) if isinstance(function, Mlp) else 0


def drawn(function: Function, inputs: int, outputs: int, count: int, rng: np.random.Generator) -> NDArray[np.float32]:
    """Random genomes [count, weights] with which a function begins to learn."""
    if isinstance(function, Mlp):
        return first_weights(count, layers(inputs, outputs, function), rng)
    return np.empty((count, 0), np.float32)


def computes(
    function: Function, inputs: int, outputs: int, weights: NDArray[np.float32], sources: Mapping[str, str]
) -> Compute:
    """A function made ready: its float32 inputs to its float32 outputs, not yet clamped."""
    match function:
        case Mlp():
            shape = layers(inputs, outputs, function)
            return partial(perceive, matrices(weights, shape)) if shape else _zeros(outputs)
        case Rule():
            return _zeros(outputs)
        case Procedure():
            return partial(call, function, load(function, sources), outputs)


def _zeros(outputs: int) -> Compute:
    return lambda inputs: np.zeros(outputs, np.float32)


__all__ = ["Compute", "Function", "Mlp", "Procedure", "Rule", "computes", "drawn", "genome_length"]
