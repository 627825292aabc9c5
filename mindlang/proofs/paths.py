"""The paths of influence from the master to an actuator, from the declaration alone: counted, and some of them listed.

A path leads over lines that can send more than 0 whatever the weights are: `influences X at 0` is no path.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np
from mindrun.graph.graph import Edge, Graph, Skill
from mindrun.graph.weights import reachable
from networkx import DiGraph, all_simple_paths

from mindlang.proofs.interval import Boxes, evaluate, whole

MAX_COUNTED_PATHS = 10**15  # stands for itself and for more


@dataclass(frozen=True, slots=True)
class Paths:
    """How many paths lead to an actuator, up to MAX_COUNTED_PATHS, and the first: names of skills, the driver last."""

    count: int
    first: tuple[tuple[str, ...], ...]


@dataclass(frozen=True, slots=True)
class Way:
    """An edge that can carry influence to another skill, by its index: how much at most, and whether it is learnt.

    What would arrive with less than `cuts` does not.
    """

    target: int
    most: float
    is_learnt: bool
    cuts: float = 0.0


@dataclass(frozen=True, slots=True)
class Ways:
    """By index, of the skills below the master, parents first: where influence can go, what they drive."""

    names: tuple[str, ...]
    skills: tuple[int, ...]
    onward: tuple[tuple[Way, ...], ...]
    drives: tuple[tuple[int, ...], ...]


def ways(graph: Graph) -> Ways:
    """Where influence can go, without any weights."""
    place = graph.skill_numbers
    everything = whole(graph.width)
    onward = [
        tuple(way for edge in skill.edges if edge.to == "skill" and (way := _way(skill, edge, everything)).most > 0)
        for skill in graph.skills
    ]
    drives = [tuple(edge.target for edge in skill.edges if edge.to == "actuator") for skill in graph.skills]
    below = tuple(place[skill.name] for skill in reachable(graph, graph.master))
    return Ways(tuple(place), below, tuple(onward), tuple(drives))


def _way(skill: Skill, edge: Edge, everything: Boxes) -> Way:
    if edge.output is not None:
        return Way(edge.target, 1.0, skill.function.learns, edge.cuts)  # Python code is as exact as it is written
    with np.errstate(all="ignore"):
        sent_values = [edge.value] + ([edge.gate.otherwise] if edge.gate and edge.gate.otherwise is not None else [])
        most = max(evaluate(value, everything)[1][0] for value in sent_values)
    return Way(edge.target, float(np.clip(most, 0, 1)), False, edge.cuts)


def paths(found: Ways, actuators: int, listed: int) -> list[Paths]:
    """The paths to each actuator."""
    counts = _counts(found, actuators)
    master = found.skills[0]
    return [
        Paths(int(counts[master][actuator]), tuple(islice(_first(found, counts, actuator), listed)))
        for actuator in range(actuators)
    ]


def _counts(found: Ways, actuators: int) -> dict[int, list[int]]:
    """By skill, how many paths lead from it to each actuator, up to MAX_COUNTED_PATHS."""
    counts: dict[int, list[int]] = {}
    for skill in reversed(found.skills):
        own = [int(actuator in found.drives[skill]) for actuator in range(actuators)]
        for way in found.onward[skill]:
            own = [min(MAX_COUNTED_PATHS, a + b) for a, b in zip(own, counts[way.target], strict=True)]
        counts[skill] = own
    return counts


def _first(found: Ways, counts: dict[int, list[int]], actuator: int) -> Iterator[tuple[str, ...]]:
    """Paths in the order of the lines, no step of which leads astray."""
    graph, end = DiGraph(), -1  # the actuator, below all that drive it
    for skill in (skill for skill in found.skills if counts[skill][actuator]):
        graph.add_edges_from((skill, end) for driven in found.drives[skill] if driven == actuator)
        graph.add_edges_from((skill, way.target) for way in found.onward[skill] if counts[way.target][actuator])
    if counts[found.skills[0]][actuator]:
        for path in all_simple_paths(graph, found.skills[0], end):
            yield tuple(found.names[skill] for skill in path[:-1])
