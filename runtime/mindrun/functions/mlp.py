"""The multi-layer perceptron of the paper (4.1): no biases, sigmoid hidden layers, a linear last layer in 0..1."""

from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from mindrun.quantity import Quantity
from mindrun.registry import kind
from mindrun.sigmoid import sigmoid

WIDTH = Quantity("a whole number", {"": 1.0}, low=0, high=1000, whole=True)
# Of the weights that learning begins with, 4: without biases, small weights leave every sigmoid near 1/2. Tried on a
# stand-in for GoToObject, 6 seeds each, until 17 targets: with 1 one seed got there in 100 M ticks, with 2 all by the
# 10th generation, with 4 five in the first; 6 (until 22 targets) was no better than 4.
INITIAL_SPREAD = 4.0
HIDDEN = Quantity("a whole number", {"": 1.0}, low=0, high=16, whole=True)


@kind("skill", "mlp")
@dataclass(frozen=True, slots=True)
class Mlp:
    """A perceptron with `hidden` layers of `width` neurons (0: Eq. 5, max(inputs, outputs) + 2)."""

    hidden: Annotated[int, HIDDEN] = 2
    width: Annotated[int, WIDTH] = 0


def layers(inputs: int, outputs: int, mlp: Mlp) -> tuple[tuple[int, int], ...]:
    """(values in, values out) of each layer, hidden width from Eq. 5; none where the skill has no inputs or outputs."""
    if inputs == 0 or outputs == 0:
        return ()
    width = mlp.width or max(inputs, outputs) + 2
    return tuple(pairwise((inputs, *[width] * mlp.hidden, outputs)))


def weight_count(inputs: int, outputs: int, mlp: Mlp) -> int:
    """The length of the genome: one weight per connection, no biases."""
    return sum(before * after for before, after in layers(inputs, outputs, mlp))


def first_weights(count: int, shape: tuple[tuple[int, int], ...], rng: np.random.Generator) -> NDArray[np.float32]:
    """Random genomes [count, weights] for learning to begin with: their outputs are 1/2 where all neurons say 1/2.

    Without biases the outputs would otherwise lie anywhere, most beyond 0..1, where they answer to no input.
    """
    genomes = INITIAL_SPREAD * rng.standard_normal((count, sum(before * after for before, after in shape)), np.float32)
    for before, after in shape[-1:]:
        last = genomes[:, -before * after :].reshape(count, after, before)
        last += (1 - last.sum(axis=2, keepdims=True)) / before
    return genomes


def matrices(weights: NDArray[np.float32], shape: tuple[tuple[int, int], ...]) -> tuple[NDArray[np.float32], ...]:
    """A genome as one matrix [values out, values in] per layer: it holds them layer by layer, row by row."""
    ends = np.cumsum([before * after for before, after in shape])[:-1]
    parts = np.split(weights, ends) if shape else []
    return tuple(part.reshape(after, before) for part, (before, after) in zip(parts, shape, strict=True))


def perceive(layer_matrices: tuple[NDArray[np.float32], ...], inputs: NDArray[np.float32]) -> NDArray[np.float32]:
    """The function's outputs for float32 inputs (Eq. 1), before the clamp."""
    *hidden, last = layer_matrices
    values = inputs
    for matrix in hidden:
        values = sigmoid(_dense(matrix, values))
    return _dense(last, values)


def _dense(matrix: NDArray[np.float32], values: NDArray[np.float32]) -> NDArray[np.float32]:
    # accumulate adds strictly from left to right; sum and @ leave the order, and with it the last bit, open.
    products = matrix * values
    return np.add.accumulate(products, axis=1, out=products)[:, -1]
