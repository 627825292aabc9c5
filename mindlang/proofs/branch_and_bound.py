"""Bounds of what a skill sends over each edge, for any readings, made tighter by branch and bound.

A box whose bounds reach no further than what the skill was seen to send cannot be improved on, and is left alone.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import reduce
from typing import NamedTuple

import numpy as np
from mindrun.graph.graph import Edge, Gate, Program, Skill
from mindrun.graph.weights import Weights
from mindrun.kinds.functions.mlp import Mlp
from mindrun.numbers.arrays import Bools, Singles

from mindlang.proofs.interval import (
    Boxes,
    is_known,
    join_boxes,
    known_matrices,
    select_boxes,
    sent_bounds,
    whole_box,
)
from mindlang.proofs.trying import readings_to_try, sent_values

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
