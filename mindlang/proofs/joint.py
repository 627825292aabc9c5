"""Joint bounds: whether some skill always influences an actuator, where no single skill alone guarantees it.

`reach` lets every skill read something else, and so finds nothing where one skill sends p and another 1 − p. Here the
box of all readings is cut, as in `sharpen`, until in every part some influence is above 0, or too many parts are left.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np
from mindrun.graph.graph import Graph, Skill
from mindrun.graph.weights import Weights, reachable
from numpy.typing import NDArray

from mindlang.proofs.branch_and_bound import by_itself, halves, sway_of
from mindlang.proofs.interval import Boxes, SentBounds, Singles, sent
from mindlang.proofs.reach import Bound, InfluenceBounds, ProvedReach, as_sent, flow

MAX_BOXES, MIN_BOXES, MAX_BOX_SKILLS = 8192, 16, 100_000  # boxes, and boxes times skills
BOXES_PER_ROUND = 256


def together(
    graph: Graph, weights: Mapping[str, Weights], found: ProvedReach, can_be_zero: Sequence[bool]
) -> ProvedReach:
    """The bounds with a better least Σ influence, for those actuators whose Σ is neither above 0 nor was seen at 0."""
    most = min(MAX_BOXES, MAX_BOX_SKILLS // len(found.edges))
    actuators = list(found.actuators)
    for place, driven in enumerate(actuators):
        if not can_be_zero[place] and driven.total.low <= 0 < driven.total.high and most >= MIN_BOXES:
            low = _least(graph, weights, found, place, most)
            actuators[place] = replace(driven, total=Bound(low, driven.total.high))
    return replace(found, actuators=tuple(actuators))


def _least(graph: Graph, weights: Mapping[str, Weights], found: ProvedReach, actuator: int, most: int) -> float:
    """The least Σ influence of an actuator over boxes that cover all readings; 0 where that would take too many."""
    skills = {skill.name: skill for skill in reachable(graph, graph.master)}
    sway = _sway(graph, weights, skills.values())
    waiting = Boxes(np.zeros((1, graph.width), np.float32), np.ones((1, graph.width), np.float32))
    least, made = np.inf, 1
    while len(waiting.low):
        now, waiting = _part(waiting, slice(BOXES_PER_ROUND)), _part(waiting, slice(BOXES_PER_ROUND, None))
        low = _flow(graph, weights, skills, found, now).total_low[:, actuator]
        is_open = low <= 0
        made += 2 * int(is_open.sum())
        if made > most or not sway.any():
            return 0.0
        least = min(least, float(low[~is_open].min(initial=np.inf)))
        if is_open.any():
            cut = halves(_part(now, is_open), sway)
            if (cut.low == cut.high).any():
                return 0.0  # between neighbours of float32 nothing is left to cut
            waiting = Boxes(np.concatenate([cut.low, waiting.low]), np.concatenate([cut.high, waiting.high]))
    return least


def _flow(
    graph: Graph, weights: Mapping[str, Weights], skills: Mapping[str, Skill], found: ProvedReach, boxes: Boxes
) -> InfluenceBounds:
    """Influence in each box, from what every skill sends there, or what it sends anywhere, whichever says more."""

    def sends(name: str) -> SentBounds:
        here, anywhere = sent(skills[name], weights.get(skills[name].owner), boxes), as_sent(found.edges[name])
        low, high = np.maximum(here.low, anywhere.low), np.minimum(here.high, anywhere.high)
        return SentBounds(low, high, here.sure | anywhere.sure)

    return flow(graph, len(boxes.low), sends)


def _sway(graph: Graph, weights: Mapping[str, Weights], skills: Collection[Skill]) -> Singles:
    """How much each reading moves what all skills send, roughly."""
    sway = np.zeros(graph.width, np.float32)
    for skill in skills:
        sway[list(skill.inputs)] += sway_of(by_itself(skill), weights.get(skill.owner))
    return sway


def _part(boxes: Boxes, rows: slice | NDArray[np.bool_]) -> Boxes:
    return Boxes(boxes.low[rows], boxes.high[rows])
