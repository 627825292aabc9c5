"""Bounds through the whole hierarchy: influence from the master down (Eq. 2), then the commands (Eq. 3).

As in `interval`, rounding is monotone: influence is added and multiplied in float32 in the engine's order, so that its
bounds need no margin. A command, Σ command·influence / Σ influence, is a mean of what the drivers send but for
its rounding: with n drivers a share of at most (2n + 1)·2^−24, for which ROUNDING_MARGIN·(n + 2) is put on.

`prove_reach` lets every skill read something else, and so finds nothing where one skill sends p and another 1 − p.
`tighten` cuts the box of all readings, as `ranges` does, until in every part some influence is above 0, or too many
are left.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import prod
from typing import NamedTuple

import numpy as np
from mindrun.graph.graph import Graph, Program, Skill
from mindrun.graph.weights import reachable
from mindrun.numbers.arrays import Bools, Singles, WeightsBySkill
from mindrun.numbers.expression import leaves

from mindlang.proofs.interval import (
    Boxes,
    EdgeRange,
    SentBounds,
    by_itself,
    can_close,
    ranges,
    sent_bounds,
    sway_of,
    whole_box,
)

MAX_SKILL_BOXES, MAX_TOTAL_BOXES = 20_000, 500_000  # for one skill, for all of them
ROUNDING_MARGIN = 2.0**-22
MAX_BOXES, MIN_BOXES, MAX_BOX_SKILLS = 8192, 16, 100_000  # of all readings: boxes, and boxes times skills
MAX_CHOICES = 64  # that all skills make together, which are looked at one by one
MIN_INFLUENCE = 1e-30  # below this, influence is so small that rounding alone may decide a command


@dataclass(frozen=True, slots=True)
class Bound:
    """A quantity that lies between `low` and `high`."""

    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Driven:
    """Bounds of an actuator: Σ influence, and its command where that is not 0; None where it always is."""

    total: Bound
    command: Bound | None

    @property
    def is_always_driven(self) -> bool:
        """True if Σ influence is never 0, nor infinite: of one that may be, `low` is 0."""
        return self.total.low > 0


@dataclass(frozen=True, slots=True)
class ProvedReach:
    """Bounds of a hierarchy: by skill below the master what its edges send and its influence; by actuator."""

    edges: Mapping[str, tuple[EdgeRange, ...]]
    influence: Mapping[str, Bound]
    actuators: tuple[Driven, ...]


class InfluenceBounds(NamedTuple):
    """Bounds of the influence of each skill [boxes, skills], and of Σ influence of each actuator [boxes, actuators]."""

    low: Singles
    high: Singles
    total_low: Singles
    total_high: Singles


def prove_reach(graph: Graph, weights: WeightsBySkill) -> ProvedReach:
    """Bounds for any readings in 0..1; of skills without weights, and of procedures, only that they send 0..1."""
    skills = reachable(graph, graph.master)
    boxes = max(1, min(MAX_SKILL_BOXES, MAX_TOTAL_BOXES // len(skills)))
    edges = {skill.name: ranges(skill, weights.get(skill.owner), boxes) for skill in skills}
    found = influence_bounds(graph, 1, lambda skill: as_bounds(edges[skill.name]))
    drivers: list[list[EdgeRange]] = [[] for _ in graph.actuators]
    for place, skill in enumerate(graph.skills):
        if found.high[0, place] > 0:
            for edge, sends in zip(skill.edges, edges[skill.name], strict=True):
                if edge.to == "actuator":
                    drivers[edge.target].append(sends)
    influence = map(Bound, found.low[0].tolist(), found.high[0].tolist())
    totals = map(Bound, found.total_low[0].tolist(), found.total_high[0].tolist())
    return ProvedReach(
        edges,
        {skill.name: bound for skill, bound in zip(graph.skills, influence, strict=True) if skill.name in edges},
        tuple(Driven(total, _mean(sends)) for total, sends in zip(totals, drivers, strict=True)),
    )


def as_bounds(sends: Sequence[EdgeRange]) -> SentBounds:
    """The ranges of a skill's edges as what it sends in a single box."""
    low, high = np.array([[s.low for s in sends]], np.float32), np.array([[s.high for s in sends]], np.float32)
    return SentBounds(low, high, np.array([[s.sure for s in sends]], np.bool_))


def influence_bounds(graph: Graph, boxes: int, sends: Callable[[Skill], SentBounds]) -> InfluenceBounds:
    """Influence from the master down to the actuators, in so many boxes, from what each skill sends in them.

    Where skills choose, the bounds of all choices that they can make together, if these are not too many.
    """
    skills = reachable(graph, graph.master)
    sent = {skill.name: sends(skill) for skill in skills}
    choosing = [skill for skill in skills if skill.chooses]
    choices = [_choices(skill, sent[skill.name]) for skill in choosing]
    if not choosing or prod(map(len, choices)) > MAX_CHOICES:
        return _sums(graph, boxes, sent)
    least, most = np.full(boxes, np.inf, np.float32), np.zeros(boxes, np.float32)
    found = InfluenceBounds(*(bound[:, None] for bound in (least, most, least, most)))
    for made in product(*choices):
        can_be = np.logical_and.reduce([possible for possible, _ in made])[:, None]
        names = (skill.name for skill in choosing)
        case = _sums(graph, boxes, sent | dict(zip(names, (bounds for _, bounds in made), strict=True)))
        wider = zip((np.minimum, np.maximum) * 2, found, case, strict=True)
        found = InfluenceBounds(*(np.where(can_be, widest(so_far, here), so_far) for widest, so_far, here in wider))
    return found


