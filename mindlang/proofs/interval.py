"""Intervals through what a skill computes (Eq. 1), over many boxes of readings at once.

Rounding to nearest is monotone: where a ≤ b, the rounded a + x is at most the rounded b + x, and so with − × ÷. A bound
that is computed by the engine's operations, in its precision and its order, is therefore a bound of what the engine
computes, rounding included. Only the sigmoid, a quotient, needs a margin: `SIGMOID_ERROR`.

For any readings the bounds are made tighter by branch and bound. A box whose bounds reach no further than what the
skill was seen to send cannot be improved on, and is left alone.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from typing import Any, NamedTuple, TypeVar

import numpy as np
from mindrun.graph.graph import Edge, Gate, Program, Skill
from mindrun.graph.weights import Weights
from mindrun.kinds.functions.mlp import Mlp
from mindrun.numbers.arithmetic import sigmoid
from mindrun.numbers.arrays import OPERATORS, Bools, Doubles, Singles
from mindrun.numbers.expression import fold
from mindrun.numbers.network import FLOAT32, NOTHING
from numpy.typing import NDArray

from mindlang.proofs.trying import is_known, known_matrices, readings_to_try, sent_values

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
    some: list[Any] = [each[boxes] for each in of]
    return type(of)(*some)


def join_boxes(first: Bounds, second: Bounds) -> Bounds:
    both: list[Any] = [np.concatenate(pair) for pair in zip(first, second, strict=True)]
    return type(first)(*both)


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


SHARP_ENOUGH = 1e-3  # a bound this near to a value that was seen is sharp enough, but for 0 and 1
BOXES_PER_ROUND = 256  # boxes that are cut in one round
SAMPLED_READINGS = 2048  # readings, half of them corners of the box


@dataclass(frozen=True, slots=True)
class EdgeRange:
    """Proved bounds of what an edge sends, and the range that was seen; `sure` if it always sends a number."""

    low: float
    high: float
    sure: bool
    seen: tuple[float, float] | None = None

    @property
    def is_dead(self) -> bool:
        """True if the edge never sends more than 0."""
        return self.high <= 0


class Pool(NamedTuple):
    """Boxes of readings, `least` to `most` [boxes, width], and the bounds of what is sent in them [boxes, edges]."""

    least: Singles
    most: Singles
    low: Singles
    high: Singles
    sure: Bools


def ranges(skill: Skill, weights: Weights | None, most: int) -> tuple[EdgeRange, ...]:
    """The range of each edge of a skill when its readings may be anything in 0..1, from at most so many boxes."""
    if not is_known(skill, weights) and skill.outputs == len(skill.edges):
        return tuple(EdgeRange(0.0, 1.0, sure=False) for _ in skill.edges)
    skill = by_itself(skill)
    low, high = _seen(skill, weights)
    found = reduce(join_boxes, _cut(skill, weights, low, high, most))
    bounds = [found.low.min(axis=0), found.high.max(axis=0), found.sure.all(axis=0)]
    known = is_known(skill, weights)
    seen = [
        (least, most_) if least <= most_ and (known or not _is_hidden(skill, edge)) else None
        for edge, least, most_ in zip(skill.edges, low.tolist(), high.tolist(), strict=True)
    ]
    return tuple(EdgeRange(*each) for each in zip(*(bound.tolist() for bound in bounds), seen, strict=True))


def by_itself(skill: Skill) -> Skill:
    """The skill with its inputs renumbered from 0, so that boxes have only the readings that it reads."""
    place = {reading: number for number, reading in enumerate(skill.inputs)}

    def moved(program: Program) -> Program:
        return tuple((word, place[int(x)] if word == "reading" else x) for word, x in program)

    def moved_edge(edge: Edge) -> Edge:
        gate = edge.gate and Gate(*map(moved, edge.gate.programs))
        return replace(edge, value=moved(edge.value), gate=gate)

    return replace(skill, inputs=tuple(range(len(place))), edges=tuple(moved_edge(edge) for edge in skill.edges))


def _seen(skill: Skill, weights: Weights | None) -> tuple[Singles, Singles]:
    """The least and the most that each edge sends for readings that are tried; 0 and 1 where it cannot be known."""
    tried = readings_to_try(len(skill.inputs), SAMPLED_READINGS)
    known = is_known(skill, weights)
    found = sent_values(skill if known else replace(skill, function=Mlp(), inputs=()), weights, tried)
    sound = np.isfinite(found)
    found = np.clip(found, 0, 1)
    low, high = found.min(axis=0, initial=1, where=sound), found.max(axis=0, initial=0, where=sound)
    hidden = [not known and _is_hidden(skill, edge) for edge in skill.edges]
    return np.where(hidden, np.float32(0), low), np.where(hidden, np.float32(1), high)


def _is_hidden(skill: Skill, edge: Edge) -> bool:
    """True if what an edge sends depends on the skill's function: it is an output, or chosen beside outputs."""
    return edge.output is not None or (skill.chooses and edge.to == "skill")


