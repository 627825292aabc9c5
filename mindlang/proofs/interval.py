"""Intervals through what a skill computes (Eq. 1), over many boxes of readings at once.

Rounding to nearest is monotone: where a ≤ b, the rounded a + x is at most the rounded b + x, and so with − × ÷. A bound
that is computed by the engine's operations, in its precision and its order, is therefore a bound of what the engine
computes, rounding included. Only the sigmoid, a quotient, needs a margin: `SIGMOID_ERROR`.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple, TypeVar

import numpy as np
from mindrun.graph.graph import Gate, Program, Skill
from mindrun.graph.weights import Weights, genes
from mindrun.numbers.arithmetic import sigmoid
from mindrun.numbers.arrays import OPERATORS, Bools, Doubles, Singles
from mindrun.numbers.expression import fold
from mindrun.numbers.network import FLOAT32, NOTHING, matrices
from numpy.typing import NDArray

# More than the rounded sigmoid falls while its argument rises: 3.58e-7, measured over all float32 (docs/proofs.md).
SIGMOID_ERROR = np.float32(5e-7)


class Boxes(NamedTuple):
    """Boxes of readings: `low` and `high` [boxes, graph.width]."""

    low: Singles
    high: Singles


class SentBounds(NamedTuple):
    """Bounds of what a skill sends [boxes, edges], clamped to 0..1; if not `sure`, it may be NaN and not sent."""

    low: Singles
    high: Singles
    sure: Bools


Bounds = TypeVar("Bounds", bound=tuple[Any, ...])  # NamedTuples of arrays [boxes, …]


def whole_box(width: int) -> Boxes:
    """One box with all readings there are."""
    return Boxes(np.zeros((1, width), np.float32), np.ones((1, width), np.float32))


def select_boxes(of: Bounds, boxes: slice | NDArray[np.intp] | Bools) -> Bounds:
    """Some of the boxes."""
    some: list[Any] = [each[boxes] for each in of]
    return type(of)(*some)


def join_boxes(first: Bounds, second: Bounds) -> Bounds:
    """The boxes of both."""
    both: list[Any] = [np.concatenate(pair) for pair in zip(first, second, strict=True)]
    return type(first)(*both)


def is_known(skill: Skill, weights: Weights | None) -> bool:
    """True if bounds of the skill's function can be computed: it is neither untaught nor Python code."""
    return skill.outputs == 0 or (not skill.function.opaque and (weights is not None or genes(skill) == 0))


def sent_bounds(skill: Skill, weights: Weights | None, boxes: Boxes) -> SentBounds:
    """Bounds of what a skill sends over each of its edges; 0..1 where its function is not known."""
    count, edges = len(boxes.low), len(skill.edges)
    low, high = np.full((2, count, edges), [[[-np.inf]], [[np.inf]]], np.float32)
    sure = np.ones((count, edges), np.bool_)
    with np.errstate(all="ignore"):
        outputs = _outputs(skill, weights, boxes)
        for number, edge in enumerate(skill.edges):
            if edge.output is None:
                low[:, number], high[:, number] = expression_bounds(edge.value, boxes)
            elif outputs is not None:
                low[:, number], high[:, number] = outputs[0][:, edge.output], outputs[1][:, edge.output]
            if edge.gate:
                low[:, number], high[:, number], sure[:, number] = _gated(
                    edge.gate, low[:, number], high[:, number], boxes
                )
    sure &= np.isfinite(low) & np.isfinite(high)
    if skill.chooses:
        _choose([number for number, edge in enumerate(skill.edges) if edge.to == "skill"], low, high, sure)
    return SentBounds(np.clip(low, 0, 1), np.clip(high, 0, 1), sure)


def _choose(influences: Sequence[int], low: Singles, high: Singles, sure: Bools) -> None:
    """Bounds of what is sent in place of those of values before the clamp: 1 over the greatest, of equals the first."""
    always, never = np.ones((2, *low.shape), np.bool_)
    for one in influences:
        never[:, one] = False
        for other in (each for each in influences if each != one):
            loses, wins = (np.less, np.greater_equal) if other < one else (np.less_equal, np.greater)
            always[:, one] &= loses(high[:, other], low[:, one])
            never[:, one] |= sure[:, other] & wins(low[:, other], high[:, one])
    low[:, influences], high[:, influences] = always[:, influences], ~never[:, influences]