def _choices(skill: Skill, sent: SentBounds) -> list[tuple[Bools, SentBounds]]:
    """The choices of a skill: the boxes in which it can make each, and what it sends then. One is to choose nothing."""
    influences = [number for number, edge in enumerate(skill.edges) if edge.to == "skill"]
    nothing: Bools = ~np.any(sent.sure[:, influences], axis=1)
    found: list[tuple[Bools, SentBounds]] = []
    for chosen in [*influences, None]:
        low, high, sure = sent.low.copy(), sent.high.copy(), sent.sure.copy()
        low[:, influences] = high[:, influences] = 0
        if chosen is not None:
            low[:, chosen], high[:, chosen], sure[:, chosen] = 1, 1, True
        found.append((nothing if chosen is None else sent.high[:, chosen] > 0, SentBounds(low, high, sure)))
    return found


def _sums(graph: Graph, boxes: int, sent: Mapping[str, SentBounds]) -> InfluenceBounds:
    """Influence from what each skill sends, edge by edge."""
    low, high = np.zeros((2, boxes, len(graph.skills)), np.float32)
    total_low, total_high = np.zeros((2, boxes, len(graph.actuators)), np.float32)
    places = graph.skill_numbers
    low[:, places[graph.master]] = high[:, places[graph.master]] = 1
    with np.errstate(all="ignore"):
        for skill in reachable(graph, graph.master):
            found, place = sent[skill.name], places[skill.name]
            for number, edge in enumerate(skill.edges):
                drives = edge.to == "actuator"
                if edge.to == "memory" or edge.cuts == np.inf:
                    continue
                least = low[:, place] * (1 if drives else found.low[:, number])
                most = high[:, place] * (1 if drives else found.high[:, number])
                least = np.where(least < np.float32(edge.cuts), np.float32(0), least)
                most = np.where(most < np.float32(edge.cuts), np.float32(0), most)
                arrives = found.sure[:, number] & np.isfinite(high[:, place])  # else maybe no number, and not sent
                into_low, into_high = (total_low, total_high) if drives else (low, high)
                into_low[:, edge.target] += np.where(arrives, least, np.float32(0))
                into_high[:, edge.target] += np.where(np.isnan(most), np.float32(np.inf), most)
    return InfluenceBounds(low, high, np.where(np.isfinite(total_high), total_low, np.float32(0)), total_high)


def _mean(drivers: Sequence[EdgeRange]) -> Bound | None:
    """The bounds of a weighted mean. All 0 and all 1 stay what they are: 0/Σ and Σ/Σ round to 0 and 1."""
    if not drivers:
        return None
    margin = ROUNDING_MARGIN * (len(drivers) + 2)
    low, high = min(sends.low for sends in drivers), max(sends.high for sends in drivers)
    return Bound(low if low == 1 else low * (1 - margin), min(1.0, high * (1 + margin)))


def tighten(graph: Graph, weights: WeightsBySkill, found: ProvedReach, can_be_zero: Sequence[bool]) -> ProvedReach:
    """The bounds with a better least Σ influence, for those actuators whose Σ is neither above 0 nor was seen at 0."""
    most = min(MAX_BOXES, MAX_BOX_SKILLS // len(found.edges))
    actuators = list(found.actuators)
    for place, driven in enumerate(actuators):
        if not can_be_zero[place] and driven.total.low <= 0 < driven.total.high and most >= MIN_BOXES:
            low = _least(graph, weights, found, place, most)
            actuators[place] = replace(driven, total=Bound(low, driven.total.high))
    return replace(found, actuators=tuple(actuators))


def _least(graph: Graph, weights: WeightsBySkill, found: ProvedReach, actuator: int, most: int) -> float:
    """The least Σ influence of an actuator over boxes that cover all readings; 0 where that would take too many."""
    least = np.inf

    def is_open(boxes: Boxes) -> Bools:
        nonlocal least
        low = flow(graph, weights, found, boxes).total_low[:, actuator]
        least = min(least, float(low.min(initial=np.inf, where=low > 0)))
        return low <= 0

    sway = sway_of_all(graph, reachable(graph, graph.master), weights)
    return least if can_close(whole_box(graph.width), sway, most, is_open) else 0.0


def sway_of_all(graph: Graph, skills: Iterable[Skill], weights: WeightsBySkill, program: Program = ()) -> Singles:
    """How much each of all readings moves what some skills send, and the program, roughly."""
    sway = np.zeros(graph.width, np.float32)
    sway[[*leaves(program, "reading")]] = 1
    for skill in skills:
        sway[list(skill.inputs)] += sway_of(by_itself(skill), weights.get(skill.owner))
    return sway


def flow(graph: Graph, weights: WeightsBySkill, found: ProvedReach, boxes: Boxes) -> InfluenceBounds:
    """Influence in each box, from what every skill sends there, or what it sends anywhere, whichever says more."""

    def sends(skill: Skill) -> SentBounds:
        here, anywhere = sent_bounds(skill, weights.get(skill.owner), boxes), as_bounds(found.edges[skill.name])
        low, high = np.maximum(here.low, anywhere.low), np.minimum(here.high, anywhere.high)
        return SentBounds(low, high, here.sure | anywhere.sure)

    return influence_bounds(graph, len(boxes.low), sends)