def _cut(skill: Skill, weights: Weights | None, low: Singles, high: Singles, most: int) -> list[Pool]:
    """Pools that cover the box together; the boxes that say least are cut first."""
    sides = len(skill.inputs)
    open_, done, made = _pool(skill, weights, whole_box(sides)), [], 1
    sway = sway_of(skill, weights)
    while True:
        excess = _excess(open_, low, high)
        done.append(select_boxes(open_, excess <= 0))
        open_, excess = select_boxes(open_, excess > 0), excess[excess > 0]
        if not len(excess) or made >= most or sides == 0:
            return [*done, open_]
        order = np.argsort(-excess, kind="stable")
        worst = select_boxes(open_, order[:BOXES_PER_ROUND])
        cut = halves(Boxes(worst.least, worst.most), sway)
        made += len(cut.low)
        open_ = join_boxes(select_boxes(open_, order[BOXES_PER_ROUND:]), _pool(skill, weights, cut))


def _pool(skill: Skill, weights: Weights | None, boxes: Boxes) -> Pool:
    sent = sent_bounds(skill, weights, boxes)
    return Pool(boxes.low, boxes.high, sent.low, sent.high, sent.sure)


def _excess(found: Pool, low: Singles, high: Singles) -> Singles:
    """How far the bounds of each box exceed what was seen, the most of its edges; 0 where that is close."""
    below, above = np.maximum(low - found.low, 0), np.maximum(found.high - high, 0)
    below[(below <= SHARP_ENOUGH) & (low < 1)] = 0  # "always 1" and "always 0" are to be proved exactly
    above[(above <= SHARP_ENOUGH) & (high > 0)] = 0
    farthest: Singles = np.maximum(below, above).max(axis=1)
    return farthest


def sway_of(skill: Skill, weights: Weights | None) -> Singles:
    """Roughly how much each reading changes what is sent: used to choose which side of a box to cut."""
    sway = np.full(len(skill.inputs), 1e-6, np.float32)
    for edge in skill.edges:
        for word, reading in (term for program in edge.programs for term in program):
            if word == "reading":
                sway[int(reading)] += 1
    for matrix in known_matrices(skill, weights)[:1]:
        begin = skill.function.bias
        sway += np.minimum(np.abs(matrix[:, begin : begin + len(sway)]), 1e6).sum(axis=0)
    return sway


def can_close(boxes: Boxes, sway: Singles, most: int, is_open: Callable[[Boxes], Bools]) -> bool:
    """True if no box `is_open` any more after each that is was cut, and so on; False where that makes too many."""
    made = len(boxes.low)
    while len(boxes.low):
        now, boxes = (select_boxes(boxes, part) for part in (slice(BOXES_PER_ROUND), slice(BOXES_PER_ROUND, None)))
        open_ = select_boxes(now, is_open(now))
        made += 2 * len(open_.low)
        if not len(open_.low):
            continue
        if made > most or not ((open_.high - open_.low) * sway).max(axis=1, initial=0).all():
            return False
        cut = halves(open_, sway)
        if (cut.low == cut.high).all(axis=1).any():
            return False  # between neighbours of float32 nothing is left to cut
        boxes = join_boxes(cut, boxes)
    return True


def halves(boxes: Boxes, sway: Singles) -> Boxes:
    """Every box cut in two across the side that matters most."""
    low, high = boxes.low, boxes.high
    rows, side = np.arange(len(low)), ((high - low) * sway).argmax(axis=1)
    middle = (low[rows, side] + high[rows, side]) / 2
    upper, lower = low.copy(), high.copy()
    upper[rows, side], lower[rows, side] = middle, middle
    return join_boxes(Boxes(low, lower), Boxes(upper, high))