def _gated(gate: Gate, low: Singles, high: Singles, boxes: Boxes) -> tuple[Singles, Singles, Bools]:
    """The bounds of what is sent through a gate, and where it is sure that something is."""
    never, always = expression_bounds(gate.when, boxes)
    is_known = np.isfinite(never) & np.isfinite(always)
    can_open, can_close = always > 0, never <= 0
    if gate.otherwise is None:
        nothing = np.float32(0)
        return np.where(can_open, low, nothing), np.where(can_open, high, nothing), is_known & ~can_close
    least, most = expression_bounds(gate.otherwise, boxes)
    least, most = np.where(can_open, np.minimum(low, least), least), np.where(can_open, np.maximum(high, most), most)
    return np.where(can_close, least, low), np.where(can_close, most, high), is_known


def known_matrices(skill: Skill, weights: Weights | None) -> tuple[Singles, ...]:
    """The matrices of its function; none where it has nothing to learn, or was not taught."""
    return () if weights is None else matrices(weights, skill.function.layers(len(skill.inputs), skill.outputs))


def _outputs(skill: Skill, weights: Weights | None, boxes: Boxes) -> tuple[Singles, Singles] | None:
    """The outputs of its function; None where nothing is known of them."""
    if not is_known(skill, weights):
        return None
    found, inputs = known_matrices(skill, weights), list(skill.inputs)
    if not found:
        nothing = np.zeros((len(boxes.low), skill.outputs), np.float32)
        return nothing, nothing
    read = np.array([boxes.low[:, inputs], boxes.high[:, inputs]])
    low, high = skill.function.forward(BOUNDS, found, read, NOTHING)[0]
    return low, high


def _product(values: Singles, matrix: Singles) -> Singles:
    """Σ weight · value in the order of the values, as the engine adds: a weight below 0 turns an interval round.

    Weights are finite and values at most 1, so a sum can overflow, and stays infinite then, but is never NaN.
    """
    low, high = values
    rising, falling = np.maximum(matrix, 0), np.minimum(matrix, 0)
    least, most = np.zeros((2, len(low), len(matrix)), np.float32)
    for j in range(matrix.shape[1]):
        first, last = low[:, j, None], high[:, j, None]
        least += rising[:, j] * first + falling[:, j] * last  # one of the two is 0, so this rounds once
        most += rising[:, j] * last + falling[:, j] * first
    return np.array([least, most])


def _sigmoid(values: Singles) -> Singles:
    low, high = sigmoid(values)
    return np.array([np.maximum(low - SIGMOID_ERROR, 0), np.minimum(high + SIGMOID_ERROR, 1)])


BOUNDS = FLOAT32._replace(product=_product, sigmoid=_sigmoid)  # the terms of bounds [2, boxes, values], low and high


def expression_bounds(program: Program, boxes: Boxes) -> tuple[Singles, Singles]:
    """The bounds of an `at` expression, which the engine computes in float64; infinite where it may be no number."""

    def leaf(word: str, operand: float | int) -> tuple[Doubles, Doubles]:
        if word == "reading":
            return boxes.low[:, int(operand)].astype(np.float64), boxes.high[:, int(operand)].astype(np.float64)
        return (np.full(len(boxes.low), operand, np.float64),) * 2

    low, high = fold(program, leaf, lambda value: (-value[1], -value[0]), _combined)
    return low.astype(np.float32), high.astype(np.float32)


def _combined(operator: str, left: tuple[Doubles, Doubles], right: tuple[Doubles, Doubles]) -> tuple[Doubles, Doubles]:
    """All operators have their least and greatest value in corners, unless the divisor can be 0."""
    corners = [OPERATORS[operator](a, b) for a in left for b in right]
    low, high = np.minimum.reduce(corners), np.maximum.reduce(corners)
    wild = ~(np.isfinite(low) & np.isfinite(high) & np.isfinite(left[0]) & np.isfinite(right[0]))
    if operator == "/":
        wild |= np.sign(right[0]) != np.sign(right[1])
    return np.where(wild, -np.inf, low), np.where(wild, np.inf, high)
