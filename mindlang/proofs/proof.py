"""All claims about a mind, each with what it rests on.

Of what skills require it is proved that no skill above one lets it act against that, whatever is read. The box of all
readings is cut at the numbers with which conditions compare single readings: a cell on each side, and the number
itself, which is a cell of no width. In a cell such a condition holds everywhere or nowhere. Where what is sent is
learnt, branch and bound goes on from there. What a skill maintains and achieves depends on its world.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import inf, prod
from typing import Any, Literal

import numpy as np
from mindrun.graph.graph import Actuator, Edge, Graph, Program, Promise, Skill
from mindrun.graph.scopes import influence_scopes, within_scope
from mindrun.graph.weights import reachable
from mindrun.numbers.arrays import Bools, Singles, WeightsBySkill
from mindrun.numbers.expression import leaves
from networkx import DiGraph

from mindlang.compiler.hierarchy import with_ancestors
from mindlang.proofs import reach
from mindlang.proofs.interval import Boxes, EdgeRange, can_close, expression_bounds, whole_box
from mindlang.proofs.paths import Leak, Paths, influence_edges, leaks, paths
from mindlang.proofs.reach import Driven, ProvedReach
from mindlang.proofs.trying import TRIED_READINGS, Tried, is_known, readings_to_try, think_rows, try_readings

Claim = Literal["always", "can be broken", "not excluded"]
COMPARISONS = ("<", "<=", ">", ">=")


@dataclass(frozen=True, slots=True)
class Requirement:
    """The claim about a line `requires` of a skill; `readings` are some for which it acts against it, if any is known.

    `weights` names the skills above it on whose weights that rests.
    """

    skill: str
    promise: Promise
    holds: Claim
    readings: Singles | None
    weights: tuple[str, ...]


def prove_requirements(graph: Graph, weights: WeightsBySkill, found: ProvedReach) -> Iterator[Requirement]:
    """A claim for each line, of the skills below the master; `found` are the bounds of the hierarchy."""
    skills = reachable(graph, graph.master)
    known = all(is_known(skill, weights.get(skill.owner)) for skill in skills)
    sent = DiGraph((s.name, graph.skills[e.target].name) for s in skills for e in s.edges if e.to == "skill")
    for skill in skills:
        names = with_ancestors(sent, [skill.name]) - {skill.name} if skill.name in sent else set()
        above = [each for each in skills if each.name in names]
        own = tuple(dict.fromkeys(each.owner for each in above if each.owner in weights))
        for promise in (each for each in skill.promises if each.word == "requires"):
            cells, place = _cells(graph, above, promise.when), graph.skill_numbers[skill.name]
            broken = _broken(graph, weights, cells, promise.when, place) if known else None
            is_open = broken is None and _may_break(graph, weights, found, cells, promise.when, place, above)
            holds: Claim = "can be broken" if broken is not None else "not excluded" if is_open else "always"
            yield Requirement(skill.name, promise, holds, broken, own)


def _cells(graph: Graph, above: list[Skill], program: Program) -> Boxes:
    """Boxes that cover all readings, cut where the program, or one of the skills above, compares a single reading."""
    programs = [program, *(each for skill in above for edge in skill.edges for each in edge.programs)]
    ends: dict[int, set[float]] = {}
    for each in programs:
        for (word, row), (other, number), (compare, _) in zip(each, each[1:], each[2:], strict=False):
            if (word, other) == ("reading", "number") and compare in COMPARISONS and 0 < number < 1:
                ends.setdefault(int(row), set()).add(float(np.float32(number)))
    ends = {row: its for row, its in ends.items() if row in leaves(program, "reading")} | ends
    sides: dict[int, list[tuple[float, float]]] = {}
    for row, its in ends.items():
        marks = [np.float32(mark) for mark in sorted(its)]
        lows = [np.float32(0), *(each for mark in marks for each in (mark, np.nextafter(mark, np.float32(2))))]
        highs = [*(each for mark in marks for each in (np.nextafter(mark, np.float32(-1)), mark)), np.float32(1)]
        if prod(map(len, sides.values())) * len(lows) <= reach.MAX_BOXES:
            sides[row] = [(float(low), float(high)) for low, high in zip(lows, highs, strict=True)]
    cells = list(product(*sides.values()))
    made = np.array(cells, np.float32).reshape(len(cells), len(sides), 2)
    low, high = (np.repeat(bound, len(made), axis=0) for bound in whole_box(graph.width))
    low[:, [*sides]], high[:, [*sides]] = made[:, :, 0], made[:, :, 1]
    return Boxes(low, high)


def _bounds(program: Program, boxes: Boxes) -> tuple[Singles, Singles]:
    with np.errstate(all="ignore"):
        return expression_bounds(program, boxes)


def _broken(graph: Graph, weights: WeightsBySkill, cells: Boxes, program: Program, skill: int) -> Singles | None:
    """Readings for which a skill acts where the program does not hold; None where none of those tried are such."""
    tried = np.concatenate([cells.low, cells.high, readings_to_try(graph.width, TRIED_READINGS)])
    acts = think_rows(graph, weights, tried).influence[:, skill] > 0
    low, high = _bounds(program, Boxes(tried, tried))
    rows = np.flatnonzero(acts & (low == 0) & (high == 0))
    return tried[rows[0]] if len(rows) else None


def _may_break(
    graph: Graph,
    weights: WeightsBySkill,
    found: ProvedReach,
    cells: Boxes,
    program: Program,
    skill: int,
    above: list[Skill],
) -> bool:
    """False if in all boxes, cut as often as that helps, the skill has no influence or the program holds."""
    sway = reach.sway_of_all(graph, above, weights, program)
    most = min(reach.MAX_BOXES, reach.MAX_BOX_SKILLS // len(found.edges)) + len(cells.low)

    def is_open(boxes: Boxes) -> Bools:
        acts = reach.flow(graph, weights, found, boxes).high[:, skill] > 0
        return acts & ~(_bounds(program, boxes)[0] > 0)

    return not can_close(cells, sway, most, is_open)


MAX_LISTED_PATHS = 10
DECLARATION = "the declaration alone"


Neutral = Literal["always", "never", "can be", "not excluded"]


@dataclass(frozen=True, slots=True)
class ActuatorClaims:
    """All claims about an actuator. `weights` names the skills on whose weights its bounds rest."""

    actuator: Actuator
    paths: Paths
    leak: Leak | None
    driven: Driven
    tried: Tried
    weights: tuple[str, ...]

    @property
    def neutral(self) -> Neutral:
        """If Σ influence can be 0, and the actuator is sent its neutral."""
        if self.driven.command is None:
            return "always"
        if self.driven.is_always_driven:
            return "never"
        return "can be" if self.tried.readings is not None else "not excluded"

    @property
    def command(self) -> tuple[float, float]:
        """The bounds of its command, with its neutral where that is not ruled out."""
        neutral, bound = float(self.actuator.kind.neutral), self.driven.command
        if bound is None:
            return neutral, neutral
        if self.neutral == "never":
            return bound.low, bound.high
        return min(bound.low, neutral), max(bound.high, neutral)

    @property
    def is_rough(self) -> bool:
        """True if the bounds of the command leave out influence so small that rounding decides."""
        bound = self.driven.command
        return (
            bound is not None
            and self.driven.total.low < reach.MIN_INFLUENCE
            and not {bound.low, bound.high} <= {0.0, 1.0}
        )


@dataclass(frozen=True, slots=True)
class EdgeClaim:
    """The claim about an edge to another skill."""

    skill: str
    target: str
    range: EdgeRange
    weights: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Proof:
    """All claims about a mind. `unknown` says why nothing is known of the function of some skills."""

    graph: Graph
    delta: float
    unknown: Mapping[str, str]
    outside: tuple[str, ...]
    actuators: tuple[ActuatorClaims, ...]
    edges: tuple[EdgeClaim, ...]
    dead: Mapping[str, tuple[str, ...]]  # the skills on whose weights it rests
    requirements: tuple[Requirement, ...]


class _Rests:
    """The skills on whose weights a claim rests: those on the paths whose weights narrow 0..1 to less."""

    def __init__(self, graph: Graph, weights: WeightsBySkill, bounds: ProvedReach) -> None:
        self._weights = weights
        self._place = graph.skill_numbers
        self._flow, self._live = DiGraph(), DiGraph()  # what is sent, and that of it which is not always 0
        for skill in reachable(graph, graph.master):
            self._live.add_node(("skill", self._place[skill.name]))
            for edge, sends in zip(skill.edges, bounds.edges[skill.name], strict=True):
                ends = ("skill", self._place[skill.name]), (edge.to, edge.target)
                if edge.cuts < inf:
                    self._flow.add_edge(*ends, sends=(skill, edge, sends))
                if edge.cuts < inf and not sends.is_dead:
                    self._live.add_edge(*ends)

    def narrows(self, skill: Skill, edge: Edge, sends: EdgeRange) -> bool:
        """True if an edge is learnt, and its weights narrow what it sends, or ensure that a command is a number."""
        is_number = sends.sure and (edge.to == "actuator" or skill.chooses)
        narrows = sends.low > 0 or sends.high < 1 or is_number
        return edge.output is not None and skill.owner in self._weights and narrows

    def of_actuator(self, actuator: int, is_joint: bool) -> tuple[str, ...]:
        """The skills on whose weights the bounds of an actuator rest; a joint claim rests on all that have weights."""
        node = "actuator", actuator
        ways = self._ways(with_ancestors(self._flow, [node]) if node in self._flow else ())
        joint = self._weights if is_joint else ()
        return self._in_order(way[0].owner for way in ways if self.narrows(*way) or way[0].owner in joint)

    def of_dead(self, name: str) -> tuple[str, ...]:
        """The skills whose weights stop influence on its way to a dead skill."""
        ways = self._ways(with_ancestors(self._live, [("skill", self._place[name])]))
        return self._in_order(way[0].owner for way in ways if way[2].is_dead and self.narrows(*way))

    def _ways(self, to: Iterable[Any]) -> Iterator[tuple[Skill, Edge, EdgeRange]]:
        """All that is sent to some nodes, and by whom."""
        return (way for *_, way in self._flow.in_edges(to, data="sends"))

    def _in_order(self, names: Iterable[str]) -> tuple[str, ...]:
        return tuple(sorted({*names}, key=self._place.__getitem__))


def prove(graph: Graph, weights: WeightsBySkill, delta: float) -> Proof:
    """All claims about a mind under its master; `delta` is the influence of a leak.

    Of an actuator they are those of the hierarchy without the influence that is over others.
    """
    scopes = influence_scopes(graph)
    numbers = [scopes.of["actuator", place] for place in range(len(graph.actuators))]
    found = {n: _bounded(within_scope(graph, scopes, n), weights, delta) for n in {0, *numbers}}
    bounds, rests, _ = found[0]
    below = reachable(graph, graph.master)
    names = {skill.name for skill in below}
    return Proof(
        graph,
        delta,
        {
            skill.name: skill.function.opaque or "has no weights that fit"
            for skill in below
            if not is_known(skill, weights.get(skill.owner))
        },
        tuple(skill.name for skill in graph.skills if skill.name not in names),
        tuple(found[number][2][place] for place, number in enumerate(numbers)),
        tuple(_edges(graph, below, bounds, rests)),
        {name: rests.of_dead(name) for name, bound in bounds.influence.items() if bound.high <= 0},
        tuple(prove_requirements(graph, weights, bounds)),
    )


def _bounded(graph: Graph, weights: WeightsBySkill, delta: float) -> tuple[ProvedReach, _Rests, list[ActuatorClaims]]:
    """The bounds of a hierarchy, what they rest on, and the claims about each actuator."""
    count = len(graph.actuators)
    found, alone = influence_edges(graph), reach.prove_reach(graph, weights)
    tried = try_readings(graph, weights)
    bounds = reach.tighten(graph, weights, alone, [seen.readings is not None for seen in tried])
    listed, leaking = paths(found, count, MAX_LISTED_PATHS), leaks(found, count, delta)
    rests = _Rests(graph, weights, bounds)
    claims = [
        ActuatorClaims(
            actuator,
            listed[i],
            leaking[i],
            bounds.actuators[i],
            tried[i],
            rests.of_actuator(i, is_joint=bounds.actuators[i] != alone.actuators[i]),
        )
        for i, actuator in enumerate(graph.actuators)
    ]
    return bounds, rests, claims


def _edges(graph: Graph, below: Sequence[Skill], bounds: ProvedReach, rests: _Rests) -> Iterator[EdgeClaim]:
    for skill in below:
        for edge, sends in zip(skill.edges, bounds.edges[skill.name], strict=True):
            if edge.to == "skill":
                weights = (skill.owner,) if rests.narrows(skill, edge, sends) else ()
                yield EdgeClaim(skill.name, graph.named("skill", edge.target), sends, weights)
