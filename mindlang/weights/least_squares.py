"""Weights of a function fitted to inputs and outputs by Levenberg and Marquardt's method, from several beginnings.

The derivatives are differences: all weights, each a little other, go through the function's own `forward` at once.
Products of matrices are those of numpy, whose sums each processor takes in an order of its own: the same seed gives the
same weights on the same machine, and on another ones that do as well.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from mindrun.kinds.functions.function import Function
from mindrun.numbers.arrays import Doubles
from mindrun.numbers.network import Terms
from mindrun.train.population import MAX_WEIGHT
from numpy.typing import NDArray

DRAWN_GENOMES, FIRST_STEPS, LAST_STEPS = 12, 12, 40  # genomes drawn; steps of each; steps of the best of them
FEW_OF_TICKS = 5  # the first steps see one of so many; of a function that remembers each sequence's first
WEIGHT_STEP = 1e-6  # of a weight, for a derivative
DAMPING_BOUNDS = 1e-3, 1e-9, 1e9  # the first, the least, and the one at which a step is given up
RIDGE_SHARE = 1e-7  # of each squared weight, of what a squared error of one counts: weights stay small where they may
LEAST_GAIN = 1e-5  # of the error: a step that gains less is the last
CHUNK_NUMBERS = 1 << 21  # genomes times rows that are computed at once


@dataclass(frozen=True, slots=True)
class Examples:
    """Sequences of inputs [ticks, sequences, inputs] and the outputs wanted of them [ticks, sequences, outputs].

    Outputs that are NaN are not compared.
    """

    inputs: Doubles
    wanted: Doubles

    def part(self, rows: slice, axis: int = 0) -> "Examples":
        """Some of the ticks, or with axis 1 of the sequences."""
        cut = (slice(None),) * axis + (rows,)
        return Examples(self.inputs[cut], self.wanted[cut])


def fitted(function: Function, examples: Examples, seed: int, told: Callable[[int], object]) -> NDArray[np.float32]:
    """The genome whose outputs have the least squared error; `told` hears of each step: `step_count()` at most."""
    many, outputs = examples.inputs.shape[2], examples.wanted.shape[2]
    begun = function.draw(many, outputs, DRAWN_GENOMES, np.random.default_rng(seed)).astype(np.float64)
    ticks = len(examples.inputs)
    remembers = bool(function.state_length(many, outputs))
    few = examples.part(slice(max(1, ticks // FEW_OF_TICKS)) if remembers else slice(0, None, FEW_OF_TICKS))
    tried = [_descended(function, few, genome, FIRST_STEPS, told) for genome in begun]
    best = min(tried, key=lambda genome: _error(function, examples, genome))
    return _descended(function, examples, best, LAST_STEPS, told).astype(np.float32)


def step_count() -> int:
    """The number of steps of a whole fit, if none ends early."""
    return DRAWN_GENOMES * FIRST_STEPS + LAST_STEPS


def _descended(
    function: Function, examples: Examples, genome: Doubles, steps: int, told: Callable[[int], object]
) -> Doubles:
    """A genome after so many steps."""
    damping, least, most = DAMPING_BOUNDS
    error, curvature, slope = _linear(function, examples, genome)
    for step in range(steps):
        before = error
        while damping < most:
            damped = curvature + damping * np.diag(np.diag(curvature) + least)
            moved = np.clip(genome - np.linalg.solve(damped, slope), -MAX_WEIGHT, MAX_WEIGHT)
            if _error(function, examples, moved) < error:
                genome, damping = moved, max(least, damping / 4)
                error, curvature, slope = _linear(function, examples, genome)
                break
            damping *= 4
        if before - error <= LEAST_GAIN * before:
            told(steps - step)
            break
        told(1)
    return genome


def _error(function: Function, examples: Examples, genome: Doubles) -> float:
    """The sum of squared errors, and of the weights' own."""
    found = np.square(_residuals(function, examples, genome[None])).sum()
    return float(found) + RIDGE_SHARE * examples.wanted.size * float(genome @ genome)


def _linear(function: Function, examples: Examples, genome: Doubles) -> tuple[float, Doubles, Doubles]:
    """The error, and in its neighbourhood JᵀJ and Jᵀr, summed over parts of the examples."""
    ridge = RIDGE_SHARE * examples.wanted.size
    error, curvature, slope = ridge * float(genome @ genome), ridge * np.eye(len(genome)), ridge * genome
    others = np.concatenate([genome[None], genome + WEIGHT_STEP * np.eye(len(genome))])
    ticks, sequences, _ = examples.inputs.shape
    along = 1 if function.state_length(examples.inputs.shape[2], examples.wanted.shape[2]) else 0
    rows = max(1, CHUNK_NUMBERS // (len(others) * (ticks if along else sequences)))
    for first in range(0, examples.inputs.shape[along], rows):
        found = _residuals(function, examples.part(slice(first, first + rows), along), others)
        residuals, derivatives = found[0], (found[1:] - found[0]) / WEIGHT_STEP
        error += float(residuals @ residuals)
        curvature += derivatives @ derivatives.T
        slope += derivatives @ residuals
    return error, curvature, slope


def _residuals(function: Function, examples: Examples, genomes: Doubles) -> Doubles:
    """Outputs less those wanted [genomes, numbers] before the clamp; 0 where the clamp would make no difference.

    So an output that is outside 0..1 is led back, where less or more is wanted.
    """
    inputs, wanted = examples.inputs, examples.wanted
    shapes = function.matrix_shapes(inputs.shape[2], wanted.shape[2])
    ends = np.cumsum([into * out for into, out in shapes])[:-1]
    parts = zip(np.split(genomes.T, ends), shapes, strict=True)
    matrices = [part.reshape(out, into, len(genomes)) for part, (into, out) in parts]
    length = function.state_length(inputs.shape[2], wanted.shape[2])
    rows = inputs if length else inputs.reshape(1, -1, inputs.shape[2])
    state, outputs = np.zeros((rows.shape[1], len(genomes), length)), []
    for values in rows:
        alike = np.broadcast_to(values[:, None], (len(values), len(genomes), values.shape[1]))
        sent, state = function.forward(SIDE_BY_SIDE, matrices, alike, state)
        outputs.append(sent)
    computed = np.moveaxis(np.stack(outputs), 2, 0).reshape(len(genomes), *wanted.shape)
    is_beyond = ((wanted <= 0) & (computed < 0)) | ((wanted >= 1) & (computed > 1)) | np.isnan(wanted)
    return np.where(is_beyond, 0.0, computed - wanted).reshape(len(genomes), -1)


def _product(values: Doubles, matrix: Doubles) -> Doubles:
    """The sums [rows, genomes, out] of values [rows, genomes, in], of each genome its matrix [out, in, genomes]."""
    return (values.transpose(1, 0, 2) @ matrix.transpose(2, 1, 0)).transpose(1, 0, 2)


SIDE_BY_SIDE = Terms(  # of numbers [rows, genomes, values]
    product=_product,
    sigmoid=lambda values: 0.5 * np.tanh(0.5 * values) + 0.5,
    joined=lambda one, other: np.concatenate([one, other], axis=-1),
    biased=lambda values: np.concatenate([np.ones_like(values[..., :1]), values], axis=-1),
)
