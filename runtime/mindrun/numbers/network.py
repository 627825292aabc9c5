"""Networks (Eq. 1): genomes as matrices, and the outputs for inputs, in float32 and in a fixed order."""

from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mindrun.numbers.arithmetic import sigmoid
from mindrun.numbers.arrays import Layers, Weights

Matrix = NDArray[np.float32]


def matrices(weights: Weights, shape: Layers) -> tuple[Matrix, ...]:
    """A genome as one matrix [values out, values in] per layer: it holds them layer by layer, row by row."""
    ends = np.cumsum([before * after for before, after in shape])[:-1]
    parts = np.split(weights, ends) if shape else []
    return tuple(part.reshape(after, before) for part, (before, after) in zip(parts, shape, strict=True))


def genome(found: Iterable[Matrix]) -> Weights:
    """Matrices as a genome: one after the other, row by row."""
    return np.concatenate([matrix.ravel() for matrix in found])


def padded(matrix: Matrix, shape: tuple[int, int], cut: int, place: int) -> Matrix:
    """A matrix enlarged with zeros to a shape (values in, values out); its columns from `cut` on move to `place`."""
    found = np.zeros(shape[::-1], np.float32)
    rows, columns = matrix.shape
    found[:rows, :cut], found[:rows, place : place + columns - cut] = matrix[:, :cut], matrix[:, cut:]
    return found


class Terms(NamedTuple):
    """The operations of a network, on arrays or tensors [..., values]."""

    product: Callable[[Any, Any], Any]  # of values and a matrix [values out, values in]: the sums, from the first on
    sigmoid: Callable[[Any], Any]
    joined: Callable[[Any, Any], Any]  # the values of two side by side
    biased: Callable[[Any], Any]  # 1 before the values


def product(values: Matrix, matrix: Matrix) -> Matrix:
    """The sums [..., values out] of values [..., values in], of one axis or two, strictly from left to right."""
    # sum and @ leave the order, and with it the last bit, open.
    if values.ndim == 1:
        return np.add.accumulate(matrix * values, axis=1)[:, -1]
    columns = np.ascontiguousarray(values.T)
    total: Matrix = matrix[:, :1] * columns[0]
    for j in range(1, len(columns)):
        total += matrix[:, j : j + 1] * columns[j]
    return total.T


def _joined(one: Matrix, other: Matrix) -> Matrix:
    return np.concatenate([one, other], axis=-1)


def _biased(values: Matrix) -> Matrix:
    return _joined(np.ones((*values.shape[:-1], 1), values.dtype), values)


FLOAT32 = Terms(product, sigmoid, _joined, _biased)
NOTHING = np.zeros(0, np.float32)
Forward = Callable[[Terms, Sequence[Any], Any, Any], tuple[Any, Any]]


class StatefulNetwork:
    """A network with a state [length] that it remembers from one tick to the next, at first zeros."""

    def __init__(self, forward: Forward, matrices: tuple[Matrix, ...], length: int) -> None:
        self.forward, self.matrices, self.length = forward, matrices, length
        self.reset()

    def reset(self) -> None:
        """Set the state to zeros."""
        self.state = np.zeros(self.length, np.float32)

    def __call__(self, inputs: Matrix) -> Matrix:
        """The outputs for inputs [inputs], before the clamp; the state goes on."""
        outputs, self.state = self.forward(FLOAT32, self.matrices, inputs, self.state)
        return outputs  # type: ignore[no-any-return]
