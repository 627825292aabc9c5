"""Networks at work (Eq. 1): genomes as matrices, and what comes out of them, in float32 and in a fixed order."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import partial

import numpy as np
from numpy.typing import NDArray

from mindrun.numbers.arrays import Compute, Layers, Weights
from mindrun.numbers.sigmoid import sigmoid


def matrices(weights: Weights, shape: Layers) -> tuple[NDArray[np.float32], ...]:
    """A genome as one matrix [values out, values in] per layer: it holds them layer by layer, row by row."""
    ends = np.cumsum([before * after for before, after in shape])[:-1]
    parts = np.split(weights, ends) if shape else []
    return tuple(part.reshape(after, before) for part, (before, after) in zip(parts, shape, strict=True))


def genome(found: Iterable[NDArray[np.float32]]) -> Weights:
    """Matrices as a genome."""
    return np.concatenate([matrix.ravel() for matrix in found])


def padded(matrix: NDArray[np.float32], shape: tuple[int, int]) -> NDArray[np.float32]:
    """A matrix in the corner of a larger one, of so many values in and out, that is 0 elsewhere."""
    found = np.zeros(shape[::-1], np.float32)
    found[: matrix.shape[0], : matrix.shape[1]] = matrix
    return found


def perceptron(weights: Weights, shape: Layers) -> Compute:
    """A feed-forward network with these weights."""
    return partial(perceive, matrices(weights, shape))


def perceive(layer_matrices: tuple[NDArray[np.float32], ...], inputs: NDArray[np.float32]) -> NDArray[np.float32]:
    """The outputs [..., outputs] for float32 inputs [..., inputs], one or two axes (Eq. 1), before the clamp."""
    *hidden, last = layer_matrices
    values = inputs
    for matrix in hidden:
        values = sigmoid(_dense(matrix, values))
    return _dense(last, values)


def _dense(matrix: NDArray[np.float32], values: NDArray[np.float32]) -> NDArray[np.float32]:
    # Strictly from left to right: sum and @ leave the order, and with it the last bit, open.
    if values.ndim == 1:
        return np.add.accumulate(matrix * values, axis=1)[:, -1]
    columns = np.ascontiguousarray(values.T)
    total: NDArray[np.float32] = matrix[:, :1] * columns[0]
    for j in range(1, len(columns)):
        total += matrix[:, j : j + 1] * columns[j]
    return total.T


@dataclass(slots=True)
class Recurrent:
    """A network at work: its matrices [values out, values in], and what its hidden neurons said last."""

    hidden: NDArray[np.float32]
    last: NDArray[np.float32]
    said: NDArray[np.float32] = field(init=False)

    def __post_init__(self) -> None:
        """Begin with nothing said."""
        self.reset()

    def reset(self) -> None:
        """Forget."""
        self.said = np.zeros(len(self.hidden), np.float32)

    def __call__(self, inputs: NDArray[np.float32]) -> NDArray[np.float32]:
        """Its outputs, before the clamp."""
        self.said = sigmoid(perceive((self.hidden,), np.concatenate([inputs, self.said])))
        return perceive((self.last,), self.said)
