"""Paths of influence to an actuator, and the worst that small leaks can do, from the declaration alone.

A path leads over lines that can send more than 0 whatever the weights are: `influences X at 0` is no path.

Leaks are the open question of the paper's section 9. One path is meant: each of its skills sends all that its line
allows along the path, and should send 0 over its other learnt lines, but sends δ there. Below a leak anything may
happen: 1 over every learnt line, over `at` its maximum. Influence multiplies on its way (Eq. 2), so with v the values
along the path and W(m) the weighted number of ways from m to the actuator, the unwanted influence there, as a multiple
of the wanted one, is at most

    U = Σ over the path's skills n, over other learnt lines n → m, of δ·W(m) / Π of v from n down,

and U / (1 + U) of the command (Eq. 3) is not the driver's. A line that `cuts below` c does not leak at a skill whose
influence is at most I, if δ·I < c: what would arrive there is none. U is found from the master down: of a skill's
parents the worst counts, because more leaks above a skill are never better. So all paths are compared, and none is
listed.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np
from mindrun.graph.graph import Edge, Graph, Skill
from mindrun.graph.weights import reachable
from mindrun.numbers.arrays import Doubles
from networkx import DiGraph, all_simple_paths

from mindlang.compiler.hierarchy import with_ancestors
from mindlang.proofs.interval import Boxes, expression_bounds, whole_box

MAX_COUNTED_PATHS = 10**15  # stands for itself and for more
Row = Doubles  # one value per actuator


@dataclass(frozen=True, slots=True)
class Paths:
    """How many paths lead to an actuator, up to MAX_COUNTED_PATHS, and the first: names of skills, the driver last."""

    count: int
    first: tuple[tuple[str, ...], ...]


@dataclass(frozen=True, slots=True)
class InfluenceEdge:
    """An edge that can carry influence to another skill, by its index: how much at most, and whether it is learnt.

    What would arrive with less than `cuts` does not.
    """

    target: int
    most: float
    is_learnt: bool
    cuts: float = 0.0


@dataclass(frozen=True, slots=True)
class InfluenceEdges:
    """Influence edges and driven actuators by skill index; `skills` are those below the master, parents first."""

    names: tuple[str, ...]
    skills: tuple[int, ...]
    onward: tuple[tuple[InfluenceEdge, ...], ...]
    drives: tuple[tuple[int, ...], ...]


def influence_edges(graph: Graph) -> InfluenceEdges:
    """The edges that can carry influence, whatever the weights are."""
    place = graph.skill_numbers
    everything = whole_box(graph.width)
    onward = [[_influence_edge(skill, e, everything) for e in skill.edges if e.to == "skill"] for skill in graph.skills]
    drives = [tuple(edge.target for edge in skill.edges if edge.to == "actuator") for skill in graph.skills]
    below = tuple(place[skill.name] for skill in reachable(graph, graph.master))
    able = tuple(tuple(edge for edge in edges if edge.most > 0 and edge.cuts < np.inf) for edges in onward)
    return InfluenceEdges(tuple(place), below, able, tuple(drives))


def _influence_edge(skill: Skill, edge: Edge, everything: Boxes) -> InfluenceEdge:
    if skill.chooses:  # 1 or 0, and nothing between that leaks
        return InfluenceEdge(edge.target, 1.0, False, edge.cuts)
    if edge.output is not None:
        learns = skill.function.learns  # Python code is as exact as it is written
        return InfluenceEdge(edge.target, 1.0, learns, edge.cuts)
    with np.errstate(all="ignore"):
        sent_values = [edge.value] + ([edge.gate.otherwise] if edge.gate and edge.gate.otherwise is not None else [])
        most = max(expression_bounds(value, everything)[1][0] for value in sent_values)
    return InfluenceEdge(edge.target, float(np.clip(most, 0, 1)), False, edge.cuts)


def paths(found: InfluenceEdges, actuators: int, listed: int) -> list[Paths]:
    counts = dict.fromkeys(found.skills, 0) | {found.skills[0]: 1}  # of paths from the master to each skill
    for skill in found.skills:
        for way in found.onward[skill]:
            counts[way.target] = min(MAX_COUNTED_PATHS, counts[way.target] + counts[skill])
    return [
        Paths(
            min(MAX_COUNTED_PATHS, sum(counts[skill] for skill in found.skills if actuator in found.drives[skill])),
            tuple(islice(_first(found, actuator), listed)),
        )
        for actuator in range(actuators)
    ]


def _first(found: InfluenceEdges, actuator: int) -> Iterator[tuple[str, ...]]:
    """All paths to an actuator, in the order of the lines; only edges that lead to it are followed."""
    graph, end = DiGraph(), -1  # the actuator, below all that drive it
    graph.add_nodes_from((found.skills[0], end))
    for skill in found.skills:
        graph.add_edges_from((skill, end) for driven in found.drives[skill] if driven == actuator)
        graph.add_edges_from((skill, way.target) for way in found.onward[skill])
    graph.remove_nodes_from({*graph} - with_ancestors(graph, [end]))
    if found.skills[0] in graph:
        for path in all_simple_paths(graph, found.skills[0], end):
            yield tuple(found.names[skill] for skill in path[:-1])


@dataclass(frozen=True, slots=True)
class Level:
    """A skill on the worst path: the `share` of the command that its own leaks can take, and into which skills."""

    skill: str
    share: float
    into: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Leak:
    """The worst path of an actuator, from the master to the driver, and the share of the command that leaks take."""

    share: float
    levels: tuple[Level, ...]

    @property
    def worst(self) -> Level | None:
        """The level that leaks most."""
        most = max(self.levels, key=lambda level: level.share)
        return most if most.share > 0 else None


def leaks(found: InfluenceEdges, actuators: int, delta: float) -> list[Leak | None]:
    """For each actuator the worst case of a leak of `delta`; None where no path leads to it."""
    with np.errstate(all="ignore"):  # where the ways are too many for a number, they are infinitely many
        search = _Leaks(_without_cut(found, delta), actuators, delta)
        return [search.worst_path(actuator) for actuator in range(actuators)]


def _without_cut(found: InfluenceEdges, delta: float) -> InfluenceEdges:
    """The edges without the leaks that lines cut: where δ times the greatest influence of the skill is too small."""
    most = dict.fromkeys(found.skills, 0.0)
    most[found.skills[0]] = 1.0
    onward = list(found.onward)
    for skill in found.skills:
        for way in found.onward[skill]:
            most[way.target] += most[skill] * way.most
        onward[skill] = tuple(
            replace(way, is_learnt=way.is_learnt and not delta * most[skill] < way.cuts) for way in found.onward[skill]
        )
    return replace(found, onward=tuple(onward))


class _Leaks:
    """Rows by skill: W, Σ W over its learnt lines, and the greatest U of a path to it, with that path's last steps."""

    def __init__(self, found: InfluenceEdges, actuators: int, delta: float) -> None:
        self._found, self._delta = found, delta
        self._reach: dict[int, Row] = {}
        for skill in reversed(found.skills):
            own = np.array([float(actuator in found.drives[skill]) for actuator in range(actuators)])
            self._reach[skill] = sum((way.most * self._reach[way.target] for way in found.onward[skill]), own)
        self._learnt = {skill: self._sum_of_learnt(skill, None) for skill in found.skills}
        self._worst = {skill: np.full(actuators, -1.0) for skill in found.skills}  # where no path leads
        self._worst[found.skills[0]] = np.zeros(actuators)
        self._above: dict[int, dict[int, tuple[int, InfluenceEdge]]] = {skill: {} for skill in found.skills}
        for skill in found.skills:
            for way in found.onward[skill] if self._worst[skill].min(initial=0) >= 0 else ():
                leaked = (self._worst[skill] + delta * self._others(skill, way)) / way.most
                for actuator in np.flatnonzero(leaked > self._worst[way.target]).tolist():
                    self._worst[way.target][actuator] = leaked[actuator]
                    self._above[way.target][actuator] = skill, way

    def _sum_of_learnt(self, skill: int, kept: InfluenceEdge | None) -> Row:
        ways = (way for way in self._found.onward[skill] if way.is_learnt and way is not kept)
        return sum((self._reach[way.target] for way in ways), np.zeros_like(self._reach[skill]))

    def _others(self, skill: int, kept: InfluenceEdge | None) -> Row:
        """Σ W over the learnt lines of a skill other than the one that is meant."""
        if kept is None or not kept.is_learnt:
            return self._learnt[skill]
        if np.isfinite(self._learnt[skill]).all():
            return np.maximum(self._learnt[skill] - self._reach[kept.target], 0.0)
        return self._sum_of_learnt(skill, kept)

    def worst_path(self, actuator: int) -> Leak | None:
        """The worst path of one actuator, followed back from the worst driver."""
        found = self._found
        unwanted = {
            driver: float(self._worst[driver][actuator] + self._delta * self._others(driver, None)[actuator])
            for driver in found.skills
            if actuator in found.drives[driver] and self._worst[driver][actuator] >= 0
        }
        if not unwanted:
            return None
        skill, way = max(unwanted, key=unwanted.__getitem__), None
        most, passed = unwanted[skill], 1.0
        levels: list[Level] = []
        while True:
            passed *= way.most if way else 1.0
            own = self._delta * self._others(skill, way)[actuator] / passed
            leaking = (each.target for each in found.onward[skill] if each.is_learnt and each is not way)
            into = tuple(found.names[target] for target in leaking if self._reach[target][actuator] > 0)
            levels.append(Level(found.names[skill], _share(own, most), into))
            if actuator not in self._above[skill]:
                return Leak(_share(most, most), tuple(reversed(levels)))
            skill, way = self._above[skill][actuator]


def _share(own: float, unwanted: float) -> float:
    return float(own / (1 + unwanted)) if np.isfinite(unwanted) else float(not np.isfinite(own))
